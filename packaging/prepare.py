# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Copyright file and change logs of the Debian packages, from the repository's own files.

prepare.py --version V --release R --maintainer M --out DIR   writes copyright, changelog.gz, changelog.Debian.gz
prepare.py --epoch                                            prints the seconds since 1970 of the topmost version's day

The day comes from CHANGELOG.md and not from the clock or git: the same sources make the same packages at any time, also from an
archive. SOURCE_DATE_EPOCH, where it is set, is taken instead.
"""
import argparse
import calendar
import email.utils
import gzip
import os
import pathlib
import re
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
LATEST = 253402300799  # the year 9999
HEAD = re.compile(r"^## \[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d)$", re.M)


def newest():
    """(version, epoch) of the topmost dated heading."""
    match = HEAD.search((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"))
    if not match:
        sys.exit("prepare.py: CHANGELOG.md has no heading such as ## [1.2.3] - 2026-01-31")
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if given and not (re.fullmatch("[0-9]{1,12}", given) and int(given) <= LATEST):
        print(f"prepare.py: SOURCE_DATE_EPOCH = {given} (allowed: seconds since 1970, 0 to {LATEST})", file=sys.stderr)
        sys.exit(2)
    return match.group(1), int(given) if given else calendar.timegm(time.strptime(match.group(2), "%Y-%m-%d"))


def write(path, data):
    """As Path.write_bytes, and what goes wrong names the file: a full disk's error of Python's doesn't."""
    try:
        path.write_bytes(data)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def compressed(data):
    """As gzip -9n: neither time nor name within."""
    return gzip.compress(data, 9, mtime=0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--epoch", action="store_true")
    for name in ("version", "release", "maintainer", "out"):
        parser.add_argument("--" + name)
    given = parser.parse_args()
    version, epoch = newest()
    if given.epoch:
        print(epoch)
        return
    if None in (given.version, given.release, given.maintainer, given.out):
        parser.error("--version, --release, --maintainer and --out belong together")
    if given.version != version:
        sys.exit(f"prepare.py: CMakeLists.txt makes version {given.version}, CHANGELOG.md's topmost is {version}")
    out = pathlib.Path(given.out)
    out.mkdir(parents=True, exist_ok=True)
    # What changed is in the other log: this one is of the packaging, as Debian asks for it.
    entry = (f"vsasim ({version}-{given.release}) unstable; urgency=medium\n\n  * Version {version}; what changed: changelog.gz.\n\n"
             f" -- {given.maintainer}  {email.utils.formatdate(epoch, localtime=False).replace('-0000', '+0000')}\n")
    write(out / "changelog.Debian.gz", compressed(entry.encode()))
    write(out / "changelog.gz", compressed((ROOT / "CHANGELOG.md").read_bytes()))
    write(out / "copyright", (ROOT / "packaging" / "copyright").read_bytes())


if __name__ == "__main__":
    try:
        main()
    except OSError as error:
        sys.exit(f"prepare.py: {error.filename or ROOT}: {error.strerror}")
