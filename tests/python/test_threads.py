# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Other threads of Python: they run while C++ works, and a daemon thread in C++ doesn't take the process with it when Python ends."""
import pathlib
import subprocess
import sys
import threading
import time
import unittest

import numpy as np
import vsasim

PRO = "qbmove_maker_pro_6_1"

# The thread is in C++ when the main one ends: what it works on refuses to be asked then. While Python shuts down something goes on for
# four times as long as a loop in C++ goes without asking for Python's lock.
AT_EXIT = """
import threading, time
import numpy as np
import vsasim

class Slow:
    def __del__(self, clock=time.monotonic):
        end = clock() + 0.2
        while clock() < end:
            pass

{make}
threading.Thread(target=work, daemon=True).start()
while True:
    try:
        ask()
    except RuntimeError:
        break
slow = Slow()
print("ended")
"""
WORLD = "world = vsasim.World.load('bench_load')\nask = lambda: world.time_s\n"
BATCH = "batch = vsasim.Batch(vsasim.World.load('bench_load'), 8, threads={threads})\nask = lambda: batch.time_s\n"
WORK = {
    "World.step": WORLD + "work = lambda: world.step(10**8)",
    "World.run": WORLD + "work = lambda: world.run(1e6)",
    "World.step again and again": WORLD + "def work():\n    while True: world.step(5)",
    "Batch.step": BATCH.format(threads=1) + "work = lambda: batch.step(10**8)",
    "Batch.step by two": BATCH.format(threads=2) + "work = lambda: batch.step(10**8)",
    "UnitBatch.step": f"units = vsasim.UnitBatch(vsasim.ActuatorType.load('{PRO}'), 64)\nask = lambda: units.time_s\n"
    "work = lambda: units.step(10**8)",
    "Unit.follow": f"unit = vsasim.Unit(vsasim.ActuatorType.load('{PRO}'))\nask = lambda: unit.time_s\n"
    "work = lambda: unit.follow(1e-3, np.zeros(3 * 10**6))",
    "study.characterize": "begun = threading.Event()\n"
    "def told(*_): begun.set()\n"
    "def ask():\n    begun.wait(20)\n    raise RuntimeError\n"
    "work = lambda: vsasim.study.characterize('qbmove_maker_pro', progress=told)",
}


class AtExit(unittest.TestCase):
    def test_a_daemon_thread_at_work_lets_python_end(self):
        for what, make in WORK.items():
            with self.subTest(what):
                ended = subprocess.run([sys.executable, "-c", AT_EXIT.format(make=make)], capture_output=True, text=True, timeout=120)
                self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (0, "ended\n", ""))


class Meanwhile(unittest.TestCase):
    def runs_beside(self, work):
        """Whether this thread runs while another is at `work`. On a busy machine it may come too late once, but not each time."""
        return any(self._ran_beside(work) for _ in range(50))

    def _ran_beside(self, work):
        begun, over, turns = threading.Event(), threading.Event(), []

        def other():
            begun.set()
            turns.append("begins")
            work()
            turns.append("ends")
            over.set()

        thread = threading.Thread(target=other)
        interval = sys.getswitchinterval()
        sys.setswitchinterval(100.0)  # no thread gives the lock away unasked
        try:
            thread.start()
            begun.wait()
            turns.append("here")
            over.wait()
        finally:
            sys.setswitchinterval(interval)
            thread.join()
        return turns == ["begins", "here", "ends"]

    def test_others_run_beside_a_long_motion(self):
        unit = vsasim.Unit(vsasim.ActuatorType.load(PRO))
        self.assertTrue(self.runs_beside(lambda: unit.follow(1e-3, np.zeros(20000))))

    def test_others_run_while_copies_are_made(self):
        world, type = vsasim.World.load("snake_flat"), vsasim.ActuatorType.load(PRO)
        self.assertTrue(self.runs_beside(lambda: vsasim.Batch(world, 64, threads=1)))
        self.assertTrue(self.runs_beside(lambda: vsasim.UnitBatch(type, 20000)))

    def test_a_unit_is_one_threads_while_it_follows(self):
        unit, refused = vsasim.Unit(vsasim.ActuatorType.load(PRO)), []
        calls = (
            lambda: unit.time_s,
            unit.readings,
            unit.ledger,
            unit.snapshot,
            unit.state,
            lambda: unit.restore_state(numbers),
            lambda: unit.command(0.1),
            lambda: unit.set_inputs((0, 0)),
            lambda: unit.step(1e-3, 0.0),
            lambda: unit.follow(1e-3, [0.0]),
        )
        numbers = unit.state()
        thread = threading.Thread(target=lambda: unit.follow(1e-3, np.zeros(10**6)))
        thread.start()
        while not refused and thread.is_alive():
            try:
                unit.time_s
            except RuntimeError:
                for call in calls:
                    with self.assertRaisesRegex(RuntimeError, "stepped in another thread"):
                        call()
                    refused.append(call)
        thread.join()
        self.assertEqual(len(refused), len(calls))
        self.assertAlmostEqual(unit.time_s, 1000.0)


