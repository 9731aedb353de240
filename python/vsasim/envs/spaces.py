# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Gymnasium's VectorEnv, Box and AutoresetMode where it can be imported (1.1 or later), else stand-ins of the same shape.

Debian 12 doesn't package Gymnasium. HAVE_GYMNASIUM tells which ones these are; whoever uses only what is documented here needn't
know.
"""
from __future__ import annotations

import enum
from typing import Any, Optional, Tuple, Union

import numpy as np

__all__ = ["AutoresetMode", "Box", "HAVE_GYMNASIUM", "VectorEnvBase"]

try:
    from gymnasium.spaces import Box
    from gymnasium.vector import AutoresetMode
    from gymnasium.vector import VectorEnv as VectorEnvBase

    HAVE_GYMNASIUM = True
except ImportError:
    HAVE_GYMNASIUM = False

    class AutoresetMode(enum.Enum):  # type: ignore[no-redef]
        """When an episode that has ended begins anew; names and values are Gymnasium's."""

        NEXT_STEP = "NextStep"
        SAME_STEP = "SameStep"
        DISABLED = "Disabled"

    class Box:  # type: ignore[no-redef]
        """All arrays of one shape and dtype between `low` and `high`, bounds included: as gymnasium.spaces.Box.

        low, high: a number for all, or an array of the space's shape; infinite: no bound. seed: of sample().
        """

        def __init__(
            self,
            low: Any,
            high: Any,
            shape: Optional[Tuple[int, ...]] = None,
            dtype: Any = np.float32,
            seed: Optional[int] = None,
        ) -> None:
            self.dtype = np.dtype(dtype)
            if self.dtype.kind != "f":
                raise ValueError(f"Box dtype {self.dtype}: only floating ones without Gymnasium")
            given = shape if shape is not None else np.broadcast_shapes(np.shape(low), np.shape(high)) or (1,)
            self.low = np.array(np.broadcast_to(low, given), self.dtype)
            self.high = np.array(np.broadcast_to(high, given), self.dtype)
            if not np.all(self.low <= self.high):
                raise ValueError(f"Box: low {self.low} isn't below high {self.high} everywhere")
            self._random: Optional[np.random.Generator] = None
            if seed is not None:
                self.seed(seed)

        @property
        def shape(self) -> Tuple[int, ...]:
            """The shape of its arrays."""
            return self.low.shape

        @property
        def np_random(self) -> np.random.Generator:
            """What sample() draws from."""
            if self._random is None:
                self.seed()
            assert self._random is not None
            return self._random

        def seed(self, seed: Optional[int] = None) -> int:
            """The same seed, the same samples. Returns it, or the one that was drawn where none is given."""
            if seed is None:
                seed = int(np.random.SeedSequence().generate_state(1)[0])
            self._random = np.random.default_rng(seed)
            return seed

        def sample(self) -> np.ndarray:
            """Uniform between two bounds, exponential from the only one, normal where there is none: an array of the space."""
            random, shape = self.np_random, self.shape
            below, above = np.isfinite(self.low), np.isfinite(self.high)
            low, high = np.where(below, self.low, 0.0), np.where(above, self.high, 0.0)
            uniform = random.uniform(np.where(below & above, low, 0.0), np.where(below & above, high, 1.0))
            tail, normal = random.exponential(size=shape), random.normal(size=shape)
            out = np.where(below, low + tail, np.where(above, high - tail, normal))
            return np.where(below & above, uniform, out).astype(self.dtype)

        def contains(self, x: Any) -> bool:
            """Whether x is an array (or what makes one) of this shape, a dtype that goes into the space's, and within bounds."""
            try:
                x = x if isinstance(x, np.ndarray) else np.asarray(x, self.dtype)
            except (TypeError, ValueError):
                return False
            fits = np.can_cast(x.dtype, self.dtype) and x.shape == self.shape
            return bool(fits and np.all(x >= self.low) and np.all(x <= self.high))

        def __contains__(self, x: Any) -> bool:
            return self.contains(x)

        def __eq__(self, other: object) -> bool:
            if not isinstance(other, Box) or other.shape != self.shape or other.dtype != self.dtype:
                return False
            return bool(np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

        def __repr__(self) -> str:
            def short(bound: np.ndarray) -> str:
                return str(bound.flat[0] if bound.size and np.all(bound == bound.flat[0]) else bound)

            return f"Box({short(self.low)}, {short(self.high)}, {self.shape}, {self.dtype})"

    class VectorEnvBase:  # type: ignore[no-redef]
        """What gymnasium.vector.VectorEnv gives those that derive from it."""

        metadata: dict = {}
        spec: Any = None
        render_mode: Optional[str] = None
        closed: bool = False
        num_envs: int
        observation_space: Box
        action_space: Box
        single_observation_space: Box
        single_action_space: Box

        def close(self, **kwargs: Any) -> None:
            """Gives back what it holds. A second time: nothing."""
            if self.closed:
                return
            self.close_extras(**kwargs)
            self.closed = True

        def close_extras(self, **kwargs: Any) -> None:
            """What close() does, in those that derive."""

        def render(self) -> Optional[Tuple[Any, ...]]:
            """Frames, where there are any."""
            raise NotImplementedError

        @property
        def unwrapped(self) -> "VectorEnvBase":
            """Itself."""
            return self


def batched(space: Box, n: int) -> Box:
    """n of that space, one a row."""
    return Box(np.tile(space.low, (n, 1)), np.tile(space.high, (n, 1)), dtype=space.dtype)


Seed = Union[None, int, "list[Optional[int]]"]
