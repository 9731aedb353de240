#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Builds the plug-in for Gazebo Classic 11 and tests it in a real Gazebo: the system's own where it has one, else that of a private
# Debian 11 (debian11_root.sh).
#
#   test_gazebo.sh BUILD          the tests; BUILD: the release build, for the embedded engine's side of the bench comparison
#   test_gazebo.sh BUILD long     ten simulated minutes and 100 spawned models, only where Gazebo 11 or the private root is there already
#   test_gazebo.sh BUILD bench    what the plug-in costs beside the physics; with VSA_PEER_WORLD, a world file below this source tree,
#                                 beside that world's plug-ins instead (GAZEBO_MODEL_PATH and GAZEBO_PLUGIN_PATH, relative to the tree,
#                                 find them)
set -eu
cd "$(dirname "$0")/.."
build=$1
what=${2:-test}
case "$what" in
  test | long | bench) ;;
  *) echo "test_gazebo.sh: '$what' (allowed: test, long, bench)" >&2; exit 2 ;;
esac

say() { echo "classic: $1"; }
start=$(date +%s)
if pkg-config --atleast-version=11 gazebo 2>/dev/null; then
  run() { "$@"; }
else
  if [ "$what" = long ] && [ ! -f "$(sh scripts/debian11_root.sh path)/.vsasim" ]; then
    echo "Classic left out: no Gazebo 11 here (make test-gazebo makes one)"
    exit 0
  fi
  # 3: not to be had here, which it has said.
  sh scripts/debian11_root.sh prepare || { code=$?; [ "$code" -eq 3 ] && exit 0; exit "$code"; }
  run() { sh scripts/debian11_root.sh run "$@"; }
fi
say "Gazebo 11 at hand after $(($(date +%s) - start)) s"

if [ "$what" = test ]; then
  mkdir -p build/gazebo_bench
  "$build/bin/vsa-gazebo-bench" build/gazebo_bench/embedded_1ms.csv
  "$build/bin/vsa-gazebo-bench" build/gazebo_bench/embedded_025ms.csv 0.00025
  say "embedded engine's bench runs after $(($(date +%s) - start)) s"
fi

mkdir -p build
run sh -c '
  set -e
  cmake -S . -B build/classic -G Ninja -DCMAKE_BUILD_TYPE=Release -DVSA_SIMULATOR=OFF -DVSA_TESTS=OFF -DVSA_BENCH=OFF \
    -DVSA_GAZEBO_CLASSIC=ON -DVSA_GAZEBO_TESTS=ON -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -Wno-dev >/dev/null
  cmake --build build/classic
' >build/classic_build.log || { tail -n 40 build/classic_build.log; exit 1; }
say "built after $(($(date +%s) - start)) s"
case "$what" in
  test) run sh -c 'cd build/classic && ctest --output-on-failure -LE long' ;;
  long) run sh -c 'cd build/classic && VSA_TEST_LONG=1 ctest --verbose -L long' ;;
  bench)
    if [ -n "${VSA_PEER_WORLD:-}" ]; then
      run env GAZEBO_MODEL_PATH="${GAZEBO_MODEL_PATH:-}" GAZEBO_PLUGIN_PATH="${GAZEBO_PLUGIN_PATH:-}" \
        build/classic/bin/gazebo_classic_overhead ode "$VSA_PEER_WORLD"
    else
      run sh -c 'build/classic/bin/gazebo_classic_overhead ode && build/classic/bin/gazebo_classic_overhead dart'
    fi
    ;;
esac
say "$(($(date +%s) - start)) s in all"
