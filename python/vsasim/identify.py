# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Parameters from load-test recordings: fit() does what `vsa identify` does."""
from ._vsasim.identify import fit, read_recording

__all__ = ["fit", "read_recording"]
