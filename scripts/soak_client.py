#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Processes of their own for scripts/soak.py, which may be killed: soak_client.py port PATH SEED UNITS | batch"""
import hashlib
import os
import random
import signal
import struct
import sys
import termios
import time


def frame(unit, command, payload=b""):
    body = bytes([command]) + payload
    check = 0
    for byte in body:
        check ^= byte
    return b"::" + bytes([unit, len(body) + 1]) + body + bytes([check])


def open_port(path):
    port = os.open(path, os.O_RDWR | os.O_NOCTTY)
    settings = termios.tcgetattr(port)
    settings[0] = settings[1] = settings[3] = 0
    settings[2] = termios.CS8 | termios.CREAD | termios.CLOCAL
    settings[4] = settings[5] = termios.B2000000
    settings[6][termios.VMIN], settings[6][termios.VTIME] = 0, 1
    termios.tcsetattr(port, termios.TCSANOW, settings)
    return port


def client(path, seed, units):
    """Commands and asks units at random; a line per exchange: microseconds, or - where no answer came."""
    chance, port = random.Random(seed), open_port(path)
    for _ in range(chance.randint(20, 400)):
        unit = chance.randint(1, units)
        os.write(port, frame(unit, 130, struct.pack(">hh", chance.randint(-4000, 4000), chance.randint(-4000, 4000))))
        begin = time.perf_counter()
        os.write(port, frame(unit, 132))
        answer = b""
        while len(answer) < 12:
            more = os.read(port, 12 - len(answer))
            if not more:
                break
            answer += more
        print(f"{1e6 * (time.perf_counter() - begin):.0f}" if len(answer) == 12 else "-", flush=True)
        time.sleep(chance.uniform(0, 0.02))


def batch():
    """The same eight randomised copies again and again; a line per round: what they came to."""
    import vsasim  # of the build tree; the parent has no need of it

    signal.signal(signal.SIGINT, lambda *_: sys.exit(0))
    world = vsasim.World.load("bench_load")
    while True:
        copies = vsasim.Batch(world, 8, threads=2)
        copies.equilibrium = [[0.1 * i] for i in range(8)]
        copies.step(1000)
        print(hashlib.sha256(b"".join(copies.state(i).tobytes() for i in range(8))).hexdigest(), flush=True)
        time.sleep(0.5)


if __name__ == "__main__":
    if sys.argv[1] == "port":
        client(sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
    else:
        batch()