class Late:
    """An argument whose conversion waits until another thread steps `of`, which goes on until the process ends."""

    def __init__(self, of, step, value):
        self.of, self.step, self.value = of, step, value

    def begin(self):
        threading.Thread(target=self.step, args=(self.of,), daemon=True).start()
        while True:
            try:
                self.of.time_s
            except RuntimeError:
                return self.value
            time.sleep(0.001)

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.begin())


class LateIndex(Late):
    def __index__(self):
        return self.begin()


def world():
    return vsasim.World.load("manipulator_3r")


KEY = "drive.friction_Nm"
# What makes one, what steps it, and the calls: each with what makes a late argument of a value.
CONVERTING = {
    "World": (
        world,
        lambda w: w.run(1e6),
        {
            "restore_state": lambda w, late: w.restore_state(late(w.state())),
            "apply_wrench": lambda w, late: w.apply_wrench(w.links[1], torque_Nm=late([1, 0, 0])),
            "jacobian": lambda w, late: w.jacobian(w.links[1], late([0, 0, 0])),
            "displace_model": lambda w, late: w.displace_model("qbmove_manipulator_3r", 0.0, late([0, 0, 0])),
            "set_link_parameters": lambda w, late: w.set_link_parameters(w.links[2], inertia_kgm2=late([1e-3] * 3)),
            "place": lambda w, late: w.place(late(0), 0.1, 0.1),
            "read": lambda w, late: w.read(late(0)),
            "ledger": lambda w, late: w.ledger(late(0)),
        },
    ),
    "Batch": (
        lambda: vsasim.Batch(world(), 2, threads=1),
        lambda b: b.step(10**8),
        {
            "restore": lambda b, late: b.restore(0, late(b.state(0))),
            "restore of a late copy": lambda b, late: b.restore(late(0), b.state(0)),
            "state": lambda b, late: b.state(late(0)),
            "failure": lambda b, late: b.failure(late(0)),
            "text": lambda b, late: b.text(late(0), 0, KEY),
            "values": lambda b, late: b.values(KEY, late(0)),
            "give_parameters": lambda b, late: b.give_parameters(late(0), world()),
            "set": lambda b, late: b.set(None, 0, KEY, late(0.5)),
            "reset": lambda b, late: b.reset(late([0])),
            "equilibrium": lambda b, late: setattr(b, "equilibrium", late(0.1)),
            "preset": lambda b, late: setattr(b, "preset", late([0.1, 0.2, 0.3])),
        },
    ),
    "UnitBatch": (
        lambda: vsasim.UnitBatch(vsasim.ActuatorType.load(PRO), 64),
        lambda b: b.step(10**8),
        {
            "reset which": lambda b, late: b.reset(late([1, 2])),
            "reset preset": lambda b, late: b.reset(preset=late(0.1)),
            "reset shaft_rad": lambda b, late: b.reset(shaft_rad=late(0.1)),
            "set_levers": lambda b, late: b.set_levers(late(1e-3)),
            "restore": lambda b, late: b.restore(0, late(b.state(0))),
            "restore of a late unit": lambda b, late: b.restore(late(0), b.state(0)),
            "state": lambda b, late: b.state(late(0)),
            "equilibrium": lambda b, late: setattr(b, "equilibrium", late(0.1)),
            "push": lambda b, late: setattr(b, "push", late(0.0)),
        },
    ),
    "Unit": (
        lambda: vsasim.Unit(vsasim.ActuatorType.load(PRO)),
        lambda u: u.follow(1e-3, np.zeros(10**7)),
        {
            "restore_state": lambda u, late: u.restore_state(late(u.state())),
            "follow": lambda u, late: u.follow(1e-3, late(np.zeros(3))),
            "follow at a late speed": lambda u, late: u.follow(1e-3, [0.0], late(0.0)),
        },
    ),
}


def tell_what_goes_on_beside_a_step(kind):
    make, step, calls = CONVERTING[kind]
    for name, call in calls.items():
        of = make()
        try:
            call(of, lambda value: (LateIndex if isinstance(value, int) else Late)(of, step, value))
            print(name, "went on beside the step")
        except RuntimeError as error:
            if "stepped in another thread" not in str(error):
                print(name, error)


class WhileArgumentsConvert(unittest.TestCase):
    def test_what_another_thread_begins_to_step_meanwhile_is_refused(self):
        for kind in CONVERTING:
            with self.subTest(kind):
                program = f"import test_threads; test_threads.tell_what_goes_on_beside_a_step('{kind}')"
                ran = subprocess.run([sys.executable, "-c", program], cwd=pathlib.Path(__file__).parent, capture_output=True, text=True, timeout=120)
                self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (0, "", ""))


if __name__ == "__main__":
    unittest.main()
