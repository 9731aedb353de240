#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# fuzz.sh SECONDS: builds the harnesses of tests/fuzz with clang and runs each for so long, side by side. What libFuzzer finds worth
# keeping stays in build/fuzz/corpus, so that the next run goes on from there; a crash leaves its input beside it.
set -eu
cd "$(dirname "$0")/.."
seconds=$1
case "$seconds" in
  '' | *[!0-9]* | 0*) echo "fuzz.sh: FUZZ_S = '$seconds': not a number of seconds (allowed: 1, 2, …)" >&2; exit 2 ;;
esac
sh scripts/setup.sh fuzz
clang=clang++-14  # as setup.sh has it; Debian 13 has a later one
command -v $clang >/dev/null 2>&1 || clang=clang++-19

cmake -S . -B build/fuzz -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DVSA_FUZZ=ON -DVSA_SIMULATOR=OFF -DVSA_BENCH=OFF -DVSA_TESTS=OFF \
  -DCMAKE_CXX_COMPILER=$clang -Wno-dev >/dev/null
# shellcheck disable=SC2046 # none or two words
cmake --build build/fuzz --target fuzz_frame fuzz_unit $(sh scripts/quiet.sh)

run() {
  mkdir -p "build/fuzz/corpus/$1"
  "build/fuzz/bin/fuzz_$1" -max_total_time="$seconds" -max_len=4096 -print_final_stats=1 -artifact_prefix="build/fuzz/$1-" \
    "build/fuzz/corpus/$1" >"build/fuzz/$1.log" 2>&1
}
tell() {
  grep -E 'ERROR|runtime error|Done|number_of_executed_units' "build/fuzz/$1.log" | sed "s/^/$1: /" || true
  [ "$2" -eq 0 ] || { tail -n 30 "build/fuzz/$1.log"; echo "$1: the fuzzer stopped with $2"; }
}
run frame & frame=$!
unit_code=0; run unit || unit_code=$?
frame_code=0; wait $frame || frame_code=$?
tell frame $frame_code
tell unit $unit_code
[ $frame_code -eq 0 ] && [ $unit_code -eq 0 ]
