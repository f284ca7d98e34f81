# SPDX-License-Identifier: MIT
"""Spaces of observations and actions: those of gymnasium if it is installed, or else a few of its shape."""
from __future__ import annotations

from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np

__all__ = ["Box", "Dict", "Discrete", "Space"]

try:
    from gymnasium.spaces import Box, Dict, Discrete, Space
except ImportError:

    class Space:
        """Set of values. sample() draws one, contains() tells whether a value is one of them."""

        def __init__(self, shape: Optional[Sequence[int]] = None, dtype: Any = None, seed: Optional[int] = None):
            self.shape = None if shape is None else tuple(shape)
            self.dtype = None if dtype is None else np.dtype(dtype)
            self.seed(seed)

        def seed(self, seed: Optional[int] = None) -> None:
            """Begins the draws of sample() anew; None: from somewhere."""
            self.np_random = np.random.default_rng(seed)

        def sample(self) -> Any:
            raise NotImplementedError

        def contains(self, x: Any) -> bool:
            raise NotImplementedError

        def __contains__(self, x: Any) -> bool:
            return self.contains(x)

    class Box(Space):
        """Arrays of numbers, each from low to high; either may be infinite."""

        def __init__(self, low: Any, high: Any, shape: Optional[Sequence[int]] = None, dtype: Any = np.float32,
                     seed: Optional[int] = None):
            if shape is None:
                shape = np.broadcast_shapes(np.shape(low), np.shape(high))
            super().__init__(shape, dtype, seed)
            self.low = np.broadcast_to(np.asarray(low, dtype), self.shape)
            self.high = np.broadcast_to(np.asarray(high, dtype), self.shape)

        def sample(self) -> np.ndarray:
            """Uniform between two bounds, exponential beside one, normal without any."""
            draw, low, high = self.np_random, self.low, self.high
            if self.dtype.kind in "iu":
                return draw.integers(low, high, endpoint=True, dtype=self.dtype)
            up, down = np.isfinite(low), np.isfinite(high)
            tail = draw.exponential(size=self.shape)
            with np.errstate(invalid="ignore"):
                values = np.where(up & down, low + draw.random(self.shape) * (high - low),
                                  np.where(up, low + tail, np.where(down, high - tail, draw.normal(size=self.shape))))
            return values.astype(self.dtype)

        def contains(self, x: Any) -> bool:
            x = np.asarray(x)
            return bool(np.can_cast(x.dtype, self.dtype) and x.shape == self.shape
                        and np.all(x >= self.low) and np.all(x <= self.high))

        def __eq__(self, other: object) -> bool:
            return (isinstance(other, Box) and self.shape == other.shape and self.dtype == other.dtype
                    and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

        def __repr__(self) -> str:
            return f"Box({self.low.min(initial=np.inf)}, {self.high.max(initial=-np.inf)}, {self.shape}, {self.dtype})"

    class Discrete(Space):
        """Whole numbers start, start + 1, ... start + n - 1."""

        def __init__(self, n: int, seed: Optional[int] = None, start: int = 0):
            if n < 1:
                raise ValueError(f"Discrete: n must be 1 or more, got {n}")
            super().__init__((), np.int64, seed)
            self.n, self.start = int(n), int(start)

        def sample(self) -> np.int64:
            return np.int64(self.start + self.np_random.integers(self.n))

        def contains(self, x: Any) -> bool:
            is_whole = isinstance(x, (int, np.integer)) or (isinstance(x, np.ndarray) and x.shape == ()
                                                             and x.dtype.kind in "iu")
            return bool(is_whole and self.start <= x < self.start + self.n)

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Discrete) and (self.n, self.start) == (other.n, other.start)

        def __repr__(self) -> str:
            return f"Discrete({self.n}, start={self.start})" if self.start else f"Discrete({self.n})"

    class Dict(Space):
        """Dicts with a value of a space for each key."""

        def __init__(self, spaces: Mapping[str, Space], seed: Optional[int] = None):
            self.spaces = dict(spaces)
            super().__init__(None, None, seed)

        def seed(self, seed: Optional[int] = None) -> None:
            for number, space in enumerate(self.spaces.values()):
                space.seed(None if seed is None else seed + number)

        def sample(self) -> dict:
            return {key: space.sample() for key, space in self.spaces.items()}

        def contains(self, x: Any) -> bool:
            return (isinstance(x, dict) and x.keys() == self.spaces.keys()
                    and all(space.contains(x[key]) for key, space in self.spaces.items()))

        def __getitem__(self, key: str) -> Space:
            return self.spaces[key]

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Dict) and self.spaces == other.spaces

        def __repr__(self) -> str:
            return "Dict(" + ", ".join(f"{key!r}: {space}" for key, space in self.spaces.items()) + ")"
