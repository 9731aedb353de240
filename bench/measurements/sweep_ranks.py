#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""How much of the processors' time was the runs', by ranks and by the runs' length: docs/lab/sweep.md.

usage: python3 bench/measurements/sweep_ranks.py BIN [RANKS …]      BIN: the build's folder of programs; default 1 2 4
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

RUNS = """
repetitions = {repetitions}
[scenario]
world = "bench_pole"
duration_s = {duration_s}
faults = ["shaft noise_rad=0.001"]
[[measure]]
name = "shaft_rad"
signal = "shaft_rad"
actuator = "shaft"
statistic = "rms"
"""
LENGTHS = """
[[vary]]
key = "scenario.duration_s"
log = [0.2, 20.0]
count = 30
"""
PLANS = {
    "200 runs of 13.3 s, simulated": RUNS.format(repetitions=200, duration_s=13.3),
    "2,000 of 1.33 s": RUNS.format(repetitions=2000, duration_s=1.33),
    "300 of 0.2 to 20 s": RUNS.format(repetitions=10, duration_s=1.0) + LENGTHS,
}


def main() -> int:
    if len(sys.argv) < 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    program = pathlib.Path(sys.argv[1], "vsa-mpi")
    if not program.exists() or shutil.which("mpirun") is None:
        print(f"sweep_ranks.py: {program if not program.exists() else 'mpirun'}: not there; sh scripts/setup.sh mpi, then build", file=sys.stderr)
        return 2
    if not all(word.isdigit() and int(word) > 0 for word in sys.argv[2:]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    ranks = [int(word) for word in sys.argv[2:]] or [1, 2, 4]
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    with tempfile.TemporaryDirectory() as scratch:
        for name, text in PLANS.items():
            for n in ranks:
                folder = pathlib.Path(scratch, f"{len(name)}-{n}")
                plan = pathlib.Path(scratch, "plan.toml")
                plan.write_text(text, encoding="utf-8")
                job = ["mpirun", "--oversubscribe", "-n", str(n), str(program), "sweep", str(plan), "--out", str(folder)]
                done = subprocess.run(job, env=environment, capture_output=True, text=True, check=False)
                told = [line for line in done.stderr.splitlines() if "CPU time" in line]
                if done.returncode != 0 or not told:
                    print(done.stderr, file=sys.stderr)
                    return 1
                print(f"{name}: {told[-1].removeprefix('vsa: ')}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
