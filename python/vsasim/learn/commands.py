# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What `python3 -m vsasim.learn` does: grids for baselines, training, the table, the demonstration."""
from __future__ import annotations

import itertools
import pathlib
import sys
import tempfile
import time
from typing import Callable, Dict, Iterator, List, Mapping, NamedTuple, Optional, Tuple

import numpy as np

from ..envs import TASKS, AutoresetMode, Task, make, record
from ..envs.vector_env import refused
from .evolution import Evolution, play, train
from .policy import Policy

__all__ = ["demo", "grid", "learn", "table"]

GRID_SEEDS = range(1, 9)
TEST_SEEDS = range(901, 906)
FIRST_TRAINING_SEED = 100_000  # and on
MOST_COPIES = 512


class Effort(NamedTuple):
    """How long a task is trained, and how widely it is looked at first."""

    population: int
    each: int
    generations: int
    sigma: float


EFFORT: Dict[str, Effort] = {
    "snake": Effort(12, 3, 12, 0.3),
    "throw": Effort(20, 6, 80, 0.5),
    "hit": Effort(16, 3, 40, 0.5),
    "pole": Effort(16, 4, 60, 0.5),
}


def say(text: str) -> None:
    """Progress, where somebody looks."""
    if sys.stderr.isatty():
        print(text, file=sys.stderr, flush=True)


def make_writable(directory: pathlib.Path) -> None:
    """Makes it, and a file in it that goes at once: before minutes of training, not after. InputError: that can't be done."""
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=directory):
            pass
    except OSError as error:
        raise refused("out", str(directory), error.strerror or str(error), "a directory that can be written") from None


def baseline_scores(task: type[Task], parameters: Mapping[str, np.ndarray], seeds: np.ndarray, threads: int) -> np.ndarray:
    """One episode a row: parameters (n,) each and seeds (n,) to scores (n,)."""
    scores = np.zeros(len(seeds))
    for at in range(0, len(seeds), MOST_COPIES):
        rows = slice(at, at + MOST_COPIES)
        mine = {name: values[rows] for name, values in parameters.items()}
        env = make(task, len(seeds[rows]), threads=threads, autoreset_mode=AutoresetMode.DISABLED)
        scores[rows] = play(env, lambda seen: env.task.baseline(seen, **mine), seeds[rows].tolist())
        env.close()
    return scores


def constants(task: type[Task], n: int) -> Dict[str, np.ndarray]:
    """The baseline's parameters, n rows of them."""
    return {name: np.full(n, value) for name, value in task.baseline_parameters.items()}


def grid(name: str, threads: int = 0) -> List[Tuple[Dict[str, float], float]]:
    """Every combination of a task's baseline_grid over the seeds 1 … 8: the mean scores, the best first."""
    task = TASKS[name]
    names = list(task.baseline_grid)
    combinations = list(itertools.product(*task.baseline_grid.values()))
    seeds = np.tile(np.array(GRID_SEEDS), len(combinations))
    parameters = {n: np.repeat([c[i] for c in combinations], len(GRID_SEEDS)) for i, n in enumerate(names)}
    means = baseline_scores(task, parameters, seeds, threads).reshape(-1, len(GRID_SEEDS)).mean(axis=1)
    return [(dict(zip(names, combinations[i])), float(means[i])) for i in np.argsort(-means, kind="stable")]


def learn(
    name: str,
    *,
    held: Optional[Mapping[str, float]] = None,
    effort: Optional[Effort] = None,
    seed: int = 1,
    threads: int = 0,
    told: Callable[[int, float], None] = lambda generation, mean: None,
) -> Tuple[Policy, np.ndarray]:
    """Trains a policy for a task from nothing: the policy and its parameters."""
    effort = effort or EFFORT[name]
    policy = Policy(TASKS[name], held)
    env = make(name, effort.population * effort.each, threads=threads, autoreset_mode=AutoresetMode.DISABLED)
    evolution = Evolution(np.zeros(policy.size), effort.sigma, effort.population, seed)
    for generation, mean, _ in train(env, policy, evolution, effort.generations, FIRST_TRAINING_SEED):
        told(generation, mean)
    env.close()
    return policy, evolution.mean


