# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# setup.sh of two installations in one shell: the last that was sourced is first everywhere, and once.  SHELL setup_sh.sh SOURCE
set -eu
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for prefix in "$work/a place" "$work/b*"; do
  mkdir -p "$prefix"
  sed -e "s|@CMAKE_INSTALL_PREFIX@|$prefix|" -e 's|@CMAKE_INSTALL_DATADIR@|share|' -e 's|@CMAKE_INSTALL_BINDIR@|bin|' \
    -e 's|@CMAKE_INSTALL_LIBDIR@|lib|' "$source/plugins/setup.sh.in" > "$prefix/setup.sh"
done
unset VSA_DATA_DIR IGN_GAZEBO_RESOURCE_PATH IGN_GAZEBO_SYSTEM_PLUGIN_PATH GZ_SIM_SYSTEM_PLUGIN_PATH
# What is there already, Classic's own too, stays behind; in a name, signs of patterns are letters.
export GZ_SIM_RESOURCE_PATH="/somewhere else:/b" GAZEBO_PLUGIN_PATH=/classic GAZEBO_MODEL_PATH=/classic
before=$PATH
is() { # VARIABLE EXPECTED
  eval "value=\$$1"
  test "$value" = "$2" || { echo "setup_sh.sh: $1 is '$value', not '$2'" >&2; exit 1; }
}
expect() { # FIRST SECOND
  is VSA_DATA_DIR "$1/share/vsa"
  is PATH "$1/bin:${2:+$2/bin:}$before"
  is GAZEBO_PLUGIN_PATH "$1/lib/gazebo-11/plugins:${2:+$2/lib/gazebo-11/plugins:}/classic"
  is GZ_SIM_RESOURCE_PATH "$1/share/vsa/models:${2:+$2/share/vsa/models:}/somewhere else:/b"
  is IGN_GAZEBO_SYSTEM_PLUGIN_PATH "$1/lib/gz-sim/plugins${2:+:$2/lib/gz-sim/plugins}"
}
. "$work/a place/setup.sh"
expect "$work/a place" ""
. "$work/a place/setup.sh"
expect "$work/a place" ""
. "$work/b*/setup.sh"
expect "$work/b*" "$work/a place"
. "$work/a place/setup.sh"
expect "$work/a place" "$work/b*"
