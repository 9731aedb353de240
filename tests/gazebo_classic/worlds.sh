#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# gzserver with every world of models/worlds, and one of them paused: each loads without an error on its log, and its robot tells its
# state.  worlds.sh PLUGIN_DIRECTORY
set -eu
source_tree=$(cd "$(dirname "$0")/../.." && pwd)
export VSA_DATA_DIR="$source_tree" GAZEBO_MODEL_PATH="$source_tree/models" GAZEBO_PLUGIN_PATH="$1" GAZEBO_MODEL_DATABASE_URI="" GAZEBO_IP=127.0.0.1 IGN_IP=127.0.0.1
export IGN_PARTITION="vsa_worlds_$$"
log=$(mktemp)
server=
trap '[ -z "$server" ] || kill "$server" 2>/dev/null || true; rm -f "$log"' EXIT
port=$((20000 + $$ % 20000))

fail() { echo "$1:"; tail -n 20 "$log"; exit 1; }

# check NAME FILE [OPTION]
check() {
  port=$((port + 1))
  export GAZEBO_MASTER_URI="http://127.0.0.1:$port"
  gzserver --verbose ${3:+"$3"} "$2" >"$log" 2>&1 &
  server=$!
  told=
  for seconds in 1 1 1 2 2 4 4 8 8 8; do
    kill -0 "$server" 2>/dev/null || fail "$1: gzserver died"
    topic=$(timeout 20 gz topic -l 2>/dev/null | grep '^/model/.*/vsa/readings$' | head -n 1) || true
    [ -n "$topic" ] || continue
    told=$(timeout 20 gz topic -u -e "$topic" -d "$seconds" 2>/dev/null | sed -n 's|.*name: "\([^"]*/preset\)" value { type: DOUBLE double_value: \([^ ]*\).*|\1 \2|p' | tail -n 1) || true
    [ -z "$told" ] || break
  done
  [ -n "$told" ] || fail "$1: its robot tells nothing"
  kill "$server"
  wait "$server" 2>/dev/null || true
  server=
  # A machine without a screen or a sound card says so.
  ! grep '\[Err\]' "$log" | grep -v 'RenderEngine.cc\|OpenAL.cc' || fail "$1: errors on its log"
  echo "$1: $topic: $told"
}

for world in "$source_tree"/models/worlds/*.sdf; do check "$(basename "$world" .sdf)" "$world"; done
check "module, paused" "$source_tree/models/worlds/module.sdf" -u
