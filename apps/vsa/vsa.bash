# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Completion of vsa for bash. The command itself says what can come next, so this never falls behind it.
# `cmake --install` puts it where bash-completion looks; without that: source vsa.bash
_vsa() {
  COMPREPLY=()
  local candidate
  while IFS= read -r candidate; do
    COMPREPLY+=("$candidate")
  done < <("${COMP_WORDS[0]}" --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
# Where the command knows nothing, file names.
complete -o default -F _vsa vsa
