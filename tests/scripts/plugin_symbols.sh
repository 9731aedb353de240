#!/bin/sh
# plugin_symbols.sh SOURCE LIBRARY: what the units of MuJoCo's plug-in call of MuJoCo is found by plugins/mujoco/engine.cpp, which links
# none. Where no MuJoCo 3 is there nothing else would see that one is missing. LIBRARY: the units, for any MuJoCo.
set -eu
called=$(nm -u "$2" | sed -nE 's/^ *U (mju?_[A-Za-z0-9]+)$/\1/p' | sort -u)
[ -n "$called" ] || { echo "plugin_symbols.sh: $2 calls nothing of MuJoCo" >&2; exit 1; }
missing=
for name in $called; do
  grep -qE "^[a-zA-Z* ]*[ *]$name\(" "$1/plugins/mujoco/engine.cpp" && grep -qF "find(library, \"$name\"" "$1/plugins/mujoco/engine.cpp" ||
    missing="$missing $name"
done
[ -z "$missing" ] || { echo "plugin_symbols.sh: plugins/mujoco/engine.cpp doesn't find$missing" >&2; exit 1; }
