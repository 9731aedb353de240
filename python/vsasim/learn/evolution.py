# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""An evolution strategy with covariance matrix adaptation, in NumPy, and the plays that it is fed with.

Source of the equations and constants: N. Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv:1604.00772, figure 6 and
table 1, with positive weights only.
"""
from __future__ import annotations

from typing import Callable, Iterator, Sequence

import numpy as np

from ..envs import AutoresetMode, VectorEnv
from ..envs.vector_env import refused
from .policy import Policy

__all__ = ["Evolution", "play", "train"]


class Evolution:
    """Looks for parameters (size,) with a high score: ask() for some to try, tell() how they did. The same seed, the same way."""

    def __init__(self, start: np.ndarray, sigma: float, population: int, seed: int) -> None:
        if population < 2:
            raise refused("population", str(population), "out of range", "2 or more")
        n = len(start)
        self.random = np.random.default_rng(seed)
        self.mean, self.sigma, self.population = np.array(start, float), sigma, population
        raw = np.log((population + 1) / 2) - np.log(np.arange(1, population // 2 + 1))
        self.weights = raw / raw.sum()
        self.mu = 1 / (self.weights**2).sum()
        mu = self.mu
        self.c_sigma = (mu + 2) / (n + mu + 5)
        self.damping = 1 + 2 * max(0.0, np.sqrt((mu - 1) / (n + 1)) - 1) + self.c_sigma
        self.c_c = (4 + mu / n) / (n + 4 + 2 * mu / n)
        self.c_1 = 2 / ((n + 1.3) ** 2 + mu)
        self.c_mu = min(1 - self.c_1, 2 * (mu - 2 + 1 / mu) / ((n + 2) ** 2 + mu))
        self.usual = np.sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n))  # of a normal vector's length
        self.path_sigma, self.path_c, self.covariance = np.zeros(n), np.zeros(n), np.eye(n)
        self.generation = 0
        self.tried = np.zeros((population, n))

    def ask(self) -> np.ndarray:
        """(population, size): the next ones to try."""
        values, self.axes = np.linalg.eigh(self.covariance)
        self.widths = np.sqrt(np.maximum(values, 1e-20))
        normal = self.random.standard_normal((self.population, len(self.mean)))
        self.tried = normal * self.widths @ self.axes.T
        return self.mean + self.sigma * self.tried

    def tell(self, scores: np.ndarray) -> None:
        """Their scores (population,), in ask()'s order; more is better."""
        n = len(self.mean)
        best = self.tried[np.argsort(-scores, kind="stable")[: len(self.weights)]]
        step = self.weights @ best
        self.mean = self.mean + self.sigma * step
        self.generation += 1
        unturned = self.axes @ ((self.axes.T @ step) / self.widths)
        self.path_sigma = (1 - self.c_sigma) * self.path_sigma + np.sqrt(self.c_sigma * (2 - self.c_sigma) * self.mu) * unturned
        length = np.linalg.norm(self.path_sigma)
        slow = length / np.sqrt(1 - (1 - self.c_sigma) ** (2 * self.generation)) < (1.4 + 2 / (n + 1)) * self.usual
        self.path_c = (1 - self.c_c) * self.path_c + slow * np.sqrt(self.c_c * (2 - self.c_c) * self.mu) * step
        left = (1 - slow) * self.c_c * (2 - self.c_c)
        self.covariance = (
            (1 - self.c_1 - self.c_mu + self.c_1 * left) * self.covariance
            + self.c_1 * np.outer(self.path_c, self.path_c)
            + self.c_mu * (best.T * self.weights) @ best
        )
        self.sigma *= np.exp(self.c_sigma / self.damping * (length / self.usual - 1))


def play(env: VectorEnv, act: Callable[[np.ndarray], np.ndarray], seeds: Sequence[int]) -> np.ndarray:
    """One episode of each copy, from those seeds, with actions act(observations): scores (n,). InputError for an environment that
    resets itself: its copies would begin others (autoreset_mode: AutoresetMode.DISABLED)."""
    if env.metadata["autoreset_mode"] is not AutoresetMode.DISABLED:
        raise refused("env", str(env.metadata["autoreset_mode"]), "resets its copies by itself", "AutoresetMode.DISABLED")
    observations, _ = env.reset(seed=list(seeds))
    scores, playing = np.zeros(env.num_envs), np.ones(env.num_envs, bool)
    while playing.any():
        observations, rewards, terminations, truncations, _ = env.step(act(observations))
        scores += rewards
        playing = ~(terminations | truncations)
    return scores


def train(
    env: VectorEnv, policy: Policy, evolution: Evolution, generations: int, first_seed: int
) -> Iterator[tuple[int, float, np.ndarray]]:
    """Generation by generation: its number, the mean score of those tried, and the parameters in their midst.

    Each one tried plays as many episodes as the environment has copies for each, all from the same seeds, which are new ones in
    each generation: first_seed and on.
    """
    each = env.num_envs // evolution.population
    if each * evolution.population != env.num_envs or each == 0:
        raise refused("env", f"{env.num_envs} copies", "not as many for each one tried", f"multiples of {evolution.population}")
    for generation in range(generations):
        parameters = np.repeat(evolution.ask(), each, axis=0)
        seeds = first_seed + generation * each + np.arange(each)
        scores = play(env, lambda seen: policy.act(parameters, seen), np.tile(seeds, evolution.population).tolist())
        evolution.tell(scores.reshape(evolution.population, each).mean(axis=1))
        yield generation, float(scores.mean()), evolution.mean
