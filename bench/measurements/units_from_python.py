# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""How many environment steps of units alone a core takes.

    PYTHONPATH=BUILD/python python3 units_from_python.py BUILD/bin/bench_actuator [UNITS [TYPE]]

An environment: a unit with a lever. A step of it: a command written, ten steps of 1 ms, what it reads taken. UNITS (4096) of TYPE
(qbmove_maker_pro_6_1), whose commands differ; processor time on one thread. By turns with bench_actuator's pair of sinh and cosh,
since a shared machine's speed changes; prints the medians of the rounds.
"""
import json
import statistics
import subprocess
import sys
import time

import numpy as np
import vsasim

ROUNDS, CALLS, STEPS = 15, 20, 10


def pair_ns(bench):
    told = subprocess.run(
        [bench, "--benchmark_filter=^sinh_cosh_pair$", "--benchmark_min_time=0.2", "--benchmark_format=json"],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    (one,) = json.loads(told.stdout)["benchmarks"]
    return one["cpu_time"] * {"ns": 1, "us": 1e3, "ms": 1e6}[one["time_unit"]]


bench, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 4096
name = sys.argv[3] if len(sys.argv) > 3 else "qbmove_maker_pro_6_1"
units = vsasim.UnitBatch(vsasim.ActuatorType.load(name), count, inertia_kgm2=2e-3, damping_Nms_per_rad=0.01, gravity_Nm=0.3)
random = np.random.default_rng(1)
commands = random.uniform(-1, 1, (CALLS, count))
units.preset = random.uniform(0, 0.6, count)
read = units.read()
rates, pairs = [], []
for _ in range(ROUNDS):
    begin = time.process_time()
    for call in range(CALLS):
        units.equilibrium = commands[call]
        units.step(STEPS)
        units.read(out=read)
    rates.append(CALLS * count / (time.process_time() - begin))
    pairs.append(1e9 / rates[-1] / pair_ns(bench))
print(f"{count} of {name}, {units.width} side by side ({units.instructions}): {statistics.median(rates):,.0f} environment steps a second and core")
print(f"a step of {STEPS} ms: {statistics.median(pairs):.0f} pairs of sinh and cosh")
