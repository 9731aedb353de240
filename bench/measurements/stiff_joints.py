#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Stiff joints beside what holds them: PYTHONPATH=build/release/python python3 bench/measurements/stiff_joints.py

One link with one actuator, its types and moments in all combinations: pressed on its stop by 0.01 rad; thrown at it; with dry friction of
its joint. Counts what shakes (rms speed of the last 0.3 s of 3 s from 0.02 rad/s on), what gains energy (coupling below -0.1 % of what
moved) and what blows up. A minute.
"""
import itertools
import math
import pathlib
import tempfile

import vsasim

TYPES = ("tree_lime_50", "tree_avocado_100", "tree_orange_100", "ugurlu_sea", "hebi_x8_9", "anydrive_ad119e20")
MOMENTS = (1e-5, 1e-4, 1e-3, 1e-2)  # kg·m²


def sdf(kind, moment, axis):
    return f"""<?xml version="1.0"?><sdf version="1.7"><world name="w"><gravity>0 0 0</gravity><model name="m">
<link name="l"><inertial><mass>0.01</mass><inertia><ixx>{moment}</ixx><iyy>{moment}</iyy><izz>{moment}</izz></inertia></inertial></link>
<joint name="j" type="revolute"><parent>world</parent><child>l</child><axis><xyz>0 1 0</xyz>{axis}</axis></joint>
<plugin name="vsa::Robot" filename="libvsa-robot.so"><actuator name="a"><joint>j</joint><type>{kind}</type></actuator></plugin>
</model></world></sdf>"""


def outcome(file, text, step_s, begin, command):
    file.write_text(text, encoding="utf-8")
    world = vsasim.World.load(str(file), step_s=step_s)
    if begin is not None:
        world.place("a", begin, 0.0)
    world.command("a", *command)
    squares = []
    try:
        world.step(round(2.7 / step_s))
        for _ in range(round(0.3 / step_s)):
            world.step()
            squares.append(world.joint_speeds()[0] ** 2)
    except vsasim.SimulationError:
        return "blown up"
    energy = world.ledger()
    if math.sqrt(sum(squares) / len(squares)) >= 0.02:
        return "shakes"
    return "gains energy" if energy["coupling_J"] < -1e-3 * energy["moved_J"] else "rests"


def main():
    stop = "<limit><lower>-0.3</lower><upper>0.3</upper></limit>"
    cases = {}
    for step_s in (1e-3, 2e-3, 4e-3):
        cases[f"pressed on its stop, {1e3 * step_s:g} ms"] = [(stop, step_s, 0.29, (0.31, 0.0))]
    cases["thrown at its stop, 0.25 to 1 ms"] = [(stop, 1e-3, None, (0.35, 0.0)), (stop, 1e-3, None, (1.0, 0.0)), (stop, 1e-3, None, (0.31, 0.3)),
                                                 (stop, 5e-4, None, (0.6, 0.0)), (stop, 2.5e-4, None, (0.6, 0.0))]
    cases["with dry friction of 0.03, 0.3 and 3 N·m, 1 ms"] = [(f"<dynamics><friction>{f}</friction></dynamics>", 1e-3, None, (0.2, 0.0))
                                                               for f in (0.03, 0.3, 3)]
    kinds = ("rests", "gains energy", "shakes", "blown up")
    print(f"| | of | {' | '.join(kinds)} |\n|---|---|{'---|' * len(kinds)}")
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "joint.sdf"
        for name, variants in cases.items():
            found = [outcome(file, sdf(kind, moment, axis), *how)
                     for (axis, *how), kind, moment in itertools.product(variants, TYPES, MOMENTS)]
            print(f"| {name} | {len(found)} | {' | '.join(str(found.count(k)) for k in kinds)} |", flush=True)


if __name__ == "__main__":
    main()
