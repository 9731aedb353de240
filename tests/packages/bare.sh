#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# bare.sh PACKAGES [SUITE]: the packages in that folder installed, used, upgraded and purged in a bare Debian (bookworm unless said
# otherwise) made by debootstrap. Root only. The root is made once, below ${XDG_CACHE_HOME:-~/.cache}/vsasim, and copied for each run.
# Exit code 77: it can't be done here, which it says.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../../scripts/roots.sh"
packages=$(cd "$1" && pwd)
suite=${2:-bookworm}
left_out() { echo "bare root left out: $1"; exit 77; }
[ "$(id -u)" -eq 0 ] || left_out "a root of its own needs to be made by root (run it with sudo -E)"
command -v debootstrap >/dev/null 2>&1 || left_out "debootstrap is not installed (sh scripts/setup.sh roots)"
ls "$packages"/vsasim_*.deb >/dev/null 2>&1 || { echo "bare.sh: no package vsasim in $packages (make packages)" >&2; exit 1; }

use_apt_proxy
base="$roots_folder/bare-$suite"
if [ ! -f "$base/.vsasim" ]; then
  rm -rf "$base"
  echo "bare root: making one of $suite (once)"
  why=$(bootstrap "$suite" "$base") || left_out "$why"
  touch "$base/.vsasim"
fi
root=$(mktemp -d "$roots_folder/packages-XXXXXX")
trap 'rm -rf --one-file-system "$root"' EXIT
cp -a --reflink=auto "$base/." "$root"
mkdir "$root/packages" "$root/first"
cp "$packages"/*.deb "$root/packages"
cp "$here/in_root.sh" "$root"
# A first version to be upgraded from: these packages with an older number, and a file that the second hasn't any more.
python3 "$here/older.py" "$packages" "$root/first" 0.0.9-1
enter "$root" "$here" /tests sh /in_root.sh
