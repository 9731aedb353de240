#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""How vsa-mpi's dealing scales, simulated: sweep_schedule.py

Rank 0 deals chunks of max(1, left/(3·ranks)) runs (vsa/sweep/pool.hpp) and answers one question at a time; a rank asks when it begins
the last run that it has. Printed: the part of all ranks' time that was runs, the questions, the part of the time in which rank 0
answered, and the longest that a rank waited.
"""
import heapq
import itertools
import math
import random

SHARE = 3


def simulate(points, ranks, run_s, spread=1.0, answer_s=20e-6, latency_s=50e-6, seed=1):
    """Runs of run_s in the mean; spread: longest over shortest, log-uniform."""
    dice = random.Random(seed)
    low = run_s if spread == 1 else run_s * math.log(spread) / (spread - 1)

    def length():
        return run_s if spread == 1 else low * spread ** dice.random()

    left, free_at, answering, questions, worst = points, 0.0, 0.0, 0, 0.0
    work = end = 0.0
    order = itertools.count()
    # (when the question is asked, tie, when the rank has nothing more to run)
    asked = [(0.0, next(order), 0.0) for _ in range(ranks)]
    heapq.heapify(asked)
    while asked:
        when, _, idle_from = heapq.heappop(asked)
        begin = max(free_at, when + latency_s)
        free_at = begin + answer_s
        answering += answer_s
        questions += 1
        chunk = min(left, max(1, left // (SHARE * ranks)))
        left -= chunk
        if chunk == 0:
            end = max(end, idle_from)
            continue
        arrives = free_at + latency_s
        start = max(idle_from, arrives)
        worst = max(worst, arrives - idle_from if idle_from > 0 else 0.0)
        total = 0.0
        for _ in range(chunk - 1):
            total += length()
        last = length()
        work += total + last
        heapq.heappush(asked, (start + total, next(order), start + total + last))
    return work / (ranks * end), questions, answering / end, worst


def main():
    print("| points | ranks | run | longest/shortest | latency | runs' part | questions | rank 0 answers | longest wait |")
    print("|---|---|---|---|---|---|---|---|---|")
    for points, ranks, run_s, spread, latency_s in (
            (1000, 4, 0.05, 1, 50e-6), (1000, 4, 0.005, 1, 50e-6), (1000, 4, 0.05, 100, 50e-6), (1000, 4, 0.05, 1, 0.05),
            (10**6, 1000, 0.05, 1, 50e-6), (10**6, 1000, 0.05, 100, 50e-6), (10**6, 1000, 0.005, 1, 50e-6),
            (10**6, 1000, 0.005, 100, 50e-6), (10**6, 1000, 0.001, 1, 50e-6), (10**6, 1000, 0.05, 1, 0.05)):
        part, questions, busy, worst = simulate(points, ranks, run_s, spread, latency_s=latency_s)
        print(f"| {points} | {ranks} | {1e3 * run_s:g} ms | {spread} | {1e3 * latency_s:g} ms | {part:.3f} | {questions} "
              f"| {100 * busy:.1f} % | {1e3 * worst:.1f} ms |")


if __name__ == "__main__":
    main()
