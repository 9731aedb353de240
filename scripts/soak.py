#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Hours of everything at once: python3 scripts/soak.py BUILD HOURS OUT [SEED]

Three programs run all the time: twelve emulated units on a serial port (with lost and flipped bytes), the crawling snake in real time
with topics and live view, a batch in Python; a fourth where there is Gazebo Classic with the plug-in, a server. Around them, at random but
from SEED: clients of the port that come, go and are killed; viewers of the page that come, vanish and send garbage; commands by topics;
faults of joints by the service; short recorded runs; modules that are spawned in Gazebo, moved and removed.

Looks at memory, descriptors and threads of these programs, at answers and round trips of the port's clients, and at whether equal runs gave
equal bytes. Ctrl-C or SIGTERM ends it earlier, and what it has seen until then is judged. Writes OUT/soak.html and OUT/soak.json, what there
is so far every few minutes, and prints the verdicts; exit code 1 where one is broken, 2 for wrong use and for what can't be written. A
program that ends before its time is told at once, and has no more visitors.
"""
import hashlib
import importlib.util
import json
import os
import pathlib
import random
import re
import signal
import socket
import statistics
import struct
import subprocess
import sys
import threading
import time

import soak_gazebo
import soak_page

CLIENT = pathlib.Path(__file__).resolve().parent / "soak_client.py"
SERVICE = "/usr/libexec/ignition/transport11/ign-transport-service"  # Debian's client of ignition-transport
UNITS = 12
WORLD_MODEL = "qbmove_snake"
FAULTS = ["off", "lost_byte=0.02", "flipped_byte=0.02", "late_s=0.0005", "stuck=motor_1", "noise_rad=0.01", "supply_V=18", "unplugged=2"]
OF_TOPICS = ("commands by topics", "faults by the service")  # visits, each a client of its own
OF_GAZEBO = "clients of Gazebo that published"
MODULES = "modules in Gazebo"
GROWTH = 1.05  # of resident memory, last quarter over second: what a program may gain
KEPT_MB = 0.032  # by ZeroMQ of each client of topics that has gone (libzmq 4286), for as long as the world lives
ANSWERED = 0.9  # of exchanges: bytes are lost and flipped on purpose, which took the answers of 2.5 % of them in an hour
LEAVE_S = 300  # between two states of the page: whoever kills this script loses as much
RUNS = "it runs"
SLACK = (0, 5, 0)  # memory, descriptors, threads after the visitors, over before them: ZeroMQ's connections to clients that have gone


def usage(pid):
    """Resident memory in MB, descriptors, threads; None once the process has gone."""
    try:
        status = pathlib.Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
        descriptors = len(os.listdir(f"/proc/{pid}/fd"))
    except OSError:
        return None
    number = {k: int(v) for k, v in re.findall(r"^(VmRSS|Threads):\s+(\d+)", status, re.MULTILINE)}
    return (number["VmRSS"] / 1024, descriptors, number["Threads"]) if "VmRSS" in number else None


class Subject:
    """A program that must live through it."""

    def __init__(self, name, command, out, environment=None):
        self.name, self.samples, self.told = name, [], False
        self.log = open(out / f"{name}.log", "w+b")
        # Here and below, sessions of their own: a Ctrl-C in the terminal is for this script, which ends them once it has counted them.
        self.process = subprocess.Popen(command, stdout=self.log, stderr=subprocess.STDOUT, env=environment, start_new_session=True)

    def said(self):
        return pathlib.Path(self.log.name).read_text(encoding="utf-8", errors="replace")

    def wait_for(self, pattern, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end and self.ended() is None:
            found = re.search(pattern, self.said())
            if found:
                return found
            time.sleep(0.1)
        sys.exit(f"soak.py: {self.name} never said {pattern}; it said:\n{self.said()}")

    def pid(self):
        return self.process.pid

    def ended(self):
        """Exit code; None: it runs."""
        return self.process.poll()

    def sample(self, at):
        if self.ended() is not None and not self.told:
            self.told = True
            print(f"{self.name} has ended after {at / 60:.0f} min: exit code {self.ended()}", flush=True)
        now = usage(self.pid())
        if now:
            self.samples.append((at, *now))

    def stop(self):
        if self.ended() is None and self.pid():
            os.kill(self.pid(), signal.SIGINT)
        try:
            return self.process.wait(60)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)
            return "killed"


class Server(Subject):
    """Gazebo's: behind the shells that entered its system."""

    def pid(self):
        return soak_gazebo.process(self.process.pid)