def tested(name: str, act: Callable[[np.ndarray], np.ndarray], seeds: range, threads: int) -> np.ndarray:
    """That controller's score from each of those seeds."""
    env = make(name, len(seeds), threads=threads, autoreset_mode=AutoresetMode.DISABLED)
    scores = play(env, act, list(seeds))
    env.close()
    return scores


def cell(scores: np.ndarray) -> str:
    return f"{scores.mean():.2f} ({scores.min():.2f} … {scores.max():.2f})"


def held_presets(task: type[Task], preset_rad: Optional[float]) -> Dict[str, float]:
    """Constant presets: that one, or the baseline's where it is None. InputError: the task doesn't take it."""
    presets = [q for q in task.action if q.name.endswith("preset_rad")]
    for q in presets:
        if preset_rad is not None and not q.low <= preset_rad <= q.high:
            raise refused(f"{task.name}: {q.name}", str(preset_rad), "out of range", f"{q.low} … {q.high} rad")
    return {q.name: task.baseline_parameters[q.name] if preset_rad is None else preset_rad for q in presets}


def table(
    names: List[str],
    *,
    directory: pathlib.Path,
    seed: int,
    tests: int,
    constant: bool,
    threads: int,
    preset_rad: Optional[float] = None,
) -> Iterator[str]:
    """The rows of the comparison: baseline and learned; `constant`: learned with constant presets, the baseline's or
    preset_rad. Saves what was learned in `directory`, as TASK.npy or TASK_constant.npy."""
    seeds = range(TEST_SEEDS.start, TEST_SEEDS.start + tests)
    for name in names:
        task = TASKS[name]
        begun = time.monotonic()
        base = baseline_scores(task, constants(task, tests), np.array(seeds), threads)
        policy, parameters = learn(
            name,
            held=held_presets(task, preset_rad) if constant else None,
            seed=seed,
            threads=threads,
            told=lambda generation, mean: say(f"{name}, generation {generation}: {mean:.3f} {task.score_unit}"),
        )
        scores = tested(name, lambda seen: policy.act(parameters, seen), seeds, threads)
        directory.mkdir(parents=True, exist_ok=True)
        np.save(directory / f"{name}{'_constant' if constant else ''}.npy", parameters)
        better = int((scores > base).sum())
        say(f"{name}: {time.monotonic() - begun:.0f} s")
        yield f"| `{name}` | {task.score_unit} | {cell(base)} | {cell(scores)} | {better} of {tests} |"


def demo(directory: pathlib.Path, threads: int = 0) -> None:
    """Learns to balance the pole within two minutes or so of two cores, and records what came of it."""
    name = "pole"
    task = TASKS[name]
    begun = time.monotonic()
    print(f"learning the task `{name}` with {EFFORT[name].population * EFFORT[name].each} worlds at once", flush=True)

    def tell(generation: int, mean: float) -> None:
        if generation % 20 == 0 or generation == EFFORT[name].generations - 1:
            print(f"  generation {generation:3}: mean score {mean:6.3f} {task.score_unit}", flush=True)

    policy, parameters = learn(name, threads=threads, told=tell)
    base = baseline_scores(task, constants(task, len(TEST_SEEDS)), np.array(TEST_SEEDS), threads)
    scores = tested(name, lambda seen: policy.act(parameters, seen), TEST_SEEDS, threads)
    print(f"learned in {time.monotonic() - begun:.0f} s; on five seeds that it didn't train on, mean (least … most):")
    print(f"  hand-made, best constant preset  {cell(base)} {task.score_unit}")
    print(f"  learned, presets included        {cell(scores)} {task.score_unit}")
    done = record(
        name, lambda seen: policy.act(parameters, seen), directory, seed=TEST_SEEDS.start, title="A pole on a soft joint, learned"
    )
    print(f"replay: {done['page']}" if done["page"] else f"no replay page: {done['without_page']}")
