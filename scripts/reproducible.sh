#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# reproducible.sh [FOLDER]: packages, SPDX document, sums and source archive of the last commit, made twice: in this tree, and in a clone
# in FOLDER (a temporary one unless named; named, it is kept and brought up to date) under another path, later, with other umask, home,
# zone and locale, and without a compiler cache. Prints what differs; exit code 1 where anything does.
set -eu
cd "$(dirname "$0")/.."
[ -z "$(git status --porcelain --untracked-files=no)" ] || { echo "reproducible.sh: commit first: the clone is of the last commit" >&2; exit 1; }
if [ $# -gt 0 ]; then
  mkdir -p "$1"
  work=$(cd "$1" && pwd)
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
commit=$(git rev-parse HEAD)
clone="$work/a folder/of another name/vsasim"
# A path with blanks is one more thing that differs; CMake's own packages here are fine with it.
if [ -d "$clone" ]; then git -C "$clone" fetch -q "$PWD" "$commit"; else git clone -q "$PWD" "$clone"; fi
git -C "$clone" checkout -q --detach "$commit"

make_all() { # in the present folder
  sh scripts/packages.sh build/packages >/dev/null
  sh scripts/dist.sh build/packages build/dist >/dev/null
}
start=$(date +%s)
make_all
echo "reproducible: here: $(($(date +%s) - start)) s"
start=$(date +%s)
(
  cd "$clone"
  umask 077
  mkdir -p "$work/home"
  unset CCACHE_BASEDIR CCACHE_NOHASHDIR
  export CCACHE_DISABLE=1 HOME="$work/home" TZ=Asia/Tokyo LC_ALL=C CMAKE_FLAGS=""
  make_all
)
echo "reproducible: in the clone: $(($(date +%s) - start)) s"

differ=0
for folder in build/packages/packages build/dist; do
  for file in "$folder"/* "$clone/$folder"/*; do
    name=${file##*/}
    [ -e "$folder/$name" ] && [ -e "$clone/$folder/$name" ] || { echo "only one has $folder/$name"; differ=1; continue; }
    case $file in "$folder"/*) cmp -- "$folder/$name" "$clone/$folder/$name" || differ=1 ;; esac
  done
done
count=$(find build/packages/packages build/dist -type f | wc -l)
[ "$differ" = 0 ] || { echo "reproducible: no"; exit 1; }
echo "reproducible: $count files of ${commit%"${commit#???????}"}, byte for byte the same"
