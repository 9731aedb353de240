# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The same motion of an arm, soft and stiff: a step of all three joints, and how the first one rings.

Draws arm_at_two_presets.png where matplotlib is installed. Run: python3 arm_at_two_presets.py
"""
import numpy as np
import vsasim

DURATION_S, SAMPLE_S = 2.0, 0.01
TARGET_RAD = [0.6, 0.4, -0.4]

first = vsasim.World.load("manipulator_3r")
start = first.snapshot()
time_s = np.arange(1, round(DURATION_S / SAMPLE_S) + 1) * SAMPLE_S

shaft_rad = {}
for preset in (0.1, 0.6):
    first.restore(start)
    first.command_all(TARGET_RAD, preset)
    rows = []
    for _ in time_s:
        first.run(SAMPLE_S)
        rows.append(first.read()["shaft_rad"].copy())
    shaft_rad[preset] = np.array(rows)
    farthest, last = np.abs(shaft_rad[preset][:, 0]).max(), shaft_rad[preset][-1, 0]
    print(f"preset {preset} rad: {first.actuators[0]} goes as far as {farthest:.3f} rad and is at {last:.3f} rad after {DURATION_S} s")

try:
    import matplotlib
except ImportError:
    print("no matplotlib, so no picture")
else:
    matplotlib.use("Agg")
    from matplotlib import pyplot

    for preset, angles in shaft_rad.items():
        pyplot.plot(time_s, angles[:, 0], label=f"preset {preset} rad")
    pyplot.axhline(TARGET_RAD[0], color="grey", linewidth=0.5)
    pyplot.xlabel("time, s")
    pyplot.ylabel(f"{first.actuators[0]}, rad")
    pyplot.legend()
    pyplot.savefig("arm_at_two_presets.png")
