#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# gzserver with a world of models/, commanded and watched with Gazebo's own command-line client.  smoke.sh PLUGIN_DIRECTORY
set -eu
source_tree=$(cd "$(dirname "$0")/../.." && pwd)
export VSA_DATA_DIR="$source_tree" GAZEBO_MODEL_PATH="$source_tree/models" GAZEBO_PLUGIN_PATH="$1" GAZEBO_MODEL_DATABASE_URI="" GAZEBO_IP=127.0.0.1 IGN_IP=127.0.0.1
export GAZEBO_MASTER_URI="http://127.0.0.1:$((20000 + $$ % 20000))" IGN_PARTITION="vsa_smoke_$$"
log=$(mktemp)
gzserver "$source_tree/models/worlds/bench_load.sdf" >"$log" 2>&1 &
server=$!
trap 'kill "$server" 2>/dev/null || true; wait "$server" 2>/dev/null || true; rm -f "$log"' EXIT

joint=/model/qbmove_bench_load/joint/shaft
# The last preset that the robot told; nothing where none comes within 2 s.
preset() {
  timeout 10 gz topic -u -e /model/qbmove_bench_load/vsa/readings -d 2 2>/dev/null |
    sed -n 's|.*name: "shaft/preset" value { type: DOUBLE double_value: \([^ ]*\).*|\1|p' | tail -n 1
}

# Messages can be lost while two processes find each other: repeat the command until the state follows.
for try in 1 2 3 4 5 6 7 8 9 10; do
  kill -0 "$server" 2>/dev/null || { echo "gzserver died:"; tail -n 20 "$log"; exit 1; }
  timeout 10 gz topic -p "$joint/cmd_preset" -m 'type: DOUBLE double_value: 0.6' >/dev/null 2>&1 || true
  preset=$(preset)
  echo "try $try: preset ${preset:-unknown}"
  case "$preset" in
    0.5[5-9]* | 0.6*) echo "the module followed the command-line client"; exit 0 ;;
  esac
done
echo "the module never followed:"
tail -n 20 "$log"
exit 1
