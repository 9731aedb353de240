# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Experiments on an actuator: characterize() measures it as the paper measured its hardware."""
from ._vsasim.study import characterize

__all__ = ["characterize"]
