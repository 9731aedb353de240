#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""alone.py BUILD: each C++ source that BUILD (configured with -DVSA_UNITY=OFF) compiles, through its compiler's front end.

A source that lacks an include compiles beside the others of its room, and clang-tidy looks at several together, too; where a room's
sources are compiled one by one, as Clang does by default, it doesn't. What was changed last comes first; sources that were well and
are what they were aren't looked at again (BUILD/alone.json).

ALONE_S: seconds after which no further source is begun (0: all are). ALONE_JOBS: side by side (all processors).
Ends with 1 if any source doesn't compile, with 2 for wrong use.
"""
import concurrent.futures
import os
import shlex
import subprocess
import sys
import time

import tidy


def front_end(command):
    words = shlex.split(command["command"])
    while os.path.basename(words[0]) == "ccache":
        words = words[1:]
    if "-o" in words:
        at = words.index("-o")
        del words[at : at + 2]
    done = subprocess.run([*words, "-fsyntax-only"], cwd=command["directory"], capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stderr


def main():
    listing = tidy.listing_of()
    seconds, jobs = tidy.setting("ALONE_S", 0), tidy.setting("ALONE_JOBS", os.cpu_count())
    commands = tidy.sources(listing)
    clean = tidy.Clean(listing.with_name("alone.json"), tidy.states(commands, __file__))
    known = [file for file in commands if clean.has(file)]
    rank = tidy.age()
    order = sorted((file for file in commands if not clean.has(file)), key=lambda file: tidy.newest([file], rank))
    start, looked, bad = time.monotonic(), 0, 0
    with concurrent.futures.ThreadPoolExecutor(max(1, jobs)) as pool:
        begun = lambda file: front_end(commands[file]) if not seconds or time.monotonic() - start < seconds else None  # noqa: E731
        for file, said in zip(order, pool.map(begun, order)):
            looked += said is not None
            if said == "":
                clean.add([file])
            elif said:
                bad += 1
                print(said, end="", flush=True)
    was = f", {len(known)} were well before" if known else ""
    print(f"alone: {looked} of {len(commands)} sources looked at, {bad} don't compile{was}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
