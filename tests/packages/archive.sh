#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# archive.sh ARCHIVE: the source archive built in a bare folder, where neither npm nor node nor git is on the PATH: the command
# runs a world and writes its page, the folder's own tests of texts pass. CMAKE_FLAGS are given to CMake.
# Takes as long as compiling the command does.
set -eu
archive=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "archive: $*" >&2; exit 1; }

# Everything that is on the PATH but the three.
mkdir "$work/bin"
for folder in /usr/local/bin /usr/bin /bin /usr/sbin /sbin; do
  for program in "$folder"/*; do
    case ${program##*/} in npm | npx | node | nodejs | git | git-*) continue ;; esac
    [ -e "$work/bin/${program##*/}" ] || ln -s "$program" "$work/bin/${program##*/}"
  done
done
PATH=$work/bin
export PATH
for hidden in npm node git; do ! command -v "$hidden" >/dev/null || fail "$hidden is still there"; done

mkdir "$work/sources" && tar -C "$work/sources" -xf "$archive"
cd "$work"/sources/*
[ ! -e .git ] || fail "the archive has a repository in it"
start=$(date +%s)
# What the archive lacks is told; without npm and node setup.sh has nothing to install.
sh scripts/setup.sh
# shellcheck disable=SC2086 # CMAKE_FLAGS is words
cmake --preset release ${CMAKE_FLAGS:-} >"$work/configured" || { cat "$work/configured"; fail "configuring"; }
grep -q "pages: the source archive's" "$work/configured" || fail "the pages aren't the archive's"
# shellcheck disable=SC2046 # none or two words
cmake --build build/release -j "${JOBS:-$(nproc)}" --target vsa $(sh scripts/quiet.sh)
built=$(($(date +%s) - start))
build/release/bin/vsa run snake_rubble --duration-s 2 --gait climb --record "$work/out" --no-topics >/dev/null
grep -q 'id="licences"' "$work/out/replay.html" || fail "the run has no page"
ctest --test-dir build/release -R '^(page_licences|rooms|manual|live_page|mcap)$' >"$work/tested" || { cat "$work/tested"; fail "its tests"; }
grep -qE 'live_page \.+\*\*\*Skipped' "$work/tested" || { cat "$work/tested"; fail "tests with npm's packages aren't left out"; }
echo "archive: built without npm, node and git in $built s, and run"
