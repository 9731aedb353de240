#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# fetch.sh NPM FOLDER: `npm ci` in the folder. npm by itself tries for minutes where there is no network, and then tells of getaddrinfo.
set -eu
npm=$1
cd "$2"
# npm tells of a full disk by whatever file came first, and of a home that can't be written by a log that it has no place for.
needed_MB=80  # 63 of packages, and their pages
free_kB=$(df -P . 2>/dev/null | awk 'NR == 2 && $2 > 0 { print $4 }')  # none: a file system without a size
no_space() {
  echo "web: $PWD: no space for the pages' packages${1:+: $1}: they need $needed_MB MB" >&2
  exit 1
}
[ -z "$free_kB" ] || [ "$free_kB" -ge $((needed_MB * 1024)) ] || no_space "$((free_kB / 1024)) MB are free"
own_cache=""
cache=${npm_config_cache:-${HOME:+$HOME/.npm}}
if [ -n "$cache" ] && ! { mkdir -p "$cache" && [ -w "$cache" ]; } 2>/dev/null; then own_cache=$PWD/cache; fi
# Kept in memory: what it says decides what is said of it.
said=$("$npm" ci --no-audit --no-fund --loglevel=error --prefer-offline ${own_cache:+--cache "$own_cache" --logs-max=0} \
  --fetch-retries=1 --fetch-retry-mintimeout=1000 --fetch-retry-maxtimeout=5000 --fetch-timeout=60000 2>&1) || {
  printf '%s\n' "$said" >&2
  case $said in *ENOSPC* | *"o space left"*) no_space ;; esac
  echo "web: the pages' packages weren't fetched: they need npm's registry once; the source archive (make dist) has the pages ready" >&2
  exit 1
}
[ -z "$said" ] || printf '%s\n' "$said"
