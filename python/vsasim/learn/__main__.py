# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""python3 -m vsasim.learn grid TASK | table [TASK …] | demo: see --help."""
from __future__ import annotations

import argparse
import pathlib
import sys

import vsasim

from ..envs import TASKS
from . import commands


def whole(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{value}: 1 or more")
    return value


def natural(text: str) -> int:
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{value}: 0 or more")
    return value


def main() -> int:
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")  # an encoding that lacks a letter is no reason to end in the midst of a table
    parser = argparse.ArgumentParser(prog="python3 -m vsasim.learn", description="Tasks, their baselines, and a small learner.")
    parser.add_argument("--threads", type=int, default=0, help="how many step the worlds; 0, as left out: as many as there are")
    of = parser.add_subparsers(dest="command", required=True)
    grid = of.add_parser("grid", help="a task's baseline over its grid, seeds 1 … 8: the ten best")
    grid.add_argument("task", choices=TASKS)
    table = of.add_parser("table", help="baseline against learned, on seeds that neither was made with; minutes")
    table.add_argument("tasks", nargs="*", metavar="TASK", help=f"of {', '.join(TASKS)}; none: all")
    table.add_argument("--seed", type=natural, default=1, help="of the learner; 1, where left out")
    table.add_argument("--tests", type=whole, default=5, help="how many seeds, from 901 on; 5, where left out")
    table.add_argument("--constant", action="store_true", help="the learner has the baseline's constant presets")
    table.add_argument("--preset-rad", type=float, help="with this value instead of theirs; goes with --constant")
    table.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/learn"), help="where the parameters go; out/learn")
    demo = of.add_parser("demo", help="learns one task and records what came of it")
    demo.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/demo-python"), help="out/demo-python, where left out")
    given = parser.parse_args()
    try:
        if given.command == "grid":
            for parameters, score in commands.grid(given.task, given.threads)[:10]:
                print(f"{score:8.3f} {TASKS[given.task].score_unit}  {parameters}")
        elif given.command == "table":
            wrong = [t for t in given.tasks if t not in TASKS]
            if wrong:
                parser.error(f"no such task: {', '.join(wrong)} (allowed: {', '.join(TASKS)})")
            names = given.tasks or list(TASKS)
            if given.preset_rad is not None and not given.constant:
                parser.error("--preset-rad goes with --constant")
            commands.make_writable(given.out)
            print("| task | unit | baseline | learned | better on |\n| --- | --- | --- | --- | --- |", flush=True)
            for row in commands.table(
                names,
                directory=given.out,
                seed=given.seed,
                tests=given.tests,
                constant=given.constant,
                preset_rad=given.preset_rad,
                threads=given.threads,
            ):
                print(row, flush=True)
        else:
            commands.make_writable(given.out)
            commands.demo(given.out, given.threads)
    except vsasim.InputError as error:
        print(error, file=sys.stderr)
        return 2
    except OSError as error:  # OutputError among them
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
