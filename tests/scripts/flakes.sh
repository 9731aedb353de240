# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# scripts/flakes.sh on a tree of made-up tests: it runs what it says that it runs, or refuses.  bash flakes.sh SOURCE
set -eu
flakes=$1/scripts/flakes.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "flakes.sh: $*" >&2; cat "$work/said"; exit 1; }
printf 'add_test([=[%s]=] "%s")\n' 'good.a+b(c)[d]' true 'good' true 'bad*{1}|^$' false > "$work/CTestTestfile.cmake"
with() { # EXIT_CODE VARIABLE=VALUE…
  local code=0 wanted=$1
  shift
  env FLAKES_N=2 FLAKES_LOADS=0 FLAKES_OUT="$work/out" "$@" bash "$flakes" "$work" > "$work/said" 2>&1 || code=$?
  test "$code" = "$wanted" || fail "$*: code $code, not $wanted"
}
with 0 FLAKES_FILTER=good
grep -q '^0 failed of 4 runs' "$work/said" || fail "not 2 tests twice"
with 1
grep -q '^2 failed of 6 runs' "$work/said" || fail "a test that fails was counted otherwise"
for bad in FLAKES_N=0 FLAKES_N=-1 FLAKES_N=2x "FLAKES_LOADS= " FLAKES_LOADS=-1 FLAKES_LOADS=two FLAKES_FILTER=none; do
  with 2 "$bad"
  grep -q "${bad%%=*} = '${bad#*=}'" "$work/said" || fail "$bad isn't named"
done
