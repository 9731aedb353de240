# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Impedance of a joint by torque steps: how far does the shaft give way, beside what the elastic law alone says?

At each preset an external torque steps onto the shaft of the free bench. The difference is what friction holds and what the
motors' position loop gives way. Run: python3 impedance_by_steps.py
"""
import vsasim

TORQUE_NM = 0.5

world = vsasim.World.load("bench_free")
joint = world.joints[0]
law = vsasim.ActuatorType.load(world.actuator_info()[0]["type"])

print("preset_rad  given_way_rad  by_the_law_rad  stiffness_Nm_per_rad")
for preset in (0.0, 0.2, 0.4, 0.6):
    world.reset()
    world.place("shaft", 0.0, preset)
    world.run(0.5)
    start = world.read("shaft")["shaft_rad"]
    world.apply_torque(joint, TORQUE_NM)
    world.run(1.5)
    now = world.read("shaft")
    by_law = -law.equilibrium_for(0.0, -TORQUE_NM, preset)  # the spring carries the load where its equilibrium is that far behind
    print(f"{preset:10.1f}  {now['shaft_rad'] - start:13.4f}  {by_law:14.4f}  {now['stiffness_Nm_per_rad']:20.2f}")
