#!/bin/sh
# Runs every benchmark of a build and prints one table each: medians over repetitions, with their spread. One that fails ends it, with
# its words and its exit code.
set -eu
build=$1
set -- "$build"/bin/bench_*
[ -x "$1" ] || { echo "bench.sh: $build/bin has no benchmarks: configure it with -DVSA_BENCH=ON and build it" >&2; exit 1; }
said=$(mktemp)
trap 'rm -f "$said"' EXIT
for bench in "$@"; do
  # What it says besides the table, of the machine mostly, is kept for when it fails.
  table=$("$bench" --benchmark_repetitions=5 --benchmark_report_aggregates_only=true --benchmark_min_time=0.3 2>"$said") || {
    code=$?
    printf '%s\n' "$table" >&2
    cat "$said" >&2
    echo "bench.sh: $bench: exit code $code" >&2
    exit "$code"
  }
  printf '%s\n' "$table" | grep -E 'Benchmark|----|_median|_cv' || { echo "bench.sh: $bench has no benchmarks" >&2; exit 1; }
done
