#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Stiff robots at random beside stops, ground and dry friction:

  PYTHONPATH=build/release/python python3 bench/measurements/stiff_robots.py [FIRST [COUNT]]

Each number makes another robot: one to four links of 1e-5 to 1e-2 kg·m² on axes of their own, actuators of stiff types, some joints with
stops and friction, half with gravity, half above a floor that their last link can hit, 0.25 to 2 ms, commanded elsewhere every half
second for 3 s. Prints those that blow up and those of which the sum of coupling is below -1 % of what moved, and counts them.
"""
import pathlib
import random
import sys
import tempfile

import vsasim

TYPES = ("tree_lime_50", "tree_avocado_100", "tree_orange_100", "ugurlu_sea", "hebi_x8_9", "anydrive_ad119e20")


def robot(r):
    count = r.randint(1, 4)
    floor = r.random() < 0.5
    links = joints = actuators = ""
    x = 0.0
    for i in range(count):
        moment, length = 10 ** r.uniform(-5, -2), r.uniform(0.03, 0.12)
        mass = max(0.01, 3 * moment / length**2) if r.random() < 0.5 else 0.01
        ball = (f"<collision name='c'><pose>{length} 0 0 0 0 0</pose><geometry><sphere><radius>0.01</radius></sphere></geometry></collision>"
                if floor and i == count - 1 else "")
        links += (f"<link name='l{i}'><pose>{x} 0 0 0 0 0</pose><inertial><pose>{length / 2} 0 0 0 0 0</pose><mass>{mass}</mass><inertia>"
                  f"<ixx>{moment}</ixx><iyy>{moment}</iyy><izz>{moment}</izz></inertia></inertial>{ball}</link>")
        axis = "0 1 0" if r.random() < 0.7 else r.choice(("1 0 0", "0 0 1"))
        limit = f"<limit><lower>{-r.uniform(0.05, 0.5)}</lower><upper>{r.uniform(0.05, 0.5)}</upper></limit>" if r.random() < 0.6 else ""
        rub = f"<dynamics><friction>{10 ** r.uniform(-2, 0.5)}</friction></dynamics>" if r.random() < 0.3 else ""
        joints += (f"<joint name='j{i}' type='revolute'><parent>{f'l{i - 1}' if i else 'world'}</parent><child>l{i}</child>"
                   f"<axis><xyz>{axis}</xyz>{limit}{rub}</axis></joint>")
        actuators += f"<actuator name='a{i}'><joint>j{i}</joint><type>{r.choice(TYPES)}</type></actuator>"
        x += length
    plane = ("<model name='floor'><static>true</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 1</normal>"
             "</plane></geometry></collision></link></model>") if floor else ""
    gravity = "0 0 -9.81" if r.random() < 0.5 else "0 0 0"
    return (f"<?xml version='1.0'?><sdf version='1.7'><world name='w'><gravity>{gravity}</gravity>{plane}<model name='m'>"
            f"<pose>0 0 {r.uniform(0.011, 0.06)} 0 0 0</pose>{links}{joints}"
            f"<plugin name='vsa::Robot' filename='libvsa-robot.so'>{actuators}</plugin></model></world></sdf>"), count


def outcome(number, file):
    r = random.Random(number)
    text, count = robot(r)
    step_s = r.choice((2.5e-4, 5e-4, 1e-3, 2e-3))
    file.write_text(text, encoding="utf-8")
    world = vsasim.World.load(str(file), step_s=step_s)
    try:
        for _ in range(6):
            for i in range(count):
                world.command(f"a{i}", r.uniform(-0.6, 0.6), r.choice((0.0, 0.0, 0.3)))
            world.step(round(0.5 / step_s))
    except vsasim.SimulationError as error:
        return "blown up", step_s, str(error).splitlines()[0]
    energy = world.ledger()
    created = -energy["coupling_J"] / max(energy["moved_J"], 1e-9)
    return ("gains energy" if created > 0.01 else "right"), step_s, f"{100 * created:.1f} % of {energy['moved_J']:.3g} J"


def main():
    first, number = (int(a) for a in (sys.argv[1:] + ["0", "150"][len(sys.argv) - 1:])[:2])
    counts = {"right": 0, "gains energy": 0, "blown up": 0}
    with tempfile.TemporaryDirectory() as folder:
        for k in range(first, first + number):
            kind, step_s, text = outcome(k, pathlib.Path(folder) / "robot.sdf")
            counts[kind] += 1
            if kind != "right":
                print(f"{k}: {kind}, {1e3 * step_s:g} ms: {text}", flush=True)
    print(f"robots {first} to {first + number - 1}: {', '.join(f'{n} {kind}' for kind, n in counts.items())}")


if __name__ == "__main__":
    main()
