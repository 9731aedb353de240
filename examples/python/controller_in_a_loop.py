# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A controller in a loop: a soft arm goes to an angle against gravity, by what its units answer on the bus and by commands alone.

All that the controller has is `measured_ticks`: three encoders a unit, in the last answer to GET_MEASUREMENTS that the bus master could
read. A cycle of the bus takes 1 ms a unit and asks each once, so that the controller runs every 3 ms. Before each cycle it takes answers
that are 4 ms old and gives equilibria that go out in that cycle's SET_INPUTS. Ticks aren't the truth: encoders have 1.5 mrad steps, and the
shaft's reading has a zero error that nobody on the bus can know. Not on this wire: speeds, torques, currents (a unit would answer
GET_CURRENTS, but the master doesn't ask), when an answer came, and whether one was lost. The truth is read for the scores only.

    equilibrium = E(r, g(r) + D (r' − v)) + I,   I' = K_I (r − q),   v: differences of q, low-passed

E: the law read backwards, which equilibrium gives that torque at that angle; g: what gravity asks, of a model of the arm, which a client
has, too (here it is exact); r: the angle to be reached, by a smooth path. The springs stay as soft as the preset makes them; only slowly,
by I, does the arm come back to r if something pushes. I stands still where the encoder shows no error of more than a step: friction would
make the arm hunt. Run: python3 controller_in_a_loop.py
"""
import numpy as np
import vsasim

TARGET_RAD, PRESET, RISE_S, END_S, CYCLE_S = 0.6, 0.4, 1.0, 6.0, 0.003
INTEGRAL_PER_S, DAMPING_NMS_PER_RAD, LOW_PASS_S = 2.0, 0.05, 0.02

world = vsasim.World.load("manipulator_3r")
model = world.clone()  # the controller's own: only gravity is asked of it
start = world.snapshot()
info = world.actuator_info()
laws = [vsasim.ActuatorType.load(i["type"]) for i in info]
dof_of = {j["name"]: j["dof"] for j in world.joint_info()}
dof = [dof_of[i["joint"]] for i in info]
tick_rad = np.array([2 * np.pi / 65536 * 2 ** law["firmware.resolution"] for law in laws])
encoder_rad = 2 * np.pi / 2 ** laws[0]["sensor.encoder_bits"]  # below that an error isn't seen


def gravity_torques(angle):
    for i in info:
        model.set_joint(i["joint"], angle)
    return model.gravity_torques()[dof]


def equilibria(angle, torques):
    found = [law.equilibrium_for(angle, torque, PRESET) for law, torque in zip(laws, torques)]
    return np.array([angle if f is None else f for f in found])  # None: the springs can't give it


def run(gravity, integral, damping):
    """From the start on; for the scores: the true angles after each cycle, (cycles, actuators), and all readings at the end."""
    world.restore(start)
    readings = np.empty(len(info), vsasim.World.reading_dtype)  # filled again and again
    world.read(out=readings)
    before = readings["measured_ticks"][:, 2] * tick_rad
    speed, trim, truth = np.zeros(len(info)), np.zeros(len(info)), []
    for k in range(round(END_S / CYCLE_S)):
        part = min(k * CYCLE_S / RISE_S, 1.0)
        rate = TARGET_RAD * 6 * part * (1 - part) / RISE_S
        goal = TARGET_RAD * part**2 * (3 - 2 * part)
        measured = readings["measured_ticks"][:, 2] * tick_rad
        speed += CYCLE_S / (CYCLE_S + LOW_PASS_S) * ((measured - before) / CYCLE_S - speed)
        before = measured
        error = goal - measured
        trim += integral * CYCLE_S * np.where(np.abs(error) > encoder_rad, error, 0.0)
        world.command_all(equilibria(goal, gravity * gravity_torques(goal) + damping * (rate - speed)) + trim, PRESET)
        world.run(CYCLE_S)
        world.read(out=readings)
        truth.append(readings["shaft_rad"].copy())
    return np.array(truth), readings


def causes(now):
    """Why the shafts rest where they do: by the springs under gravity less what was commanded for that, the pulleys, frictions; rad."""
    loads = world.gravity_torques()[dof]
    sag = [q - law.equilibrium_for(q, load, p) for law, q, load, p in zip(laws, now["shaft_rad"], loads, now["preset"])]
    return {
        "springs under gravity, and what was commanded for it": sag + now["equilibrium_command_rad"] - TARGET_RAD,
        "pulleys beside their command: the units' loops have no integral": now["equilibrium_rad"] - now["equilibrium_command_rad"],
        "what frictions of springs and shaft hold": now["deflection_rad"] - sag,
    }


def row(name, numbers):
    print(f"{name:66}" + "".join(f"{1e3 * n:9.1f}" for n in numbers))


ways = {
    "commands alone": (0.0, 0.0, 0.0),
    "gravity fed forward": (1.0, 0.0, 0.0),
    "and the integral of what the bus tells": (1.0, INTEGRAL_PER_S, 0.0),
    "and damping by its ticks' speed": (1.0, INTEGRAL_PER_S, DAMPING_NMS_PER_RAD),
}
print(f"To {TARGET_RAD} rad at preset {PRESET} rad; all in mrad, the truth, which the controller doesn't see")
print(f"{'beside the target at the end':66}" + "".join(f"{name:>9}" for name in world.actuators))
ends, above = {}, {}
for name, gains in ways.items():
    truth, now = run(*gains)
    row(name, truth[-1] - TARGET_RAD)
    above[name] = truth.max(axis=0) - TARGET_RAD
    ends[name] = (causes(now), now["measured_ticks"][:, 2] * tick_rad)
print("\nhighest beyond it on the way")
for name, far in above.items():
    row(name, np.maximum(far, 0))
for name in list(ways)[:2]:
    print(f"\nwhy: {name}")
    for cause, part in ends[name][0].items():
        row("  " + cause, part)
print("\nwhy: with the controller")
measured = list(ends.values())[-1][1]
row("  what its encoders tell: it sees no more, a step is 1.5", measured - TARGET_RAD)
row("  their zero error, which nobody on the bus can know", [-law["sensor.shaft_zero_rad"] for law in laws])
