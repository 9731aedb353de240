# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A small learner for vsasim.envs: an evolution strategy in NumPy, and `python3 -m vsasim.learn`, which compares what it learns
with the tasks' baselines. docs/howto/learn.md tells more."""
from .evolution import Evolution, play, train
from .policy import Policy

__all__ = ["Evolution", "Policy", "play", "train"]
