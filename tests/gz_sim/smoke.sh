#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# gz-sim's own server with a world of models/, started by its launch line and commanded and watched with gz-sim's command-line client.
# smoke.sh PLUGIN_DIRECTORY
set -eu
source_tree=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
export HOME="$work" GZ_IP=127.0.0.1 IGN_IP=127.0.0.1 GZ_PARTITION="vsa_smoke_$$" IGN_PARTITION="vsa_smoke_$$"
export VSA_DATA_DIR="$source_tree" GZ_SIM_RESOURCE_PATH="$source_tree/models" GZ_SIM_SYSTEM_PLUGIN_PATH="$1"
export IGN_GAZEBO_RESOURCE_PATH="$source_tree/models" IGN_GAZEBO_SYSTEM_PLUGIN_PATH="$1"
server=
stop() {
  [ -z "$server" ] || { kill "$server" 2>/dev/null || true; wait "$server" 2>/dev/null || true; }
  rm -rf "$work"
}
trap stop EXIT

# Debian's `ign topic` looks for its program in the wrong place and dies; the program itself works (docs/reference/topics.md).
debians_topic=/usr/libexec/ignition/transport11/ign-transport-topic
world="$source_tree/models/worlds/bench_load.sdf"
if gz sim --versions >/dev/null 2>&1; then
  gazebo="gz sim" messages=gz.msgs
  if timeout 20 gz topic -l >/dev/null 2>&1; then topic="gz topic"; else topic=; fi
elif version=$(ign gazebo --versions 2>/dev/null); then
  gazebo="ign gazebo" messages=ignition.msgs
  if timeout 20 ign topic -l >/dev/null 2>&1; then topic="ign topic"; elif [ -x "$debians_topic" ]; then topic=$debians_topic; else topic=; fi
  # Before 6.8 a world whose models have plug-ins gets no systems by itself: those of the how-to, then.
  if [ "$(printf '%s\n' 6.8 "$(echo "$version" | head -n 1)" | sort -V | head -n 1)" != 6.8 ]; then
    { sed '/<world /q' "$world"; grep '<plugin filename="ignition-gazebo-' "$source_tree/docs/howto/gazebo.md"; sed '1,/<world /d' "$world"; } >"$work/world.sdf"
    world="$work/world.sdf"
  fi
else
  echo "left out: there is neither 'gz sim' nor 'ign gazebo'"
  exit 77
fi
[ -n "$topic" ] || { echo "left out: this machine's command-line client for topics doesn't run"; exit 77; }
$gazebo -s -r "$world" >"$work/log" 2>&1 &
server=$!

model=/model/qbmove_bench_load
# What the next message of a topic says; nothing where none comes.
next_of() { timeout 10 $topic -e -n 1 -t "$1" 2>/dev/null || true; }
say() { timeout 10 $topic -t "$model/joint/shaft/$1" -m "$messages.Double" -p "data: $2" >/dev/null 2>&1 || true; }

# Messages can be lost while two processes find each other: repeat the commands until the state follows. The motors turn without a
# physics; the shaft doesn't.
for try in 1 2 3 4 5 6 7 8 9 10; do
  kill -0 "$server" 2>/dev/null || { echo "the server died:"; tail -n 20 "$work/log"; exit 1; }
  if grep 'no physics moves it' "$work/log"; then exit 1; fi
  say cmd_preset 0.6
  say cmd_equilibrium 0.5
  preset=$(next_of "$model/joint/shaft/preset" | sed -n 's/^data: *//p')
  shaft=$(next_of "$model/vsa/joint_state" | awk '/name: /{on = /"shaft"/} on && /position: /{print $2; exit}')
  echo "try $try: preset ${preset:-unknown}, shaft at ${shaft:-unknown} rad"
  if awk -v p="${preset:-0}" -v q="${shaft:-0}" 'BEGIN { exit !(p > 0.5 && p < 0.7 && q > 0.25 && q < 0.75) }'; then
    echo "the module followed the command-line client"
    exit 0
  fi
done
echo "the module never followed:"
tail -n 20 "$work/log"
exit 1
