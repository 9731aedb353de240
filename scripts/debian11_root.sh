#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# A private Debian 11 with Gazebo Classic 11, for machines whose own distribution has none.
#
#   debian11_root.sh prepare            make it once (about 0.5 GB to download, 3 GB on disk), keep it
#   debian11_root.sh run COMMAND…       run a command in it; this source tree is /vsasim there
#   debian11_root.sh path               where it is
#
# It lies under ${XDG_CACHE_HOME:-~/.cache}/vsasim; roots.sh says how it is made and entered. Exit code 3: not to be had here, with
# one line that says why.
set -eu

source_tree=$(cd "$(dirname "$0")/.." && pwd)
. "$source_tree/scripts/roots.sh"
root="$roots_folder/debian11"
packages="g++ ccache cmake ninja-build pkg-config libtinyxml2-dev libfmt-dev nlohmann-json3-dev libgtest-dev
  gazebo libgazebo-dev libignition-transport-dev libignition-msgs-dev"

left_out() { echo "Classic left out: $1"; exit 3; }

prepare() {
  want="$packages $(dpkg-query -W -f='${Version}' libtomlplusplus-dev 2>/dev/null || echo none)"
  if [ -f "$root/.vsasim" ] && [ "$(cat "$root/.vsasim")" = "$want" ]; then return 0; fi
  [ "$(id -u)" -eq 0 ] || left_out "a private Debian 11 root needs to be made by root (run it with sudo -E)"
  command -v debootstrap >/dev/null 2>&1 || left_out "debootstrap is not installed"
  [ -d /usr/include/toml++ ] || left_out "libtomlplusplus-dev is not installed"
  # One at a time (what starts in it doesn't keep the lock); who waited may find it made. The root that is there stays in use until another takes its place.
  mkdir -p "$roots_folder"
  exec 9>"$root.lock"
  flock 9
  if [ -f "$root/.vsasim" ] && [ "$(cat "$root/.vsasim")" = "$want" ]; then return 0; fi
  rm -rf "$root.part" "$root.old"
  mkdir -p "$root.part"
  use_apt_proxy
  echo "classic: making a Debian 11 root with Gazebo 11 in $root (once)"
  why=$(bootstrap bullseye "$root.part" 9>&-) || left_out "$why"
  # shellcheck disable=SC2086 # the list is words on purpose
  if ! enter "$root.part" "$source_tree" /vsasim sh -c 'apt-get update -qq && apt-get install -y -qq --no-install-recommends "$@" && apt-get clean' \
       sh $packages >>"$root.part.log" 2>&1 9>&-; then
    tail -n 5 "$root.part.log" >&2
    left_out "its packages could not be installed, see $root.part.log"
  fi
  cp -r /usr/include/toml++ "$root.part/usr/include/"
  echo "$want" >"$root.part/.vsasim"
  [ ! -e "$root" ] || mv "$root" "$root.old"
  mv "$root.part" "$root"
  rm -rf "$root.old"
}

case "${1:-}" in
  prepare) prepare ;;
  path) echo "$root" ;;
  run)
    shift
    [ -f "$root/.vsasim" ] || { echo "debian11_root.sh: not prepared" >&2; exit 1; }
    enter "$root" "$source_tree" /vsasim env -C /vsasim "$@"
    ;;
  *) echo "usage: debian11_root.sh prepare | run COMMAND… | path" >&2; exit 2 ;;
esac
