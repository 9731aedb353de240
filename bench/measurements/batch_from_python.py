# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What Python adds to a batch's time: PYTHONPATH=BUILD/python python3 batch_from_python.py BUILD/bin/bench_batch [COPIES]

Processor time of ten steps of COPIES (64) snakes on one thread, with commands written and angles read each time, beside bench_batch's
without; by turns, so that a shared machine does the same to both. Prints the median of the rounds' ratios with their quartiles, and
the share of the same calls with nobody to step, which is Python's own.
"""
import json
import statistics
import subprocess
import sys
import time

import numpy as np
import vsasim

ROUNDS, CALLS = 31, 15


def cpp_s(bench, copies):
    told = subprocess.run(
        [bench, f"--benchmark_filter=^ten_steps/copies:{copies}/threads:1/", "--benchmark_min_time=0.3", "--benchmark_format=json"],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    (one,) = json.loads(told.stdout)["benchmarks"]
    return one["cpu_time"] * {"ns": 1e-9, "us": 1e-6, "ms": 1e-3}[one["time_unit"]]


def python_s(world, copies, which=None):
    batch = vsasim.Batch(world, copies, threads=1)
    equilibrium, most = np.full((copies, len(batch.actuators)), 0.1), 0.0
    batch.preset[:] = 0.3
    begin = time.process_time()
    for _ in range(CALLS):
        batch.equilibrium[:] = equilibrium
        batch.step(10, which)
        most = max(most, batch.shaft_rad.max())
    return (time.process_time() - begin) / CALLS


bench, copies = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 64
world = vsasim.World.load("snake_flat")
world.run(0.5)
ratios, shares = [], []
for _ in range(ROUNDS):
    whole = python_s(world, copies)
    ratios.append(whole / cpp_s(bench, copies))
    shares.append(python_s(world, copies, []) / whole)
low, middle, high = statistics.quantiles(ratios, n=4)
print(f"Python / C++ at {copies} copies: {middle:.3f} (median of {ROUNDS}, quartiles {low:.3f} … {high:.3f})")
print(f"Python's own share: {100 * statistics.median(shares):.2f} %")
