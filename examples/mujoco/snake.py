# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The snake as MJCF: a built-in world exported with its robot's plug-in elements, and a wave along its twelve units.

Run: python3 snake.py; $VSA names the vsa program, if it isn't in the path. Needs MuJoCo's Python package and vsasim's plug-in for it
(docs/howto/mujoco.md).
"""
import os
import subprocess
import tempfile

import mujoco
import numpy as np
import vsasim.mujoco

vsasim.mujoco.load()
with tempfile.TemporaryDirectory() as folder:
    command = [os.environ.get("VSA", "vsa"), "export", "--mjcf", "snake_flat", "--plugin", "--out", folder]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    model = mujoco.MjModel.from_xml_path(f"{folder}/snake_flat_plugin.xml")
data = mujoco.MjData(model)
mujoco.mj_resetDataKeyframe(model, data, 0)  # joints and controls as the world begins
start = data.qpos[:3].copy()
unit = np.arange(model.nu // 2)
while data.time < 4:
    data.ctrl[0::2] = 0.5 * np.sin(4.4 * data.time - 0.5 * unit)  # equilibria, rad
    data.ctrl[1::2] = 0.3  # presets, rad
    mujoco.mj_step(model, data, 10)
energy = data.sensordata.reshape(-1, len(vsasim.mujoco.READINGS))[:, vsasim.mujoco.READINGS.index("energy_supply_J")]
print(f"head moved by {np.linalg.norm(data.qpos[:3] - start):.2f} m with {energy.sum():.0f} J from the supply")
