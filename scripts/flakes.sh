#!/usr/bin/env bash
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# flakes.sh BUILD: looks for tests that fail now and then. Runs each test of BUILD but the long ones FLAKES_N times (50) beside 0, 2 and
# 6 busy processes and with late threads (FLAKES_LOADS: 0 2 6 late), one test at a time; in every second run a program of GoogleTest's
# takes its tests in another order. With late threads BUILD's programs have tests/late/late.cpp preloaded, another pattern each run: what
# happens in the wrong order for another thread then fails in tens of runs, not in ten thousands.
# FLAKES_FILTER chooses tests (ctest -R). Prints one table, also when it is interrupted, keeps what failing runs said in FLAKES_OUT
# (out/flakes; one that is there is empty or of an earlier run, whose files go), and ends with 1 if any run failed.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
runs=${FLAKES_N:-50} filter=${FLAKES_FILTER:-.} loads=${FLAKES_LOADS:-0 2 6 late} out=${FLAKES_OUT:-out/flakes}

refuse() {
  echo "flakes.sh: $1 (allowed: $2)" >&2
  exit 2
}
[[ $runs =~ ^[1-9][0-9]{0,8}$ ]] || refuse "FLAKES_N = '$runs'" "1, 2, …"
load="(0|[1-9][0-9]{0,2}|late)"
[[ $loads =~ ^\ *$load(\ +$load)*\ *$ ]] || refuse "FLAKES_LOADS = '$loads'" "numbers of busy processes, or late: 0 2 6 late"
preload=$(cd "$build" && pwd)/tests/libvsa_late.so
[[ $loads != *late* || -f $preload ]] || refuse "FLAKES_LOADS = '$loads': there is no $preload" "numbers, or build vsa_late first"
tests=$(ctest --test-dir "$build" -N -LE long -R "$filter" 2>/dev/null | sed -n 's/^ *Test *#[0-9]*: //p') || true
[ -n "$tests" ] || refuse "FLAKES_FILTER = '$filter': no test of $build matches" "a pattern as of ctest -R"
results=$out/runs.txt # test, load, result, seconds: one line a run
if [ -n "$(ls -A "$out" 2>/dev/null)" ] && [ ! -f "$results" ]; then
  refuse "FLAKES_OUT = '$out'" "a new or empty folder, or one with an earlier run's runs.txt"
fi
mkdir -p "$out"
rm -f "$results" "$out"/*.[0-9]*.[0-9]*.txt "$out"/*.late.[0-9]*.txt
: > "$results"

# A busy process looks now and then whether this one is still there, should it be killed without a chance to end them.
busy=()
make_busy() {
  local n me=$$
  for ((n = 0; n < $1; ++n)); do
    (
      trap - EXIT
      while kill -0 "$me" 2>/dev/null; do for ((i = 0; i < 200000; ++i)); do :; done; done
    ) &
    busy+=($!)
  done
}
end_busy() {
  [ ${#busy[@]} = 0 ] || kill "${busy[@]}" 2>/dev/null || true
  busy=()
}

table() {
  awk -v loads="$loads" '
    { n[$1]++; if ($3 == "skipped") skipped[$1]++; if ($3 == "failed") bad[$1, $2]++; if ($4 > longest[$1]) longest[$1] = $4
      if (!($1 in at)) { at[$1] = ++count; name[count] = $1 } }
    END {
      k = split(loads, load, " ")
      printf "\n%-20s %6s", "test", "runs"
      for (i = 1; i <= k; ++i) printf " %16s", "failed, " load[i] (load[i] == "late" ? "" : " busy")
      printf " %10s\n", "longest, s"
      for (t = 1; t <= count; ++t) {
        printf "%-20s %6d", name[t], n[name[t]]
        for (i = 1; i <= k; ++i) { printf " %16d", bad[name[t], load[i]]; sum += bad[name[t], load[i]] }
        printf " %10.1f%s\n", longest[name[t]], skipped[name[t]] ? "  (skipped " skipped[name[t]] " times)" : ""
      }
      printf "%d failed of %d runs\n", sum, NR
    }' "$results"
}
finish() {
  end_busy
  [ ! -s "$results" ] || table
}
trap finish EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# One run of one test, as ctest knows it: its time limit, environment and what it needs to have run before.
one_run() {
  local name=$1 load=$2 run=$3 log=$out/$1.$2.$3.txt result=failed only
  only=$(sed 's/[][\\.*^$+?(){}|]/\\&/g' <<< "$name") # this name, whatever signs of patterns are in it
  local order=() # and lateness
  [ $((run % 2)) = 1 ] || order=(GTEST_SHUFFLE=1 "GTEST_RANDOM_SEED=$run")
  [ "$load" != late ] || order+=("LD_PRELOAD=$preload" "VSA_LATE_IN=${preload%/tests/*}" "VSA_LATE_SEED=$run")
  env "${order[@]}" ctest --test-dir "$build" -j 1 --output-on-failure --no-tests=error -R "^$only\$" > "$log" 2>&1 && result=passed
  local line
  line=$(grep -E "Test +#[0-9]+: $only " "$log" | tail -n 1) || true
  case $line in *Skipped*) result=skipped ;; esac
  echo "$name $load $result $(sed -nE 's/.* ([0-9.]+) sec.*/\1/p' <<< "$line")" >> "$results"
  [ $result = failed ] || rm "$log"
}

for load in $loads; do
  [ "$load" = late ] || make_busy "$load"
  for name in $tests; do
    for ((run = 1; run <= runs; ++run)); do one_run "$name" "$load" "$run"; done
    echo "load $load: $name, $runs runs, $(grep -c "^$name $load failed" "$results" || true) failed" >&2
  done
  end_busy
done
! grep -q ' failed ' "$results"
