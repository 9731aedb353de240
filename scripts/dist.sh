#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# dist.sh [BUILD] [OUT]: the source archive OUT/vsasim-VERSION.tar.xz (build/dist unless said otherwise) of the last commit, with the
# pages bundled in BUILD (build/release) in web/prebuilt, so that it is built without npm, and without git. The same commit makes the
# same bytes: times are the version's day, names are sorted, nobody owns it. An OUT that is there has no SHA256SUMS, or one of earlier
# archives only: these, and the signature of sums that are no longer, go once the new one is made.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
out=${2:-build/dist}
# In git's words: there is no repository, it belongs to somebody else, there is no git.
top=$(git rev-parse --show-toplevel 2>&1) || { echo "dist.sh: an archive is made of a commit of $PWD: ${top#fatal: }" >&2; exit 1; }
if [ "$(realpath "$top")" != "$(realpath .)" ]; then
  echo "dist.sh: an archive is made of a commit of $PWD, which has no repository of its own: it lies in that of $top" >&2
  exit 1
fi
[ -z "$(git status --porcelain --untracked-files=no)" ] || { echo "dist.sh: commit first: the archive is of the last commit" >&2; exit 1; }
for page in replay.html live.html report.html bundled.json; do
  [ -s "$build/share/vsa/web/$page" ] || { echo "dist.sh: $build has no $page: cmake --build $build --target vsa_web" >&2; exit 1; }
done
# What is somebody else's isn't removed.
if [ -e "$out/SHA256SUMS" ] && grep -Evqx '[0-9a-f]{64}  vsasim-[0-9.]+\.tar\.xz' "$out/SHA256SUMS"; then
  echo "dist.sh: OUT = '$out', whose SHA256SUMS tells of other files (allowed: a folder without one, or with that of earlier archives)" >&2
  exit 2
fi
version=$(sed -n 's/^project(vsasim VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
epoch=$(python3 packaging/prepare.py --epoch)
name=vsasim-$version
work=$(mktemp -d)
trap 'rm -rf "$work" "$out/$name.tar.xz.new" "$out/SHA256SUMS.new"' EXIT
umask 022
git archive --format=tar --prefix="$name/" HEAD | tar -x -C "$work"
mkdir "$work/$name/web/prebuilt"
for page in replay.html live.html report.html bundled.json; do cp "$build/share/vsa/web/$page" "$work/$name/web/prebuilt"; done
mkdir -p "$out"
LC_ALL=C tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$epoch" --mode=u+rwX,go+rX,go-w --format=gnu -cf "$work/$name.tar" "$name"
xz -9 -T1 -c "$work/$name.tar" >"$out/$name.tar.xz.new"
sha256sum <"$out/$name.tar.xz.new" | sed "s/-\$/$name.tar.xz/" >"$out/SHA256SUMS.new"
[ ! -f "$out/SHA256SUMS" ] || (cd "$out" && sed 's/^[^ ]*  //' SHA256SUMS | xargs rm -f -- SHA256SUMS)
rm -f "$out/SHA256SUMS.asc"
mv "$out/$name.tar.xz.new" "$out/$name.tar.xz"
mv "$out/SHA256SUMS.new" "$out/SHA256SUMS"
echo "dist: $out/$name.tar.xz, $(($(wc -c <"$out/$name.tar.xz") / 1024)) KiB"
