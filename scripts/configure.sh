#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# configure.sh PRESET [ARGUMENT…]: cmake --preset, of which it shows warnings, errors and the features that this build lacks. The
# presets need CMake 3.21, which is newer than what CMakeLists.txt needs: without presets Debian 11's builds the Gazebo plug-in.
set -eu
cd "$(dirname "$0")/.."
needed=3.21
version=$(cmake --version 2>/dev/null | sed -n '1s/^cmake version //p')
if [ "$(printf '%s\n%s\n' "$needed" "$version" | sort -V | head -n 1)" != "$needed" ]; then
  echo "configure.sh: cmake on the PATH is ${version:+$version, }$(command -v cmake || echo missing) (allowed: $needed or later)" >&2
  exit 1
fi
preset=$1
shift
said=$(mktemp 2>/dev/null) ||
  { echo "configure.sh: TMPDIR = ${TMPDIR:-/tmp}: no file can be written there (allowed: a folder with space)" >&2; exit 1; }
trap 'rm -f "$said"' EXIT
cmake --preset "$preset" "$@" >"$said"
sed -n 's/^-- \(.*: left out: .*\)/configure: \1/p' "$said"
