# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What the Debian packages contain, as an SPDX 2.3 document: sbom.py PACKAGES BUILD…  writes PACKAGES/vsasim-VERSION.spdx.json

Of each package: its files with checksums; what is in its binaries besides code of ours (the headers and static libraries that the
compiler and the linker read, by the build's own log, with the Debian package and version they came from), the JavaScript packages in
the pages (bundled.json), and the packages it needs when it runs. BUILD: the build trees that the packages were made in.
"""
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time
import uuid

import prepare

ROOT = pathlib.Path(__file__).resolve().parent.parent
OURS = "Apache-2.0"
AUTHORS = "Copyright 2026 The vsasim authors"
# Only lines of two texts; Python before 3.11 has no reader of TOML.
LICENCES = {json.loads(f'"{key}"'): value for key, value in
            re.findall(r'^"(.*)" = "(.*)"$', (ROOT / "packaging" / "licences.toml").read_text(encoding="utf-8"), re.M)}


def output(*command, **more):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True, **more).stdout


def identifier(*words):
    return "SPDXRef-" + "-".join(re.sub(r"[^A-Za-z0-9.]+", "-", w).strip("-") for w in words)


class Debian:
    """Whose a file of this system is, and which version."""

    def __init__(self):
        self.owners, self.versions = {}, {}

    def owner(self, files):
        """Packages of these files; asked for many at once, since each asking takes a tenth of a second."""
        real = {f: os.path.realpath(f) for f in files}
        unknown = sorted({r for r in real.values() if r not in self.owners})
        for i in range(0, len(unknown), 400):
            done = subprocess.run(["dpkg-query", "-S", *unknown[i : i + 400]], capture_output=True, text=True)
            for line in done.stdout.splitlines():
                owner, _, file = line.partition(": ")
                self.owners[file] = owner.split(",")[0].split(":")[0]
        for r in unknown:
            self.owners.setdefault(r, "")
        return {self.owners[r] for r in real.values()} - {""}

    def version(self, package):
        if package not in self.versions:
            self.versions[package] = output("dpkg-query", "-W", "-f", "${Version}", package)
        return self.versions[package]


class Build:
    """A build tree's log: what each of its targets was compiled and linked of."""

    def __init__(self, folder, debian):
        self.folder, self.debian = folder, debian
        self.targets = {}
        for line in output("ninja", "-C", folder, "-t", "targets", "all").splitlines():
            target = line.rsplit(": ", 1)[0]
            if not target.startswith("/") and not target.startswith("cmake_object_order"):
                self.targets.setdefault(pathlib.Path(target).name, target)
        self.headers = {}
        current = None
        for line in output("ninja", "-C", folder, "-t", "deps").splitlines():
            if line and not line.startswith(" "):
                current = self.headers.setdefault(line.split(": #deps")[0], [])
            elif line.strip().startswith("/usr/") and current is not None:
                current.append(line.strip())

    def packages_in(self, name):
        """Debian packages of which something was compiled or linked into the file of this name."""
        if name not in self.targets:
            return set()
        commands = output("ninja", "-C", self.folder, "-t", "commands", self.targets[name]).splitlines()
        objects = {match for line in commands for match in re.findall(r" -o (\S+\.o)\b", line)}
        files = {header for o in objects for header in self.headers.get(o, [])}
        link = shlex.split(commands[-1].replace("&&", " "))
        if not name.endswith(".a"):
            files |= {word for word in link if word.startswith("/usr/") and word.endswith(".a")}
        return self.debian.owner(files)


def licence_of(package):
    for pattern, licence in LICENCES.items():
        if re.fullmatch(pattern, package):
            return licence
    sys.exit(f"sbom.py: something of {package} is compiled in, and packaging/licences.toml doesn't know its licence")


def sums(data):
    return [{"algorithm": "SHA1", "checksumValue": hashlib.sha1(data).hexdigest()},
            {"algorithm": "SHA256", "checksumValue": hashlib.sha256(data).hexdigest()}]


class Document:
    def __init__(self, version, epoch):
        self.packages, self.files, self.relationships = {}, {}, []
        created = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(epoch))
        self.head = {
            "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"vsasim-{version}",
            "creationInfo": {"created": created, "creators": ["Organization: The vsasim authors", f"Tool: vsasim-sbom-{version}"]},
        }

    def relate(self, one, how, other, comment=None):
        relationship = {"spdxElementId": one, "relationshipType": how, "relatedSpdxElement": other}
        if comment:
            relationship["comment"] = comment
        if relationship not in self.relationships:
            self.relationships.append(relationship)

    def foreign(self, kind, name, version, licence, purl):
        key = identifier(kind, name)
        self.packages.setdefault(key, {
            "name": name, "SPDXID": key, "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION", "licenseDeclared": licence, "copyrightText": "NOASSERTION",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": purl}]})
        return key

    def text(self, fingerprint):
        namespace = uuid.uuid5(uuid.NAMESPACE_OID, fingerprint)
        return json.dumps({**self.head, "documentNamespace": f"urn:uuid:{namespace}",
                           "packages": [self.packages[k] for k in sorted(self.packages)],
                           "files": [self.files[k] for k in sorted(self.files)],
                           "relationships": sorted(self.relationships, key=lambda r: json.dumps(r, sort_keys=True))},
                          indent=1, ensure_ascii=False, sort_keys=True) + "\n"


def add_files(document, key, name, tree):
    """The package's files; their verification code is SPDX's: the SHA1 of all SHA1, sorted."""
    sha1 = []
    for path in sorted(p for p in tree.rglob("*") if p.is_file() and not p.is_symlink()):
        relative = "./" + path.relative_to(tree).as_posix()
        data = path.read_bytes()
        file_key = identifier("File", name, hashlib.sha1(relative.encode()).hexdigest()[:16])
        sha1.append(hashlib.sha1(data).hexdigest())
        kind = "BINARY" if data[:4] == b"\x7fELF" or data[:8] == b"!<arch>\n" else "ARCHIVE" if relative.endswith(".gz") else "TEXT"
        document.files[file_key] = {"fileName": relative, "SPDXID": file_key, "checksums": sums(data), "fileTypes": [kind],
                                    "licenseConcluded": "NOASSERTION", "copyrightText": "NOASSERTION"}
        document.relate(key, "CONTAINS", file_key)
    return hashlib.sha1("".join(sorted(sha1)).encode()).hexdigest()


def add_package(document, deb, builds, ours, tree):
    fields = dict(re.findall(r"^(\S+): (.*)$", output("dpkg-deb", "-f", deb), re.M))
    name, version, architecture = fields["Package"], fields["Version"], fields["Architecture"]
    subprocess.run(["dpkg-deb", "-x", deb, tree], check=True)
    key = identifier("Package", name)
    code = add_files(document, key, name, tree)
    document.packages[key] = {
        "name": name, "SPDXID": key, "versionInfo": version, "packageFileName": deb.name, "supplier": "Organization: The vsasim authors",
        "downloadLocation": "NOASSERTION", "filesAnalyzed": True, "packageVerificationCode": {"packageVerificationCodeValue": code},
        "checksums": sums(deb.read_bytes()), "licenseConcluded": "NOASSERTION", "licenseDeclared": OURS, "copyrightText": AUTHORS,
        "licenseInfoFromFiles": ["NOASSERTION"],
        "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                          "referenceLocator": f"pkg:deb/vsasim/{name}@{version}?arch={architecture}"}]}
    document.relate("SPDXRef-DOCUMENT", "DESCRIBES", key)
    compiled = re.compile(r".*(\.a|\.so(\.[0-9.]+)?)|.*/bin/[^/]+")
    for path in sorted(p for p in tree.rglob("*") if p.is_file() and not p.is_symlink() and compiled.fullmatch(p.as_posix())):
        for build in builds:
            for package in sorted(build.packages_in(path.name)):
                other = document.foreign("Debian", package, build.debian.version(package), licence_of(package),
                                         f"pkg:deb/debian/{package}@{build.debian.version(package)}")
                document.relate(key, "STATIC_LINK", other, "code of its headers or static libraries is compiled in")
    bundled = tree / "usr/share/vsa/web/bundled.json"
    if bundled.exists():
        for page in json.loads(bundled.read_text(encoding="utf-8")).values():
            for p in page:
                other = document.foreign("npm", p["name"], p["version"], p["license"], f"pkg:npm/{p['name']}@{p['version']}")
                document.relate(key, "CONTAINS", other, "bundled, minified; its licence's text is in the page")
    for dependency in fields.get("Depends", "").split(","):
        first = dependency.split("|")[0].split()
        if not first:
            continue
        if first[0] in ours:
            document.relate(key, "DEPENDS_ON", identifier("Package", first[0]))
        else:
            bound = re.search(r"\((.*)\)", dependency.split("|")[0])
            other = document.foreign("Needed", first[0], bound.group(1) if bound else "any", "NOASSERTION", f"pkg:deb/debian/{first[0]}")
            document.relate(key, "DEPENDS_ON", other)


def main():
    if len(sys.argv) < 3:
        print("sbom.py: not PACKAGES BUILD…: the folder of the packages, the build trees that they were made in", file=sys.stderr)
        sys.exit(2)
    folder, debian = pathlib.Path(sys.argv[1]), Debian()
    builds = [Build(pathlib.Path(b), debian) for b in sys.argv[2:]]
    debs = sorted(folder.glob("*.deb"))
    if not debs:
        print(f"sbom.py: PACKAGES = {folder}: no .deb is there (allowed: a folder with packages)", file=sys.stderr)
        sys.exit(2)
    version, epoch = prepare.newest()
    ours = {output("dpkg-deb", "-f", d, "Package").strip() for d in debs}
    document = Document(version, epoch)
    for deb in debs:
        with tempfile.TemporaryDirectory() as tree:
            add_package(document, deb, builds, ours, pathlib.Path(tree))
    fingerprint = " ".join(hashlib.sha256(d.read_bytes()).hexdigest() for d in debs)
    (folder / f"vsasim-{version}.spdx.json").write_text(document.text(fingerprint), encoding="utf-8")
    inside = sum(1 for k in document.packages if k.startswith(("SPDXRef-Debian-", "SPDXRef-npm-")))
    print(f"sbom: {len(debs)} packages, {len(document.files)} files, {inside} packages of others inside")


if __name__ == "__main__":
    main()
