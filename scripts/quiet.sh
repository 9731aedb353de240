#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# quiet.sh: what follows the arguments of cmake --build so that Ninja says nothing of what goes well. Ninja has an option for it from
# 1.11 on; older ones (Ubuntu 22.04, Debian 11) refuse it and get nothing, so they tell of each step.
set -eu
version=$(ninja --version 2>/dev/null || echo 0)
[ "$(printf '1.11\n%s\n' "$version" | sort -V | head -n 1)" != 1.11 ] || echo "-- --quiet"
