#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# sources.sh: the C++ sources of the tree, a line each, seen from its root: git's, or, where the tree is no repository, all that lie
# there but those in build, out, node_modules and hidden folders. None is an error: who looks at nothing finds nothing wrong.
set -eu
cd "$(dirname "$0")/.."
if [ -e .git ]; then
  list=$(git -c core.quotePath=false ls-files '*.cpp' '*.hpp')
else
  list=$(find . \( -name build -o -name out -o -name node_modules -o -name '.?*' \) -prune -o -type f \( -name '*.cpp' -o -name '*.hpp' \) -print |
    sed 's,^\./,,' | LC_ALL=C sort)
fi
[ -n "$list" ] || { echo "sources.sh: no *.cpp and no *.hpp in $PWD" >&2; exit 1; }
printf '%s\n' "$list"
