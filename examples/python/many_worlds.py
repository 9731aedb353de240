# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Many worlds at once: 64 arms make the same motion, each with another stiffness preset, and each gets a score.

The score is how far the joints are from where they should be, averaged over the motion; beside it stands the most that an actuator
had to give. Soft arms sag under their own weight. Run: python3 many_worlds.py
"""
import numpy as np
import vsasim

COPIES, SECONDS, AMPLITUDE_RAD, FREQUENCY_HZ = 64, 1.0, 0.3, 1.0

world = vsasim.World.load("manipulator_3r")
batch = vsasim.Batch(world, COPIES)  # on as many threads as there are
most = min(i["preset_max"] for i in world.actuator_info())
presets = np.linspace(0.0, most, COPIES)
batch.preset = presets[:, np.newaxis]  # (copies, 1) for all actuators of a copy

error_rad = np.zeros(COPIES)
torque_Nm = np.zeros(COPIES)
rounds = 0
while batch.time_s[0] < SECONDS:
    wanted = AMPLITUDE_RAD * np.sin(2 * np.pi * FREQUENCY_HZ * batch.time_s)[:, np.newaxis]
    batch.equilibrium = wanted
    batch.step(10)
    error_rad += np.abs(batch.shaft_rad - wanted).mean(axis=1)
    torque_Nm = np.maximum(torque_Nm, np.abs(batch.torque_Nm).max(axis=1))
    rounds += 1
error_rad[batch.status] = np.nan  # a copy that failed has no score

print("preset, rad   mean error, rad   peak torque, N·m")
for c in range(0, COPIES, 9):
    print(f"{presets[c]:11.3f}   {error_rad[c] / rounds:15.3f}   {torque_Nm[c]:16.3f}")
best = int(np.nanargmin(error_rad))
print(f"{presets[best]:.3f} rad follows best of {COPIES}: {error_rad[best] / rounds:.3f} rad")
