#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# man.sh VSA PAGE: the man page names every subcommand and every option that the help names, and groff has nothing to say about it.
vsa=$1 page=$2 failed=0
text=$(sed 's/\\-/-/g; s/\\f[BIR]//g' "$page") || exit 1

has() {
  printf '%s\n' "$text" | grep -qxE -e "$1" && return
  echo "not in the man page: $1"
  failed=1
}

subcommands=$("$vsa" --help | sed -n '/^Subcommands:/,/^$/p' | awk 'NR > 1 && /^  [a-z]/ { print $1 }')
[ -n "$subcommands" ] || { echo "the help lists no subcommand" && exit 1; }
has '--version'
for sub in $subcommands; do
  has "\.SS $sub"
  options=$("$vsa" "$sub" --help | grep -oE '^  (-h,)?--[A-Za-z0-9-]+' | sed 's/.*--/--/')
  # Within its own section: from its head to the next.
  section=$(printf '%s\n' "$text" | sed -n "/^\.SS $sub\$/,/^\.S[SH] /p")
  for option in $options; do
    printf '%s\n' "$section" | grep -qE -e "^(-h, )?$option( |\$)" || { echo "$sub: no $option in the man page" && failed=1; }
  done
  # Examples: in the help of every subcommand, and here.
  for where in "$("$vsa" "$sub" --help)" "$section"; do
    printf '%s\n' "$where" | grep -qE "^(Example: |  )vsa $sub" || { echo "$sub: no example" && failed=1; }
  done
done
LC_ALL=C grep -n '[^ -~]' "$page" && echo "not ASCII" && failed=1
if command -v groff >/dev/null; then
  said=$(groff -man -ww -Tutf8 -z "$page" 2>&1)
  [ -z "$said" ] || { echo "$said" && failed=1; }
else
  echo "groff left out: it isn't installed (Debian: apt install groff-base)"
fi
exit $failed
