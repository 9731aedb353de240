# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A batch's ratios on a shared machine: python3 batch_ratios.py BUILD/bin/bench_batch [ROUNDS]

Processor time of the whole process, by turns, so that others on the machine do the same to both sides; medians with quartiles.
Two threads: twice the time that one thread takes for the work, over what two take for it. That counts all that the second thread
costs (locks, caches, waking) as if both had a processor for themselves; not counted is that one waits at the end for the other's
last few copies, on average 2 of each 128.
"""
import json
import statistics
import subprocess
import sys


def run(bench, name):
    told = subprocess.run(
        [bench, f"--benchmark_filter=^{name}/", "--benchmark_min_time=0.3", "--benchmark_format=json"],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    (one,) = json.loads(told.stdout)["benchmarks"]
    return one


def cpu_s(bench, name):
    one = run(bench, name)
    return one["cpu_time"] * {"ns": 1e-9, "us": 1e-6, "ms": 1e-3}[one["time_unit"]]


def tell(what, ratios):
    low, middle, high = statistics.quantiles(ratios, n=4)
    print(f"{what}: {middle:.3f} (median of {len(ratios)}, quartiles {low:.3f} … {high:.3f})")


bench, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 15
PAIRS = {
    "256 snakes on two threads over one": (2.0, "ten_steps/copies:256/threads:1", "ten_steps/copies:256/threads:2"),
    "with parameters of their own": (2.0, "ten_steps_of_own_parameters/copies:256/threads:1", "ten_steps_of_own_parameters/copies:256/threads:2"),
    "own parameters over the World's, ten steps a call": (1.0, "ten_steps_of_equal_parameters/copies:64/threads:1", "ten_steps/copies:64/threads:1"),
    "own parameters over the World's, one step a call": (1.0, "one_step_of_equal_parameters/copies:64/threads:1", "one_step/copies:64/threads:1"),
}  # fmt: skip
ratios = {what: [] for what in PAIRS}
for _ in range(rounds):
    for what, (factor, above, below) in PAIRS.items():
        ratios[what].append(factor * cpu_s(bench, above) / cpu_s(bench, below))
for what, all_of in ratios.items():
    tell(what, all_of)
for name in ("memory_of_a_copy", "memory_of_a_copy_of_own_parameters"):
    print(f"{name}: {run(bench, name)['bytes_over_state']:.2f} times its state")
