# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
# The same for a colcon workspace, which sources this where it can't read hook.dsv.
. "$COLCON_CURRENT_PREFIX/share/vsa/setup.sh"
