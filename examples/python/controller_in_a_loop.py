# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A controller in a loop: impedance control of an arm at 100 Hz through the simulated bus.

Each joint shall behave as a spring of 2 N·m/rad with a damper of 0.05 N·m·s/rad about 0.6 rad, gravity carried: which equilibrium
gives that torque at this angle, the law read backwards tells. Run: python3 controller_in_a_loop.py
"""
import numpy as np
import vsasim

STIFFNESS, DAMPING, TARGET_RAD, PRESET = 2.0, 0.05, 0.6, 0.4

world = vsasim.World.load("manipulator_3r")
info = world.actuator_info()
laws = [vsasim.ActuatorType.load(i["type"]) for i in info]
dof_of = {j["name"]: j["dof"] for j in world.joint_info()}
dof = [dof_of[i["joint"]] for i in info]

readings = np.empty(len(info), vsasim.World.reading_dtype)  # filled again and again
equilibrium = np.zeros(len(info))
while world.time_s < 3.0:
    world.read(out=readings)
    q, speed = readings["shaft_rad"], readings["shaft_speed_rad_per_s"]
    torque = world.gravity_torques()[dof] + STIFFNESS * (TARGET_RAD - q) - DAMPING * speed
    for i, law in enumerate(laws):
        found = law.equilibrium_for(q[i], torque[i], PRESET)
        if found is not None:
            equilibrium[i] = found
    world.command_all(equilibrium, PRESET)
    world.run(0.01)

for name, angle in zip(world.actuators, world.read()["shaft_rad"]):
    print(f"{name}: {angle:.3f} rad of {TARGET_RAD}")
