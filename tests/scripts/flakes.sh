# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# scripts/flakes.sh on a tree of made-up tests: it runs what it says that it runs, or refuses.  bash flakes.sh SOURCE LATE_LIBRARY
set -eu
unset LD_PRELOAD VSA_LATE_IN VSA_LATE_SEED FLAKES_FILTER # of flakes.sh that runs this
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
with 2 FLAKES_LOADS="0 late"
grep -q "there is no .*/tests/libvsa_late.so" "$work/said" || fail "a build without vsa_late isn't told"
mkdir "$work/tests"
cp "$2" "$work/tests/libvsa_late.so"
printf 'add_test(preloaded "sh" "-c" "test $LD_PRELOAD = %s && test $VSA_LATE_IN = %s")\n' "$work/tests/libvsa_late.so" "$work" \
  >> "$work/CTestTestfile.cmake"
with 0 FLAKES_FILTER=preloaded FLAKES_LOADS=late
grep -q '^0 failed of 2 runs' "$work/said" || fail "late runs were counted otherwise"
with 1 FLAKES_FILTER=preloaded FLAKES_LOADS="late 0"
# 600 calls take hardly a millisecond, or a second where it is a thread's turn to be late: one in three.
copy() { (export VSA_LATE_SEED="$1" LD_PRELOAD="$2"; exec dd if=/dev/zero of=/dev/null bs=1 count=300 2>&1); }
for ((seed = 1; seed <= 200; ++seed)); do
  copy "$seed" "$2" > "$work/said"
  slow=$(sed -n 's/.*copied, \([0-9.e-]*\) s.*/\1/p' "$work/said")
  if awk -v s="$slow" 'BEGIN { exit !(s > 0.02) }'; then break; fi
done
test "$seed" -le 200 || fail "nothing was late in 200 runs"
for bad in FLAKES_N=0 FLAKES_N=-1 FLAKES_N=2x "FLAKES_LOADS= " FLAKES_LOADS=-1 FLAKES_LOADS=two FLAKES_FILTER=none; do
  with 2 "$bad"
  grep -q "${bad%%=*} = '${bad#*=}'" "$work/said" || fail "$bad isn't named"
done
