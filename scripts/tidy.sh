#!/usr/bin/env bash
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# tidy.sh BUILD: clang-tidy (.clang-tidy) over the C++ sources that BUILD compiles, those first that were changed last. TIDY_S: seconds
# after which no further file is begun (0: all are checked). TIDY_JOBS: files side by side (all processors). Ends with 1 if any file
# isn't clean.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1 seconds=${TIDY_S:-0} jobs=${TIDY_JOBS:-$(nproc)}
case "$seconds$jobs" in *[!0-9]*) echo "tidy.sh: TIDY_S = '$seconds', TIDY_JOBS = '$jobs': whole numbers" >&2; exit 2 ;; esac
[ -e "$build/compile_commands.json" ] || { echo "tidy.sh: $build: no compile_commands.json: configure it first" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

sed -n "s|.*\"file\": \"$PWD/\(.*\.cpp\)\".*|\1|p" "$build/compile_commands.json" | sort -u > "$work/compiled"
# A history of one commit has no order; what isn't committed comes first.
{ git diff --name-only HEAD; git log --name-only --format= 2>/dev/null || true; git ls-files; } |
  awk 'NR == FNR { ours[$0]; next } $0 in ours && !seen[$0]++' "$work/compiled" - > "$work/order"

export build seconds work
check() {
  [ "$seconds" = 0 ] || [ "$SECONDS_AT_START" -gt $(($(date +%s) - seconds)) ] || return 0
  echo "$1" >> "$work/checked"
  # GCC's own options mean nothing to clang; they are no fault of a file.
  clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-ignored-optimization-argument "$1" \
    > "$work/$(echo "$1" | tr / _)" 2> /dev/null || echo "$1" >> "$work/unclean"
}
export -f check
SECONDS_AT_START=$(date +%s)
export SECONDS_AT_START
xargs -P "$jobs" -I{} bash -c 'check {}' < "$work/order"

touch "$work/unclean" "$work/checked"
while read -r file; do cat "$work/$(echo "$file" | tr / _)"; done < "$work/unclean"
echo "clang-tidy: $(wc -l < "$work/checked") of $(wc -l < "$work/order") sources checked, $(wc -l < "$work/unclean") not clean"
[ ! -s "$work/unclean" ]
