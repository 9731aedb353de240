# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# The tests that need SDF, by folder: those of worlds written in SDF. A build without it leaves them out.
