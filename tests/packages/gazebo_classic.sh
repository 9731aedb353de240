#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# gazebo_classic.sh PACKAGES [OUT]: the package of the plug-in for Gazebo Classic 11, made in the private Debian 11
# (scripts/debian11_root.sh) into OUT (build/classic_packages unless said otherwise); then installed there with PACKAGES' vsasim-data,
# used from the shell as the how-to says, and purged. All of it happens in a layer over that root, which goes with the script. Root
# only. Exit code 77: it can't be done here, which it says.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
tree=$(cd "$here/../.." && pwd)
[ $# -ge 1 ] || { echo "usage: gazebo_classic.sh PACKAGES [OUT]" >&2; exit 2; }
left_out() { echo "package of Gazebo Classic left out: $1"; exit 77; }
[ "$(id -u)" -eq 0 ] || left_out "a root of its own needs to be made by root (run it with sudo -E)"
if [ -z "${IN_ITS_NAMESPACE:-}" ]; then IN_ITS_NAMESPACE=yes exec unshare --mount --propagation private sh "$0" "$@"; fi
data=$(ls "$1"/vsasim-data_*_all.deb 2>/dev/null) || { echo "gazebo_classic.sh: no package vsasim-data in $1 (make packages)" >&2; exit 2; }
out=${2:-$tree/build/classic_packages}
. "$tree/scripts/roots.sh"
use_apt_proxy
sh "$tree/scripts/debian11_root.sh" prepare || left_out "no Debian 11 with Gazebo 11"

layer=$(mktemp -d "$roots_folder/classic-XXXXXX")
trap 'umount "$layer/root" 2>/dev/null; rm -rf --one-file-system "$layer"' EXIT
mkdir "$layer/up" "$layer/work" "$layer/root"
mount -t overlay overlay -o "lowerdir=$(sh "$tree/scripts/debian11_root.sh" path),upperdir=$layer/up,workdir=$layer/work" "$layer/root" ||
  left_out "no overlay can be mounted"
mkdir "$layer/root/packages"
cp "$data" "$layer/root/packages"
cp "$here/in_classic_root.sh" "$layer/root"
SOURCE_DATE_EPOCH=$(python3 "$tree/packaging/prepare.py" --epoch)
enter "$layer/root" "$tree" /vsasim env SOURCE_DATE_EPOCH="$SOURCE_DATE_EPOCH" sh /in_classic_root.sh
rm -rf "$out"
mkdir -p "$out"
cp "$layer/root/packages"/*.deb "$out"
