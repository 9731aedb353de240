#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# fetch.sh NPM FOLDER: `npm ci` in the folder. npm by itself tries for minutes where there is no network, and then tells of getaddrinfo.
set -eu
npm=$1
cd "$2"
"$npm" ci --no-audit --no-fund --loglevel=error --prefer-offline \
  --fetch-retries=1 --fetch-retry-mintimeout=1000 --fetch-retry-maxtimeout=5000 --fetch-timeout=60000 || {
  echo "web: the pages' packages weren't fetched: they need npm's registry once; the source archive (make dist) has the pages ready" >&2
  exit 1
}
