#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Spawns a module into a running gzserver, commands it until it follows, removes it, and sees its topics go; the server's surroundings are
# the caller's.
#   visit.sh SOURCE_TREE NAME X Y PRESET     exit code 1, and what was wrong in the last line but one; the last: how many clients it was
set -eu
source_tree=$1 name=$2 x=$3 y=$4 preset=$5

clients=0
trap 'echo "$clients clients"' EXIT
topics() { timeout 30 gz topic -l 2>/dev/null | grep -c "^/model/$name/" || true; }
# until WANTED COMMAND…: the command, now and then again, until the module's topics are there (some) or have gone (none).
until_topics() {
  wanted=$1
  shift
  for wait in 0 1 1 2 4 8 16; do
    timeout 60 "$@" >/dev/null 2>&1 || true
    clients=$((clients + 1))
    sleep "$wait"
    case "$wanted $(topics)" in "none 0" | "some "[1-9]*) return 0 ;; esac
  done
  return 1
}

until_topics some gz model --spawn-file="$source_tree/models/qbmove/model.sdf" --model-name="$name" -x "$x" -y "$y" -z 0.0335 ||
  { echo "it was never there"; exit 1; }
wrong=
tries=$(sh "$source_tree/tests/gazebo_classic/follow.sh" "$name" shaft "$preset") || wrong="it never followed: $(echo "$tries" | tr '\n' ' ')"
clients=$((clients + $(echo "$tries" | wc -l)))
until_topics none gz model --model-name="$name" --delete || wrong="$wrong its topics stayed"
[ -z "$wrong" ] || { echo "$wrong"; exit 1; }
