#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What programs that link libvsasim.so rely on, recorded and compared: python3 scripts/abi.py record|check BUILD

The library needs no debug info. For each symbol that it exports a pointer of the exact type is written down, and the compiler tells
which of them a program can name with the headers: what is private, or in no header, doesn't compile and is nobody's to call. abidw
records these pointers with all types that they lead to, the fields of classes and the order of virtual functions too; abidiff compares
that with packaging/abi/vsasim-MAJOR.MINOR-COMPILER-MACHINE.abi. What headers hold whole, a program has compiled in: not looked at.

check    code 1 where something went or changed under the same minor version; what only came is listed. With a compiler or machine that
         nothing was recorded with it says so and compares nothing; where a minor version has no record at all, code 1.
record   writes that file; says what it breaks.
Either: code 2 where a tool fails or something that they need is missing.
"""
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECORDS = ROOT / "packaging/abi"
# Templates are made of what they were given only where somebody needs to know their size.
HEAD = """#include "all.hpp"
template <class T, bool kNone = std::is_reference_v<T> || std::is_void_v<T>> constexpr bool whole = sizeof(std::conditional_t<kNone, int, T>) > 0;
extern "C" {
"""
# What abidiff's lines say at length: the symbol again, the pointer's own type before the function's name, and strings.
SHORTER = {r"(?m)\s+\{[^{}\n]*\}$": "", r"(\[[DA]\] )'.*\)\* (vsa::.*)'": r"\1\2", r"\[abi:cxx11\]": "",
           r"std::(__cxx11::)?basic_string<char, std::char_traits<char>, std::allocator<char> ?>": "std::string"}
ROUNDS = 6  # of compiling without what failed; two are usual


def output(*command, **more):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True, **more).stdout


def demangled(names):
    return output("c++filt", "-i", input="\n".join(names)).splitlines()


def split_top(text, separator):
    """TEXT at each SEPARATOR outside of brackets."""
    parts, depth, start, i = [], 0, 0, 0
    while i < len(text):
        if text[i] in "<([{":
            depth += 1
        elif text[i] in ">)]}":
            depth -= 1
        elif depth == 0 and text.startswith(separator, i):
            parts.append(text[start:i])
            i += len(separator) - 1
            start = i + 1
        i += 1
    return [*parts, text[start:]]


def whole_types(*types):
    return f"static_assert((whole<{'> && whole<'.join(types)}>));"


def pointers_to(symbol, name):
    """The lines that may declare a pointer to what NAME, which SYMBOL is the mangled form of, means; the compiler takes one or none."""
    table = re.fullmatch(r"(?:vtable|typeinfo) for (.+)", name)
    if table:
        return [f"{table[1]}* t{symbol};"]
    function = re.fullmatch(r"(.+?)(\(.*\))( const)?( ?&&?)?", re.sub(r"\[abi:\w+\]", "", name))
    if not function:
        return [f"auto* o{symbol} = &{name};"]
    whole, cv = function[1] + function[2], function[3] or ""
    # The parameters are the last bracket at the top level; operator() has one more.
    depth = 0
    for at in range(len(whole) - 1, -1, -1):
        depth += (whole[at] == ")") - (whole[at] == "(")
        if depth == 0:
            break
    callee, inside = whole[:at], whole[at + 1:-1]
    types = split_top(inside, ",") if inside else []
    values = ", ".join(f"std::declval<{t.strip()}>()" for t in types)
    scope, last = "::".join(split_top(callee, "::")[:-1]), split_top(callee, "::")[-1]
    if last.startswith("~"):
        return [f"{scope}* d{symbol};"]
    if last == split_top(scope, "::")[-1]:
        return [f"decltype({scope}({values}))* c{symbol};"]
    ref = (function[4] or "").strip()
    result = f"decltype(std::declval<{scope}{cv}{ref or '&'}>().{last}({values}))"
    method = f"static_cast<{result} ({scope}::*)({inside}){cv} {ref}>(&{callee})"
    # abidw doesn't know pointers to members, so a method's has the object as its first parameter.
    return [f"decltype({callee}({values})) (*f{symbol})({inside}) = &{callee}; {whole_types(f'decltype({callee}({values}))', *types)}",
            f"static_assert(sizeof({method})); {result} (*m{symbol})({', '.join([scope + cv + '*', *types])}); {whole_types(result, *types)}"]


def exported(library):
    symbols = [line.split() for line in output("nm", "-D", "--defined-only", "--without-symbol-versions", library).splitlines()]
    # Strong ones: a function that headers hold is compiled into each program. Of a constructor's and a destructor's forms, one.
    return sorted({name for *_, kind, name in symbols if kind in "TDBR" and re.match(r"_Z(T[VI])?N", name)
                   and not re.search(r"(C2|D0|D2)E\w*$", name)})


def compiler_of(build):
    return re.search(r"^CMAKE_CXX_COMPILER:\w+=(.+)$", (build / "CMakeCache.txt").read_text(encoding="utf-8"), re.M)[1]


def name_of(program):
    kind = "clang" if "clang" in output(program, "--version") else "gcc"
    return kind + output(program, "-dumpversion").strip().split(".")[0] + "-" + output(program, "-dumpmachine").split("-")[0]


class Compiler:
    def __init__(self, build, folder):
        self.program = compiler_of(build)
        commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
        system = set()
        for words in (shlex.split(c["command"]) for c in commands if c["file"].startswith((f"{ROOT}/src/", f"{build.resolve()}/src/"))):
            system |= {f"-isystem{value}" for flag, value in zip(words, words[1:]) if flag == "-isystem"}
        self.flags = ["-std=c++20", "-O0", "-fPIC", "-w", "-fmax-errors=0", f"-I{ROOT}/include", *sorted(system)]
        self.folder = folder
        headers = sorted(p.relative_to(ROOT / "include") for p in (ROOT / "include").rglob("*.hpp"))
        (folder / "all.hpp").write_text("#include <type_traits>\n#include <utility>\n" + "".join(f"#include <{h}>\n" for h in headers), encoding="utf-8")

    def wrong(self, lines, *how):
        """The numbers of the lines that don't compile."""
        (self.folder / "abi.cpp").write_text(HEAD + "\n".join(lines) + "\n}\n", encoding="utf-8")
        done = subprocess.run([self.program, *self.flags, *how, "abi.cpp"], cwd=self.folder, capture_output=True,
                              text=True, env={"LC_ALL": "C", "PATH": "/usr/local/bin:/usr/bin:/bin"}, check=False)
        wrong = {int(n) - 1 - HEAD.count("\n") for n in re.findall(r"^abi\.cpp:(\d+):\d+: (?:error|  required from here)", done.stderr, re.M)}
        if done.returncode and not wrong:
            raise RuntimeError(f"abi.cpp doesn't compile:\n{done.stderr[-3000:]}")
        return wrong


def record(build, out):
    """Writes what the library of BUILD shows, as of its headers, to the file OUT."""
    library = build / "src/libvsasim.so"
    if not library.exists():
        raise RuntimeError(f"{library} is missing: configure with -DVSA_SHARED=ON")
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        compiler = Compiler(build, folder)
        symbols = exported(library)
        lines = [line for symbol, name in zip(symbols, demangled(symbols)) for line in pointers_to(symbol, name)]
        for _ in range(ROUNDS):
            wrong = compiler.wrong(lines, "-fsyntax-only")
            lines = [line for i, line in enumerate(lines) if i not in wrong]
            # Most rounds are the first and the last, which is the one that makes the library.
            if not compiler.wrong(lines, "-g", "-femit-class-debug-always", "-shared", "-o", "abi.so"):
                break
        else:
            raise RuntimeError(f"abi.cpp still doesn't compile after {ROUNDS} rounds")
        output("abidw", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", "--no-elf-needed", "--no-parameter-names",
               "--type-id-style", "hash", "--out-file", out, folder / "abi.so")
        trim(out)
        print(f"abi: {len(lines)} of {len(symbols)} exported symbols can be named with the headers")


CLASSES = ("class-decl", "union-decl")


def trim(file):
    """Of FILE's types, those that the pointers lead to; of others' classes the size, not the members: four fifths of the file."""
    tree = ET.parse(file)
    root = tree.getroot()
    parents = {child: parent for parent in root.iter() for child in parent}
    ids, foreign = {}, set()
    for element in root.iter():
        ids.setdefault(element.get("id"), []).append(element)
        if element.tag in CLASSES and "vsa" not in (up.get("name") for up in ancestors(element, parents)):
            foreign.add(element)
    kept = set()
    todo = [v for v in root.iter("var-decl") if v.get("elf-symbol-id")]
    while todo:
        element = todo.pop()
        if element in kept:
            continue
        kept.add(element)
        above = parents.get(element)
        if above is not None:
            todo.append(above)
        for name in ("type-id", "naming-typedef-id"):
            todo += ids.get(element.get(name), []) if element.get(name) else []
        # What is within goes with it, but for what only groups and for others' classes.
        if element not in foreign and element.tag not in ("abi-corpus", "abi-instr", "namespace-decl"):
            todo += element
    symbols = {v.get("elf-symbol-id") for v in kept}
    for element in list(root.iter()):
        group = element.tag in ("elf-function-symbols", "elf-variable-symbols") or element in foreign or element in kept
        for child in list(element) if group else []:
            if child not in kept and (child.tag != "elf-symbol" or child.get("name") not in symbols) and not child.tag.startswith("elf-v"):
                element.remove(child)
    ET.indent(tree, " ")
    tree.write(file, encoding="unicode")


def ancestors(element, parents):
    while (element := parents.get(element)) is not None:
        yield element


def version():
    return ".".join(re.search(r"^project\(vsasim VERSION (\d+)\.(\d+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M).groups())


def compare(old, new, *more):
    """abidiff's code and report, with names as people write them."""
    done = subprocess.run(["abidiff", "--no-show-locs", *more, old, new], capture_output=True, text=True, check=False)
    if done.returncode & 3:
        raise RuntimeError(f"abidiff: {done.stderr or done.stdout}")
    named = output("c++filt", "-i", input=re.sub(r"\b[a-z](_Z\w+)", r"\1", done.stdout))
    for long, short in SHORTER.items():
        named = re.sub(long, short, named)
    return done.returncode, named


def main(what, build):
    compiler = name_of(compiler_of(build))
    old = RECORDS / f"vsasim-{version()}-{compiler}.abi"
    if not old.exists() and what == "check":
        others = sorted(RECORDS.glob(f"vsasim-{version()}-*.abi"))
        print(f"abi: no record of {version()} with {compiler}" + (f"; compared with {others[0].name} by who has that" if others else
              ": make record-abi writes one"))
        return 0 if others else 1
    if not compiler.startswith("gcc"):
        raise RuntimeError(f"{compiler}: a record is made with GCC, whose debug information holds classes that nothing defines")
    with tempfile.TemporaryDirectory() as temporary:
        new = pathlib.Path(temporary) / "new.abi"
        record(build, new)
        broken, report = compare(old, new, "--no-added-syms") if old.exists() else (0, "")
        if broken:
            print(report, f"abi: not compatible with {old.relative_to(ROOT)}; raise the minor version, or take it back", sep="\n")
        elif old.exists():
            came, report = compare(old, new)
            print(report + "abi: these came" if came else "abi: as recorded")
        if what == "record":
            RECORDS.mkdir(exist_ok=True)
            old.write_bytes(new.read_bytes())
            print(f"abi: {old.relative_to(ROOT)} written")
            return 0
        return 1 if broken else 0


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("record", "check"):
        print("usage: abi.py record|check BUILD", file=sys.stderr)
        sys.exit(2)
    try:
        sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve()))
    except subprocess.CalledProcessError as error:  # not 1, which is "incompatible"
        print(f"abi.py: {shlex.join(error.cmd)}: exit code {error.returncode}\n{error.stderr}", file=sys.stderr)
        sys.exit(2)
    except (RuntimeError, OSError) as error:
        print(f"abi.py: {error}", file=sys.stderr)
        sys.exit(2)
