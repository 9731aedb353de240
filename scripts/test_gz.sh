#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Builds the plug-in for gz-sim and tests it in a real server, where gz-sim is found: on the system, or below VSA_GZ_PREFIX.
#   test_gz.sh BUILD         the tests; BUILD: the release build, for the embedded engine's side of the bench comparison
#   test_gz.sh BUILD long    every chain of the rest matrix
set -eu
cd "$(dirname "$0")/.."
build=$1
what=${2:-test}
case "$what" in
  test | long) ;;
  *) echo "test_gz.sh: '$what' (allowed: test, long)" >&2; exit 2 ;;
esac
prefix=${VSA_GZ_PREFIX:-}
if [ -n "$prefix" ]; then
  for lib in "$prefix"/lib "$prefix"/lib/*-linux-gnu; do
    [ -d "$lib/pkgconfig" ] || continue
    export PKG_CONFIG_PATH="$lib/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}"
    export LD_LIBRARY_PATH="$lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
  done
fi
found=""
for package in gz-sim gz-sim9 gz-sim8 ignition-gazebo6; do
  if pkg-config --exists "$package" 2>/dev/null; then found=$package; break; fi
done
[ -n "$found" ] || { echo "gz-sim left out: neither the system nor VSA_GZ_PREFIX has gz-sim 10, 9, 8 or ignition-gazebo6"; exit 0; }
echo "gz-sim: $found $(pkg-config --modversion "$found")"

if [ "$what" = test ]; then
  mkdir -p build/gazebo_bench
  "$build/bin/vsa-gazebo-bench" build/gazebo_bench/embedded_1ms.csv
  "$build/bin/vsa-gazebo-bench" build/gazebo_bench/embedded_025ms.csv 0.00025
fi
cmake -S . -B build/gz -G Ninja -DCMAKE_BUILD_TYPE=Release -DVSA_SIMULATOR=OFF -DVSA_TESTS=OFF -DVSA_BENCH=OFF -DVSA_GZ_SIM=ON \
  -DVSA_GAZEBO_TESTS=ON -DCMAKE_PREFIX_PATH="$prefix" -Wno-dev >/dev/null
# shellcheck disable=SC2046 # none or two words
cmake --build build/gz $(sh scripts/quiet.sh)
cd build/gz
case "$what" in
  test) ctest --output-on-failure -LE long ;;
  long) VSA_TEST_LONG=1 ctest --verbose -L long ;;
esac
