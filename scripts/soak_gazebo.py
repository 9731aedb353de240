# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Gazebo Classic as one of soak.py's programs: the snake lies there while modules are spawned, moved and removed around it."""
import os
import pathlib
import re
import shutil
import subprocess

TREE = pathlib.Path(__file__).resolve().parents[1]
PLUGIN = "build/classic/gazebo-classic"  # made by scripts/test_gazebo.sh


class Gazebo:
    """How its programs are called here; `missing`: why they aren't."""

    def __init__(self, seed):
        self.missing, tree = None, TREE
        if shutil.which("gzserver"):
            self.prefix = []
        else:
            script = str(TREE / "scripts/debian11_root.sh")
            root = subprocess.run(["sh", script, "path"], capture_output=True, text=True, check=True).stdout.strip()
            if not os.path.exists(root + "/.vsasim"):
                self.missing = "no Gazebo 11 here (make test-gazebo makes one)"
                return
            self.prefix, tree = ["sh", script, "run"], pathlib.Path("/vsasim")
        if not (TREE / PLUGIN / "libvsa-robot.so").exists():
            self.missing = f"no plug-in in {PLUGIN} (make test-gazebo builds it)"
            return
        self.tree = tree
        self.environment = [f"VSA_DATA_DIR={tree}", f"GAZEBO_MODEL_PATH={tree}/models", f"GAZEBO_PLUGIN_PATH={tree}/{PLUGIN}",
                            "GAZEBO_MODEL_DATABASE_URI=", "GAZEBO_IP=127.0.0.1", "IGN_IP=127.0.0.1", f"IGN_PARTITION=vsa_soak_{os.getpid()}",
                            f"GAZEBO_MASTER_URI=http://127.0.0.1:{20000 + (os.getpid() + seed) % 20000}"]

    def command(self, *words):
        return [*self.prefix, "env", *self.environment, *words]

    def server(self):
        return self.command("gzserver", "--verbose", f"{self.tree}/models/worlds/snake_flat.sdf")

    def visit(self, name, place, preset):
        """(what a visit by tests/gazebo_classic/visit.sh had to complain of, if anything; how many of Gazebo's clients it was)"""
        done = subprocess.run(self.command("sh", f"{self.tree}/tests/gazebo_classic/visit.sh", str(self.tree), name, *(f"{x:.2f}" for x in place),
                                           f"{preset:.2f}"), capture_output=True, text=True, timeout=600, check=False, start_new_session=True)
        *said, last = (done.stderr + done.stdout).strip().splitlines() or [""]
        clients = re.fullmatch(r"(\d+) clients", last)
        wrong = "" if done.returncode == 0 and clients else f"{name}: {said[-1:] or last}"
        return wrong, int(clients.group(1)) if clients else 0


def process(session):
    """The server's own process, below the shells that began it in this session; None: it has gone."""
    for status in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            name, _, rest = status.read_text(encoding="utf-8", errors="replace").rpartition(")")
        except OSError:
            continue
        if re.search(r"\(gzserver$", name) and int(rest.split()[3]) == session:
            return int(status.parent.name)
    return None
