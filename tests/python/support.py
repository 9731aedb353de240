# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What the tests share: the built command, its recordings as arrays, a world's readings along a run."""
import csv
import os
import pathlib
import signal
import subprocess
import threading
import time

import numpy as np
import vsasim

SOURCE = pathlib.Path(__file__).resolve().parents[2]
VSA = os.environ.get("VSA", str(SOURCE / "build" / "release" / "bin" / "vsa"))


def vsa(*arguments):
    """Runs the command on the package's own data; its standard output and error."""
    data = pathlib.Path(vsasim.__file__).parent / "share" / "vsa"
    return subprocess.run([VSA, *map(str, arguments)], capture_output=True, text=True, env={**os.environ, "VSA_DATA_DIR": str(data)})


def columns(file):
    """A CSV file: dict of column to list of texts."""
    with open(file, newline="", encoding="utf-8") as opened:
        rows = list(csv.DictReader(opened))
    return {key: [row[key] for row in rows] for key in rows[0]}


def readings(world, steps):
    """The actuators' readings after each of `steps` steps, as bytes: equal if and only if all bits are."""
    out = bytearray()
    for _ in range(steps):
        world.step()
        out += world.read().tobytes()
    return bytes(out)


def resident_bytes():
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Interrupting:
    """Sends this process the signal of Ctrl-C as soon as `ready` says so, from another thread; in 20 s at the latest, and then it fails."""

    MOST_S = 20.0

    def __init__(self, ready):
        self.thread = threading.Thread(target=self._send, args=(ready,))
        self.over = threading.Event()
        self.late = False

    def _send(self, ready):
        end = time.monotonic() + self.MOST_S
        while not self.over.is_set() and not self.late and not ready():
            time.sleep(0.001)
            self.late = time.monotonic() > end
        if not self.over.is_set():
            os.kill(os.getpid(), signal.SIGINT)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.thread.join()
        if self.late:
            raise AssertionError("what the signal should have waited for didn't come")


def finite(array):
    return bool(np.all(np.isfinite(array)))
