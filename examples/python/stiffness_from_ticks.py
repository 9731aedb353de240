# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The stiffness of a joint from what a unit tells on its bus, encoder ticks and currents, scored against the true one.

Somebody swings the shaft slowly to and fro. Two estimates: by the law, which knows the springs and needs the three encoders; and by
the currents, which knows the motor's constant only. A motor carries its spring's load and its gear's friction, so that currents tell
too much on the way there and too little on the way back: the two are averaged. Run: python3 stiffness_from_ticks.py
"""
import numpy as np
import vsasim

STEP_S, PERIOD_S, SWING_RAD = 1e-3, 20.0, 0.12

kind = vsasim.ActuatorType.load("qbmove_maker_pro_6_1")
constant = kind["drive.torque_constant_Nm_per_A"] * kind["drive.gear_ratio"]
tick_rad = 2 * np.pi / 65536 * 2 ** kind["firmware.resolution"]
time_s = np.arange(0.0, 2 * PERIOD_S, STEP_S)
path = SWING_RAD * np.sin(2 * np.pi * time_s / PERIOD_S)
second = time_s > PERIOD_S  # the first swing only bends the frictions

print("preset, rad   true   by the law   by currents   (N·m/rad at the equilibrium)")
errors = []
for preset in (0.2, 0.3, 0.4, 0.5):
    unit = vsasim.Unit(kind, preset=preset)
    told = np.empty((time_s.size, 5))
    true = np.empty(time_s.size)
    for i, angle in enumerate(path):
        unit.step(STEP_S, angle, 0.0)
        now = unit.readings()
        told[i, :3] = now["measured_ticks"]  # all that a client sees: motors, shaft, …
        told[i, 3:] = np.round(now["current_A"], 3)  # … and milliamperes
        true[i] = now["stiffness_Nm_per_rad"]
    motors, shaft, current = told[:, :2] * tick_rad, told[:, 2] * tick_rad, told[:, 3:]

    attained = np.array([kind.attained(m) for m in motors[second][::200]])
    by_law = kind.stiffness_Nm_per_rad(shaft[second][::200], attained[:, 0], attained[:, 1])
    near = np.abs(shaft[second][::200] - attained[:, 0]) < 0.02

    torque = -constant * current.sum(axis=1)  # the motors hold what the shaft is given
    slopes = []
    for way in (np.gradient(path) > 0, np.gradient(path) < 0):
        part = second & way & (np.abs(shaft) < 0.06)
        slopes.append(np.polyfit(shaft[part], torque[part], 1)[0])
    goal = true[second][np.abs(path[second]) < 0.02].mean()
    found = by_law[near].mean(), abs(np.mean(slopes))
    errors.append(np.abs(np.array(found) / goal - 1))
    print(f"{preset:11.1f}   {goal:4.2f}   {found[0]:10.2f}   {found[1]:11.2f}")
law, currents = 100 * np.mean(errors, axis=0)
print(f"off on average: {law:.0f} % by the law, {currents:.0f} % by currents")
