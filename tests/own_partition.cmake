# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Read by ctest, not by the build: its tests inherit what it sets (tests/CMakeLists.txt).
string(RANDOM LENGTH 12 own)
set(ENV{IGN_PARTITION} "vsa_tests_${own}")
