# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A sweep: an elbow made in Python is struck once for each actuator type and preset, on threads.

Run: python3 sweep.py. Needs MuJoCo's Python package and vsasim's plug-in for it (docs/howto/mujoco.md).
"""
import concurrent.futures
import itertools

import mujoco
import vsasim.mujoco

ARM = """<mujoco><option timestep="0.001"/><worldbody><body><joint name="elbow" axis="0 0 1"/>
<geom type="capsule" size="0.02" fromto="0 0 0 0.2 0 0" mass="0.3"/></body></worldbody></mujoco>"""
DEFLECTION = vsasim.mujoco.READINGS.index("deflection")


def struck(case):
    kind, preset = case
    model = mujoco.MjModel.from_xml_string(vsasim.mujoco.add(ARM, "elbow", kind, preset=preset))
    data = mujoco.MjData(model)
    data.ctrl[1] = preset
    mujoco.mj_step(model, data, 200)
    data.qvel[0] += 2  # rad/s
    largest = 0.0
    for _ in range(300):
        mujoco.mj_step(model, data)
        largest = max(largest, abs(data.sensordata[DEFLECTION]))
    return f"{kind},{preset},{largest:.3f}"


vsasim.mujoco.load()
cases = itertools.product(("qbmove_maker_pro_6_1", "qbmove_advanced"), (0.1, 0.3, 0.5))
with concurrent.futures.ThreadPoolExecutor() as pool:
    print("type,preset_rad,deflection_rad", *pool.map(struck, cases), sep="\n")
