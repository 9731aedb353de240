#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Commands a preset with Gazebo's own command-line client until the module's readings follow; the server's surroundings are the caller's.
#   follow.sh MODEL JOINT PRESET     exit code 1: it never followed
set -eu
model=$1 joint=$2 wanted=$3

# The last preset that the robot told; nothing where none comes within 2 s.
preset() {
  timeout 10 gz topic -u -e "/model/$model/vsa/readings" -d 2 2>/dev/null |
    sed -n "s|.*name: \"$joint/preset\" value { type: DOUBLE double_value: \([^ ]*\).*|\1|p" | tail -n 1
}

# Messages can be lost while two processes find each other: repeat the command until the state follows.
for try in 1 2 3 4 5 6 7 8 9 10; do
  timeout 10 gz topic -p "/model/$model/joint/$joint/cmd_preset" -m "type: DOUBLE double_value: $wanted" >/dev/null 2>&1 || true
  told=$(preset)
  echo "try $try: preset ${told:-unknown}"
  if [ -n "$told" ] && awk "BEGIN { exit !($told > $wanted - 0.05 && $told < $wanted + 0.05) }"; then exit 0; fi
done
exit 1
