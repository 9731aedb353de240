# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A parameter study without a simulation: how an arm's slowest swing depends on stiffness preset and the position loops' gain.

Each pair is a linearization and its poles, some milliseconds, gravity and all joints together. The softer a loop is beside its
springs, the more its motors yield and damp. Draws parameter_study.png where matplotlib is installed.
Run: python3 parameter_study.py
"""
import numpy as np
import vsasim

PRESETS_RAD = np.linspace(0.0, 0.6, 13)
GAINS = (0.5, 1.0, 2.0)  # times the shipped one
POSE = (0.4, 0.3, -0.3)


def slowest_swing(poles):
    """Frequency and damping ratio of the slowest motion that swings."""
    swings = [i for i in range(len(poles["s"])) if poles["s"][i].imag > 0]
    first = min(swings, key=lambda i: poles["frequency_Hz"][i])
    return poles["frequency_Hz"][first], poles["damping_ratio"][first]


found = {}
for gain in GAINS:
    shipped = vsasim.ActuatorType.load("qbmove_maker_pro_6_1")["firmware.kp_pct_per_tick"]
    world = vsasim.World.load("manipulator_3r", set={"firmware.kp_pct_per_tick": gain * shipped})
    angles = dict(zip(world.actuators, POSE))
    found[gain] = np.array([slowest_swing(world.linearize(angles=angles, preset=p).poles) for p in PRESETS_RAD])

print("slowest swing of the arm, Hz (damping ratio)")
print("preset, rad" + "".join(f"   gain × {gain:<6}" for gain in GAINS))
for i in range(0, len(PRESETS_RAD), 2):
    print(f"{PRESETS_RAD[i]:11.2f}" + "".join(f"{f:8.2f} ({z:.3f})" for f, z in (found[s][i] for s in GAINS)))

try:
    import matplotlib
except ImportError:
    print("no matplotlib, so no picture")
else:
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (top, bottom) = pyplot.subplots(2, 1, sharex=True, layout="constrained")
    for gain, values in found.items():
        top.plot(PRESETS_RAD, values[:, 0], label=f"gain × {gain}")
        bottom.plot(PRESETS_RAD, values[:, 1])
    top.set_ylabel("slowest swing, Hz")
    top.legend()
    bottom.set(xlabel="stiffness preset, rad", ylabel="damping ratio")
    figure.savefig("parameter_study.png")
