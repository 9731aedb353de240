# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""One joint: a knee goes to the same angle soft and stiff, and is pushed there; --view shows it in MuJoCo's viewer instead.

Run: python3 one_joint.py [--view]. Needs MuJoCo's Python package and vsasim's plug-in for it (docs/howto/mujoco.md).
"""
import pathlib
import sys

import mujoco
import vsasim.mujoco

vsasim.mujoco.load()
model = mujoco.MjModel.from_xml_path(str(pathlib.Path(__file__).with_name("knee.xml")))
data = mujoco.MjData(model)
if "--view" in sys.argv[1:]:
    import mujoco.viewer

    mujoco.viewer.launch(model, data)
    sys.exit()

print("preset_rad,stiffness_Nm_per_rad,pushed_rad")
for preset in (0.1, 0.5):
    data.ctrl[:] = 0.5, preset
    mujoco.mj_step(model, data, 2000)
    angle = data.qpos[0]
    data.qfrc_applied[0] = 0.3  # N·m
    mujoco.mj_step(model, data, 2000)
    knee = dict(zip(vsasim.mujoco.READINGS, data.sensor("knee").data))
    print(f"{preset},{knee['stiffness']:.2f},{data.qpos[0] - angle:.3f}")
    data.qfrc_applied[0] = 0
