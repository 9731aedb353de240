#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# no_network.sh VSA: where no network interface is up, as in a bare namespace: a run goes on without topics and says so once, what
# needs them says why, the doctor finds it. Ends with 77 (left out) where such a namespace can't be made.
set -eu
vsa=$1
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0"
left_out() { echo "left out: $1"; exit 77; }
command -v unshare > /dev/null || left_out "no unshare"
unshare --user --map-root-user --net true 2> /dev/null || left_out "no namespaces here"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "no_network.sh: $*: $(cat "$work/out" "$work/err")" >&2; exit 1; }
alone() { code=0; unshare --user --map-root-user --net "$vsa" "$@" > "$work/out" 2> "$work/err" || code=$?; }

alone run bench_load --duration-s 0.05
[ "$code" -eq 0 ] || fail "a run ends with $code"
[ "$(grep -c "no network interface is up.*ip link set lo up" "$work/err")" -eq 1 ] || fail "a run doesn't say once that there are no topics"
alone run bench_load --duration-s 0.05 --no-topics
[ "$code" -eq 0 ] && ! grep -q "network" "$work/err" || fail "a run that asked for no topics (exit code $code)"
alone run bench_load --paused
[ "$code" -eq 2 ] && grep -q "paused.*no network interface is up" "$work/err" || fail "a run that nobody could let run (exit code $code)"
alone command 10 10 --timeout-s 1
[ "$code" -eq 2 ] && grep -q "no network interface is up" "$work/err" || fail "a command (exit code $code)"
alone doctor
[ "$code" -eq 1 ] && grep -q "^problem: network: no network interface is up" "$work/out" || fail "the doctor (exit code $code)"
