# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The impedance of a joint from its matrices, beside that of a simulated chirp.

A series elastic unit turns a lever in a viscous bearing; a torque whose frequency rises pushes it. Torque over speed, as spectra, is
the impedance that linearize() gives without a simulation. It swings by about 0.25 rad all the time, so that single percents of duty
don't count; frictions are left out and the encoders are fine, since a linear model has neither.
Draws bode_beside_a_chirp.png where matplotlib is installed. Run: python3 bode_beside_a_chirp.py
"""
import numpy as np
import vsasim

INERTIA, DAMPING, SWING_RAD, STEP_S, LAST_S = 0.02, 0.3, 0.25, 1e-4, 60.0
SMOOTH = {"drive.friction_Nm": 0, "shaft.friction_Nm": 0, "drive.dead_band": 0, "sensor.encoder_bits": 16}

lever = vsasim.ActuatorType.load("sea_example", SMOOTH)
model = lever.linearize(inertia_kgm2=INERTIA, damping_Nms_per_rad=DAMPING, firmware="sampled")

# From 1 to 12 Hz, the same growth each second; then it rings out, so that nothing is cut off.
time_s = np.arange(round(LAST_S / STEP_S)) * STEP_S
pushing = 0.9 * LAST_S
growth = np.log(12.0) / pushing
present_Hz = np.exp(growth * np.minimum(time_s, pushing))
grid_Hz = np.linspace(1.0, 12.0, 200)
size_Nm = SWING_RAD * 2 * np.pi * grid_Hz * np.abs(model.response(grid_Hz)["impedance"])
torque = np.interp(present_Hz, grid_Hz, size_Nm) * np.sin(2 * np.pi * (present_Hz - 1) / growth) * (time_s < pushing)

unit = vsasim.Unit(lever)
speed = np.empty_like(time_s)
q = v = 0.0
for i, push in enumerate(torque):
    before = v
    v += STEP_S * (unit.step(STEP_S, q, v, 1 / INERTIA) + push - DAMPING * v) / INERTIA
    q += STEP_S * v
    speed[i] = (before + v) / 2  # of the step's middle, as the torque is its mean

# The ratio of the spectra over bands of nine lines, since single ones lie in the noise of counts and percents; told likewise.
frequency_Hz = np.fft.rfftfreq(len(time_s), STEP_S)
used = (frequency_Hz > 1.2) & (frequency_Hz < 10.2)
pushed, moved, frequency_Hz = np.fft.rfft(torque)[used], np.fft.rfft(speed)[used], frequency_Hz[used]
power = np.abs(moved) ** 2


def over_bands(impedance):
    """The mean of nine neighbours, each as far as it moved."""
    return np.convolve(impedance * power, np.ones(9), "valid") / np.convolve(power, np.ones(9), "valid")


simulated, told = over_bands(pushed / moved), over_bands(model.response(frequency_Hz)["impedance"])
frequency_Hz = frequency_Hz[4:-4]
off = np.abs(simulated - told) / np.abs(told)

print("frequency, Hz   |Z| told   |Z| simulated   off")
for f in (1.6, 2.5, 4.0, 6.0, 9.5):
    i = int(np.argmin(np.abs(frequency_Hz - f)))
    print(f"{f:13.1f}   {abs(told[i]):8.4f}   {abs(simulated[i]):13.4f}   {100 * off[i]:.2f} %")
print(f"median {100 * np.median(off):.2f} %, 95 of 100 below {100 * np.percentile(off, 95):.2f} %")

try:
    import matplotlib
except ImportError:
    print("no matplotlib, so no picture")
else:
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (size, phase) = pyplot.subplots(2, 1, sharex=True, layout="constrained")
    size.loglog(frequency_Hz, np.abs(told), label="linearize()")
    size.loglog(frequency_Hz[::12], np.abs(simulated[::12]), ".", label="simulated chirp")
    phase.semilogx(frequency_Hz, np.angle(told, deg=True))
    phase.semilogx(frequency_Hz[::12], np.angle(simulated[::12], deg=True), ".")
    size.set_ylabel("|Z|, N·m·s/rad")
    size.legend()
    phase.set(xlabel="frequency, Hz", ylabel="phase, °")
    figure.savefig("bode_beside_a_chirp.png")
