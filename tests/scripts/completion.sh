#!/bin/bash
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# completion.sh VSA SCRIPT: bash's completion of vsa, as bash would call it.
set -u
vsa=$1
source "$2" || exit 1
failed=0

# expect "WORDS…" CANDIDATES…: what Tab offers behind the last word (split at blanks; a final blank begins a new word).
expect() {
  local line=$1
  shift
  read -ra COMP_WORDS <<<"$line"
  [[ $line == *" " ]] && COMP_WORDS+=("")
  COMP_WORDS[0]=$vsa
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  COMPREPLY=(left over)
  _vsa
  if [[ "${COMPREPLY[*]-}" != "$*" ]]; then
    printf 'behind "%s"\n  expected: %s\n  offered:  %s\n' "$line" "$*" "${COMPREPLY[*]-}"
    failed=1
  fi
}

# All subcommands and all options, by the help.
subcommands=$("$vsa" --help | sed -n '/^Subcommands:/,/^$/p' | awk 'NR > 1 && /^  [a-z]/ { print $1 }' | LC_ALL=C sort | xargs)
[[ $subcommands == *characterize*run* ]] || { echo "no subcommands in: $subcommands"; failed=1; }
expect "vsa " $subcommands
for sub in $subcommands; do
  expect "vsa $sub --" $("$vsa" "$sub" --help | grep -oE '^  (-h,)?--[A-Za-z0-9-]+' | sed 's/.*--/--/' | LC_ALL=C sort -u)
done

expect "vsa ru" run
expect "vsa --v" --version
expect "vsa run snake_" snake_flat snake_hills snake_rubble
expect "vsa run --realtime snake_f" snake_flat
expect "vsa run snake_flat --ga" --gait
expect "vsa run snake_flat --gait side" sidewind sidewind_soft sidewind_stiff
expect "vsa run snake_flat --gait = side" sidewind sidewind_soft sidewind_stiff # as bash splits it
expect "vsa run snake_flat --gait=side" sidewind sidewind_soft sidewind_stiff
expect "vsa run --duration-s -1 snake_f" snake_flat
expect "vsa emulate sea_e" sea_example
expect "vsa actuators sea_e" sea_example
expect "vsa export --fmu sea_e" sea_example
expect "vsa export --fmu snake_" snake_flat snake_hills snake_rubble
expect "vsa export --fmu sea_example --fmi " 2 3
expect "vsa validate --type sea_e" sea_example
expect "vsa emulate sea_example --dialect " 6 7
expect "vsa characterize sea_example --experiment s" speed stiffness
expect "vsa run snake_flat --record "  # the shell's file names
expect "vsa run snake_flat "
expect "vsa run snake_flat --nonsense x"
expect "vsa dance "
VSA_ACTUATOR_PATH=$(mktemp -d)
export VSA_ACTUATOR_PATH
touch "$VSA_ACTUATOR_PATH/mine.toml"
expect "vsa emulate mi" mine
rm -r "$VSA_ACTUATOR_PATH"
unset VSA_ACTUATOR_PATH

# bash itself knows it, with file names where the command knows nothing.
[[ $(complete -p vsa) == "complete -o default -F _vsa vsa" ]] || { echo "registered: $(complete -p vsa)"; failed=1; }
exit $failed
