#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# lanes.sh OBJECT…: of what is compiled for one instruction set, nothing may have a name that other code shares (vsa/lanes.hpp): a
# linker would take one of them for all, and a machine without that set would run it.
set -eu
bad=0 seen=0
for object in "$@"; do
  case "$object" in */lanes/avx2.cpp.o) set_name=Avx2 ;; */lanes/avx512.cpp.o) set_name=Avx512 ;; *) continue ;; esac
  seen=$((seen + 1))
  shared=$(nm -C "$object" | grep -E ' [WVu] ' | grep -v -e "$set_name" -e DW.ref. || true)
  [ -z "$shared" ] && continue
  echo "$object: shared names:"
  echo "$shared"
  bad=1
done
echo "$seen instruction sets looked at"
# A build for x86-64 has both (src/CMakeLists.txt): with fewer, objects are named otherwise than above and nothing was tested.
case $(uname -m) in
  x86_64 | amd64 | AMD64) [ "$seen" -ge 2 ] || { echo "lanes.sh: of AVX2 and AVX-512, $seen among the $# objects given" >&2; exit 1; } ;;
esac
[ "$bad" = 0 ]
