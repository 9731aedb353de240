#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# packages.sh [BUILD] [OUT]: the Debian packages of BUILD in OUT (build/packages and BUILD/packages unless said otherwise). A BUILD that
# isn't there is made by the preset `packages`; one that is there, a release build that was tested say, is configured for /usr and
# stays so. An OUT that is there is empty or has packages of an earlier run, which go. JOBS bounds the compilers.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/packages}
out=${2:-$build/packages}
jobs=${JOBS:-$(nproc)}
for tool in dpkg-deb dpkg-shlibdeps file python3; do
  command -v "$tool" >/dev/null || { echo "packages.sh: $tool is missing: sh scripts/setup.sh packages" >&2; exit 1; }
done
# Before the long build: what is somebody else's isn't removed.
if [ "$(realpath -m "$out")" != "$(realpath -m "$build/packages")" ] && [ -n "$(ls -A "$out" 2>/dev/null)" ] &&
   ! grep -qs '  vsasim_[^ ]*\.deb$' "$out/SHA256SUMS"; then
  echo "packages.sh: OUT = '$out' (allowed: a new or empty folder, or one with packages of ours and their SHA256SUMS)" >&2
  exit 2
fi
# One time for all that is packed, the version's day, so that the same sources make the same packages whenever they are made.
SOURCE_DATE_EPOCH=$(python3 packaging/prepare.py --epoch)
export SOURCE_DATE_EPOCH
export LC_ALL=C.UTF-8 TZ=UTC
umask 022

say() { echo "packages: $*"; }
start=$(date +%s)
# shellcheck disable=SC2086 # CMAKE_FLAGS is words
if [ -f "$build/CMakeCache.txt" ]; then
  cmake "$build" -DCMAKE_INSTALL_PREFIX=/usr -DVSA_PACKAGES=ON -DVSA_SHARED=ON ${CMAKE_FLAGS:-} >/dev/null
else
  sh scripts/configure.sh packages -B "$build" ${CMAKE_FLAGS:-}
fi
# shellcheck disable=SC2046 # none or two words
cmake --build "$build" -j "$jobs" $(sh scripts/quiet.sh)
say "built after $(($(date +%s) - start)) s"
rm -rf "$build/packages" "$build/_CPack_Packages"
(cd "$build" && cpack -G DEB >cpack.log 2>&1) || { tail -n 20 "$build/cpack.log" >&2; exit 1; }
rm -rf "$build/_CPack_Packages"
python3 packaging/sbom.py "$build/packages" "$build"
(cd "$build/packages" && sha256sum -- *.deb *.spdx.json >SHA256SUMS)
if [ "$(realpath -m "$out")" != "$(realpath "$build/packages")" ]; then
  mkdir -p "$out"
  # Of an earlier run: what its sums tell of, and no file besides.
  [ ! -f "$out/SHA256SUMS" ] || (cd "$out" && sed 's/^[^ ]*  //' SHA256SUMS | xargs rm -f -- SHA256SUMS.asc SHA256SUMS)
  mv "$build/packages"/* "$out"
  rmdir "$build/packages"
fi
say "$(grep -c '\.deb$' "$out/SHA256SUMS") packages in $out after $(($(date +%s) - start)) s"
