#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# gz-sim's own server with a world of models/, started by its launch line and commanded and watched with gz-sim's command-line client.
# smoke.sh PLUGIN_DIRECTORY
set -eu
source_tree=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
export HOME="$work" GZ_IP=127.0.0.1 IGN_IP=127.0.0.1 GZ_PARTITION="vsa_smoke_$$" IGN_PARTITION="vsa_smoke_$$"
export GZ_SIM_RESOURCE_PATH="$source_tree/models" GZ_SIM_SYSTEM_PLUGIN_PATH="$1"
export IGN_GAZEBO_RESOURCE_PATH="$source_tree/models" IGN_GAZEBO_SYSTEM_PLUGIN_PATH="$1"
server=
stop() {
  [ -z "$server" ] || { kill "$server" 2>/dev/null || true; wait "$server" 2>/dev/null || true; }
  rm -rf "$work"
}
trap stop EXIT

if gz sim --versions >/dev/null 2>&1; then
  topic="gz topic" messages=gz.msgs
  gz sim -s -r "$source_tree/models/worlds/bench_load.sdf" >"$work/log" 2>&1 &
elif ign gazebo --versions >/dev/null 2>&1; then
  topic="ign topic" messages=ignition.msgs
  ign gazebo -s -r "$source_tree/models/worlds/bench_load.sdf" >"$work/log" 2>&1 &
else
  echo "left out: there is neither 'gz sim' nor 'ign gazebo'"
  exit 77
fi
server=$!

joint=/model/qbmove_bench_load/joint/shaft
# What the next message of a topic says; nothing where none comes.
last() { timeout 10 $topic -e -n 1 -t "$1" 2>/dev/null | sed -n 's/^data: *//p'; }

# Messages can be lost while two processes find each other: repeat the command until the state follows.
for try in 1 2 3 4 5 6 7 8 9 10; do
  kill -0 "$server" 2>/dev/null || { echo "the server died:"; tail -n 20 "$work/log"; exit 1; }
  timeout 10 $topic -t "$joint/cmd_preset" -m "$messages.Double" -p 'data: 0.6' >/dev/null 2>&1 || true
  preset=$(last "$joint/preset")
  echo "try $try: preset ${preset:-unknown}"
  case "$preset" in
    0.5[5-9]* | 0.6*) echo "the module followed the command-line client"; exit 0 ;;
  esac
done
echo "the module never followed:"
tail -n 20 "$work/log"
exit 1