class Soak:
    def __init__(self, build, out, seed, end):
        self.build, self.out, self.seed, self.end = build, out, seed, end
        self.begin = time.monotonic()  # of the visits
        self.counts, self.wrong, self.digests, self.lock = {}, [], set(), threading.Lock()
        self.trips = []  # of each exchange on the port: when its client was through, µs or None without an answer
        self.view_port = 0
        self.vsa = str(build / "bin/vsa")
        self.gazebo = soak_gazebo.Gazebo(seed)
        self.port = str(out / "port")

    def count(self, what, by=1):
        with self.lock:
            self.counts[what] = self.counts.get(what, 0) + by

    def complain(self, what):
        with self.lock:
            self.wrong.append(what)

    def until_the_end(self, number, visit, pause, of):
        """A thread: visits of a program (None: of none) with pauses, from a seed of its own."""

        def loop():
            chance = random.Random(self.seed * 1000 + number)
            while time.monotonic() < self.end and (of is None or of.ended() is None):
                try:
                    visit(chance)
                except Exception as error:  # a visitor's own mistake ends the soak's claim, not the soak
                    self.complain(f"{visit.__name__}: {error!r}")
                time.sleep(min(chance.uniform(*pause), max(0.0, self.end - time.monotonic())))

        thread = threading.Thread(target=loop, name=visit.__name__)
        thread.start()
        return thread

    def port_client(self, chance):
        process = subprocess.Popen([sys.executable, CLIENT, "port", self.port, str(chance.getrandbits(32)), str(UNITS)],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
        killed = chance.random() < 0.5
        try:
            said, error = process.communicate(timeout=chance.uniform(0.2, 3) if killed else 120)
        except subprocess.TimeoutExpired:
            process.kill()
            said, error = process.communicate()
            self.count("port clients killed")
            if not killed:
                self.complain("a client of the port wasn't through after 120 s")
        else:
            self.count("port clients that left")
            if process.returncode != 0:
                self.complain(f"a client of the port: {error.strip().splitlines()[-1:]}")
        lines = [line for line in said.split("\n")[:-1] if line]
        self.count("exchanges", len(lines))
        self.count("exchanges without an answer", lines.count("-"))
        at = time.monotonic()
        with self.lock:
            self.trips += [(at, None if line == "-" else float(line)) for line in lines]

    def viewer(self, chance):
        with socket.create_connection(("127.0.0.1", self.view_port), timeout=30) as page:
            if chance.random() < 0.1:
                page.sendall(chance.randbytes(chance.randint(1, 4000)))
                self.count("viewers that sent garbage")
                return
            page.sendall(f"GET /live HTTP/1.1\r\nHost: 127.0.0.1:{self.view_port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                         "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n".encode())
            ask, got = b"\x81\x8d\0\0\0\0" + b'{"do":"next"}', 0
            for _ in range(chance.randint(1, 200)):
                page.sendall(ask)
                got += len(page.recv(1 << 16))
                time.sleep(0.02)
            if got == 0:
                self.complain("a viewer got nothing")
            if chance.random() < 0.5:  # gone without a word: the system sends a reset
                page.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            self.count("viewers")

    def commander(self, chance):
        angle, preset = chance.uniform(-20, 20), chance.uniform(5, 30)
        done = subprocess.run([self.vsa, "command", f"{angle:.1f}", f"{preset:.1f}", "--joint", f"joint_{chance.randint(0, 11)}",
                               "--timeout-s", "60"], capture_output=True, text=True, timeout=180, check=False, start_new_session=True)
        self.count("commands by topics")
        if done.returncode != 0:
            self.complain(f"vsa command: {done.stderr.strip()}")

    def saboteur(self, chance):
        text = "all none" if chance.random() < 0.3 else f"joint_{chance.randint(0, 11)} {chance.choice(FAULTS)} seed={chance.getrandbits(20)}"
        done = subprocess.run([SERVICE, "-s", f"/model/{WORLD_MODEL}/vsa/faults", "--reqtype", "ignition.msgs.StringMsg", "--reptype",
                               "ignition.msgs.StringMsg", "--timeout", "20000", "-r", f'data: "{text}"'],
                              capture_output=True, text=True, timeout=180, check=False, start_new_session=True)
        self.count("faults by the service")
        if "timed out" in done.stdout.lower() + done.stderr.lower():
            self.count("faults whose call timed out")

    def recorded_run(self, chance):
        out = self.out / "recorded"
        subprocess.run([self.vsa, "run", "bench_load", "--duration-s", "2", "--record", str(out), "--no-topics"], capture_output=True,
                       check=True, timeout=300, start_new_session=True)
        digest = hashlib.sha256()
        for file in sorted(out.glob("*.csv")):
            digest.update(file.read_bytes())
        with self.lock:
            self.digests.add(digest.hexdigest())
        self.count("recorded runs")

    def spawned_module(self, chance):
        name, place = f"visitor_{chance.getrandbits(32)}", [chance.choice((-1, 1)) * chance.uniform(1, 5) for _ in range(2)]
        wrong, clients = self.gazebo.visit(name, place, chance.uniform(0.1, 0.55))  # where its motors stall is 0.6 rad
        self.count(MODULES)
        self.count(OF_GAZEBO, clients)
        if wrong:
            self.complain(wrong)


def start(soak, out, subjects):
    """Adds the programs to `subjects`, each once it is ready."""
    mine = dict(os.environ, PYTHONPATH=str(soak.build / "python"), IGN_IP="127.0.0.1")
    subjects.append(Subject("emulate", [soak.vsa, "emulate", "qbmove_maker_pro_6_1", "--units", str(UNITS), "--port", soak.port, "--active",
                                "--fault", f"all lost_byte=0.0003 flipped_byte=0.0003 seed={soak.seed}"], out))
    subjects.append(Subject("run", [soak.vsa, "run", "snake_flat", "--gait", "sidewind", "--realtime", "--view"], out, mine))
    subjects.append(Subject("batch", ["/usr/bin/python3", CLIENT, "batch"], out, mine))
    units, world, rounds = subjects[:3]
    units.wait_for(re.escape(soak.port))
    soak.view_port = int(world.wait_for(r"127\.0\.0\.1:(\d+)").group(1))
    rounds.wait_for(r"[0-9a-f]{64}")
    if soak.gazebo.missing:
        return
    subjects.append(Server("gazebo", soak.gazebo.server(), out))
    wrong, _ = soak.gazebo.visit("first", (2, 2), 0.5)
    if wrong:
        sys.exit(f"soak.py: Gazebo: {wrong}; it said:\n{subjects[-1].said()}")


def quarter(values, which):
    n = len(values)
    return values[n * which // 4 : n * (which + 1) // 4]


def answered(soak, end):
    """(answers, exchanges) in each quarter of the time until then. What came after it is of the last."""
    long, found = max(end - soak.begin, 1e-9), [[0, 0] for _ in range(4)]
    for at, trip in soak.trips:
        of = found[min(max(int(4 * (at - soak.begin) / long), 0), 3)]
        of[0] += trip is not None
        of[1] += 1
    return found


def slack(soak, name, k):
    """How many more descriptors (1) or threads (2) a program may have once the visitors have gone. Gazebo Classic keeps a socket of each
    client that published, whatever is in its models. And ignition-transport's processes, whatever their partitions, connect to each that
    has services: once more after one of those services has gone, as a module's do, for they forget the connection that they have
    (NodeShared::OnNewSrvDisconnection)."""
    sockets = soak.counts.get(MODULES, 0) if name in ("run", "gazebo") else 0
    sockets += soak.counts.get(OF_GAZEBO, 0) if name == "gazebo" else 0
    return SLACK[k] + (sockets if k == 1 else 0)


def verdicts(soak, subjects, idle, ends, end):
    """(what, held, figure) each, at that time; `idle` has one entry as long as there are visitors."""
    out = []
    for s in subjects:
        out.append((f"{s.name} lives to the end and ends well by Ctrl-C", ends[s.name] in (0, RUNS),
                    RUNS if ends[s.name] == RUNS else f"exit code {ends[s.name]}"))
        before, after = (statistics.median([m for _, m, _, _ in quarter(s.samples, k)] or [0]) for k in (1, 3))
        # Between the middles of the two quarters lies half of the time.
        kept = KEPT_MB * 0.5 * sum(soak.counts.get(c, 0) for c in OF_TOPICS) if s.name == "run" else 0.0
        most = GROWTH * before + kept
        out.append((f"{s.name}: memory, second quarter to last, at most {GROWTH} times" + (f" and {kept:.1f} MB that ZeroMQ keeps" if kept else ""),
                    after <= most, f"{before:.1f} → {after:.1f} MB"))
        if len(idle) < 2:
            continue
        first, now = (place[s.name] for place in idle)
        for k, what in ((1, "descriptors"), (2, "threads")):
            more = slack(soak, s.name, k)
            out.append((f"{s.name}: {what} once the visitors have gone, at most {more} more than before they came",
                        now is not None and now[k] <= first[k] + more, f"{first[k]} → {'it has gone' if now is None else now[k]}"))
    digests = len(soak.digests)
    out.append(("recorded runs have the same bytes", digests == 1, f"{soak.counts.get('recorded runs', 0)} runs, {digests} contents"))
    rounds = set(re.findall(r"[0-9a-f]{64}", subjects[2].said()))
    out.append(("rounds of the batch come to the same", len(rounds) == 1, f"{len(rounds)} results"))
    out.append(("visitors had nothing to complain of", not soak.wrong, "; ".join(soak.wrong[:5]) or "nothing"))
    parts = answered(soak, end)
    out.append((f"units answer at least {100 * ANSWERED:.0f} % of the exchanges in each quarter of the time",
                all(n > 0 and yes >= ANSWERED * n for yes, n in parts), ", ".join(f"{100 * yes / n:.1f} % of {n}" if n else "no exchange" for yes, n in parts)))
    trips = [trip for _, trip in sorted(soak.trips, key=lambda exchange: exchange[0]) if trip is not None]
    early, late = (statistics.median(quarter(trips, k) or [0]) for k in (1, 3))
    out.append(("round trips, median of the last quarter at most twice the second's", late <= 2 * early, f"{early:.0f} → {late:.0f} µs"))
    return out


def leave(soak, subjects, found, lasted, out):
    """The numbers first, which outlive a page that can't be drawn."""
    with soak.lock:
        numbers = {"hours": lasted, "seed": soak.seed, "without_gazebo": soak.gazebo.missing, "verdicts": found, "counts": dict(soak.counts),
                   "wrong": list(soak.wrong), "samples": {s.name: s.samples for s in subjects}}
    (out / "soak.json").write_text(json.dumps(numbers, indent=1), encoding="utf-8")
    soak_page.write_page(subjects, numbers, out)


def leave_so_far(soak, subjects, idle, begin, out):
    """A disk that is full for a while ends nothing."""
    now = time.monotonic()
    ends = {s.name: RUNS if s.ended() is None else s.ended() for s in subjects}
    with soak.lock:
        found = verdicts(soak, subjects, idle, ends, now)
    try:
        leave(soak, subjects, found, (now - begin) / 3600, out)
    except OSError as problem:
        print(f"soak.py: {problem.filename or out}: {problem.strerror or problem}", file=sys.stderr, flush=True)


def told(soak, subjects, found, lasted, out):
    """Prints the verdicts, writes OUT/soak.json and the page; the exit code. Hours of them outlive a disk that is full by now, so what was
    found is printed first."""
    for what, held, figure in found:
        print(f"{'holds ' if held else 'BROKEN'}  {what}: {figure}", flush=True)
    if soak.gazebo.missing:
        print(f"left out: Gazebo Classic: {soak.gazebo.missing}", flush=True)
    leave(soak, subjects, found, lasted, out)
    print(f"{out}/soak.html")
    return 0 if all(held for _, held, _ in found) else 1


def settled(soak, subjects, before):
    """What they use once the visitors have gone: after 15 s, or as much later, up to two minutes, as a busy machine needs to see them off."""
    end = time.monotonic() + 120
    time.sleep(15)
    while True:
        now = {s.name: usage(s.pid()) for s in subjects}
        held = [now[name] and now[name][k] <= before[name][k] + slack(soak, name, k) for name in now for k in (1, 2)]
        if all(held) or time.monotonic() > end:
            return now
        time.sleep(1)


def main(build, hours, out, seed):
    out.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    soak = Soak(build, out, seed, begin + 3600 * hours)

    def end_now(*_):
        soak.end = min(soak.end, time.monotonic())

    subjects = []
    try:
        start(soak, out, subjects)
    except SystemExit:
        for s in subjects:
            s.stop()
        raise
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end_now)
    time.sleep(5)
    idle = [{s.name: usage(s.pid()) for s in subjects}]
    units, world = subjects[:2]
    visits = [(soak.port_client, (0, 1), units), (soak.viewer, (0, 2), world), (soak.viewer, (0, 5), world), (soak.viewer, (0, 5), world),
              (soak.commander, (5, 15), world), (soak.recorded_run, (5, 20), None)]
    if os.path.exists(SERVICE):
        visits.append((soak.saboteur, (5, 15), world))
    if not soak.gazebo.missing:
        visits.append((soak.spawned_module, (0, 5), subjects[3]))
    soak.begin = time.monotonic()
    threads = [soak.until_the_end(i, *visit) for i, visit in enumerate(visits)]
    period, next_look, next_page = max(1.0, 3600 * hours / 1000), 0.0, soak.begin + LEAVE_S
    while time.monotonic() < soak.end:
        if time.monotonic() >= next_look:
            next_look = time.monotonic() + period
            for s in subjects:
                s.sample(time.monotonic() - begin)
        if time.monotonic() >= next_page:
            next_page = time.monotonic() + LEAVE_S
            leave_so_far(soak, subjects, idle, begin, out)
        time.sleep(1)
    lasted = (time.monotonic() - begin) / 3600
    for thread in threads:
        thread.join()
    idle.append(settled(soak, subjects, idle[0]))
    ends = {s.name: s.stop() for s in subjects}
    found = verdicts(soak, subjects, idle, ends, soak.end)
    return told(soak, subjects, found, lasted, out)


if __name__ == "__main__":
    given = sys.argv[1:]
    try:
        if len(given) not in (3, 4) or not os.path.exists(given[0] + "/bin/vsa"):
            raise ValueError("not BUILD HOURS OUT [SEED], BUILD with bin/vsa")
        tree, long, where, number = pathlib.Path(given[0]).resolve(), float(given[1]), pathlib.Path(given[2]).resolve(), int((given[3:] or ["1"])[0])
        if importlib.util.find_spec("matplotlib") is None:  # now, not after hours
            raise ValueError("Python's matplotlib is missing: sh scripts/setup.sh test soak installs it")
        if not 0 < long <= 1000:  # not of NaN either
            raise ValueError(f"HOURS = {long:g} (allowed: up to 1000)")
        if where.exists() and not where.is_dir():
            raise ValueError(f"OUT = {where}: is a file (allowed: a folder, or a name for one)")
    except ValueError as problem:
        print(f"soak.py: {problem}", file=sys.stderr)
        sys.exit(2)
    try:
        sys.exit(main(tree, long, where, number))
    except OSError as problem:
        print(f"soak.py: {problem.filename or where}: {problem.strerror or problem}", file=sys.stderr)
        sys.exit(2)
