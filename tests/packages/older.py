# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""older.py FROM TO VERSION: the packages in FROM under an older version in TO; vsasim-data has a file more than there."""
import pathlib
import re
import subprocess
import sys
import tempfile

source, target, version = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
for deb in sorted(source.glob("*.deb")):
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder) / "tree"
        subprocess.run(["dpkg-deb", "-R", deb, tree], check=True)
        control = tree / "DEBIAN" / "control"
        text = control.read_text(encoding="utf-8")
        now = re.search(r"^Version: (.*)$", text, re.M).group(1)
        text = text.replace("Version: " + now, "Version: " + version).replace(f"(= {now})", f"(= {version})")
        control.write_text(text, encoding="utf-8")
        if deb.name.startswith("vsasim-data_"):
            (tree / "usr/share/vsa/actuators/of_the_first_version.toml").write_text("# gone in the second\n", encoding="utf-8")
        (tree / "DEBIAN" / "md5sums").unlink()
        name = deb.name.replace(now, version)
        subprocess.run(["dpkg-deb", "--root-owner-group", "-Znone", "-b", tree, target / name], check=True, stdout=subprocess.DEVNULL)
