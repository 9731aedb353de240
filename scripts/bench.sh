#!/bin/sh
# Runs every benchmark of a build and prints one table each: medians over repetitions, with their spread.
set -eu
build=$1
for bench in "$build"/bin/bench_*; do
  [ -x "$bench" ] || continue
  "$bench" --benchmark_repetitions=5 --benchmark_report_aggregates_only=true --benchmark_min_time=0.3 2>/dev/null |
    grep -E 'Benchmark|----|_median|_cv' || true
done
