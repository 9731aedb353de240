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

if sh "$source_tree/tests/gazebo_classic/follow.sh" qbmove_bench_load shaft 0.6; then
  echo "the module followed the command-line client"
  exit 0
fi
kill -0 "$server" 2>/dev/null && echo "the module never followed:" || echo "gzserver died:"
tail -n 20 "$log"
exit 1
