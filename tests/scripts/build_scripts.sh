#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# build_scripts.sh ROOT: what make and the scripts say where a tool is old, a tree has no repository or not one of its own. Tools are
# stand-ins here, and trees hold what is asked about only.
set -eu
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "build_scripts: $*" >&2; exit 1; }

# stand_in NAME TEXT: a program that says TEXT.
mkdir "$work/bin"
stand_in() { printf '#!/bin/sh\nprintf "%%s\\n" "%s"\n' "$2" >"$work/bin/$1" && chmod +x "$work/bin/$1"; }
with() { PATH="$work/bin:$PATH" "$@"; }

# Ninja's option.
for version in 1.10.1 1.8.2; do
  stand_in ninja "$version"
  [ -z "$(with sh "$root/scripts/quiet.sh")" ] || fail "Ninja $version gets --quiet"
done
for version in 1.11 1.11.1 1.12.1 2.0.git; do
  stand_in ninja "$version"
  [ "$(with sh "$root/scripts/quiet.sh")" = "-- --quiet" ] || fail "Ninja $version doesn't get --quiet"
done

# CMake's version, and what a build lacks.
stand_in cmake "cmake version 3.18.4"
! with sh "$root/scripts/configure.sh" release >"$work/out" 2>&1 || fail "CMake 3.18 is taken"
grep -q "3.18.4, $work/bin/cmake (allowed: 3.21 or later)" "$work/out" || fail "CMake 3.18: $(cat "$work/out")"
stand_in cmake "cmake version 3.25.1
-- topics: left out: no library found
-- Found PkgConfig: yes"
[ "$(with sh "$root/scripts/configure.sh" release 2>&1)" = "configure: topics: left out: no library found" ] ||
  fail "configuring says: $(with sh "$root/scripts/configure.sh" release 2>&1)"

TMPDIR="$work/nowhere" && export TMPDIR
! with sh "$root/scripts/configure.sh" release >"$work/out" 2>&1 || fail "a TMPDIR that isn't there is taken"
unset TMPDIR
grep -qF "TMPDIR = $work/nowhere: " "$work/out" || fail "a TMPDIR that isn't there: $(cat "$work/out")"

# No network: one line says what can be done, after what the tool says itself.
printf '#!/bin/sh\necho "$*" >>"%s/asked"\nexit 1\n' "$work" >"$work/bin/npm" && chmod +x "$work/bin/npm"
! sh "$root/web/fetch.sh" "$work/bin/npm" "$work" >"$work/out" 2>&1 || fail "npm's failure is none"
grep -q "^web: .*registry once.*make dist" "$work/out" || fail "npm fails: $(cat "$work/out")"
grep -q -- "--fetch-retries=1 " "$work/asked" || fail "npm tries for minutes: $(cat "$work/asked")"

# A home that can't be written: npm gets a cache of its own, beside what it fetches. A full disk is told as that.
grep -q -- "--cache" "$work/asked" && fail "npm's own cache isn't used: $(cat "$work/asked")"
: >"$work/no_folder"
! HOME="$work/no_folder" npm_config_cache="" sh "$root/web/fetch.sh" "$work/bin/npm" "$work" >"$work/out" 2>&1 || fail "npm's failure is none"
grep -q -- "--cache $work/cache --logs-max=0 " "$work/asked" || fail "no cache for npm: $(cat "$work/asked")"
printf '#!/bin/sh\necho "npm ERR! code ENOSPC" >&2\nexit 1\n' >"$work/bin/npm"
! sh "$root/web/fetch.sh" "$work/bin/npm" "$work" >"$work/out" 2>&1 || fail "npm's failure is none"
grep -q "^npm ERR! code ENOSPC" "$work/out" && grep -q "^web: $work: no space for the pages' packages" "$work/out" ||
  fail "npm meets a full disk: $(cat "$work/out")"
! grep -q "registry" "$work/out" || fail "a full disk is told as a registry: $(cat "$work/out")"
stand_in df "Filesystem 1024-blocks Used Available Capacity Mounted on
disk 1000000 997952 2048 99% /"
printf '#!/bin/sh\ntouch "%s/was_asked"\n' "$work" >"$work/bin/npm"
! with sh "$root/web/fetch.sh" "$work/bin/npm" "$work" >"$work/out" 2>&1 || fail "npm is asked on a full disk"
grep -q "no space .* 2 MB are free: they need " "$work/out" && [ ! -e "$work/was_asked" ] || fail "a full disk: $(cat "$work/out")"
rm "$work/bin/npm" "$work/bin/df"
for at in update install; do
  printf '#!/bin/sh\n[ "$1" != %s ]\n' "$at" >"$work/bin/apt-get"
  printf '#!/bin/sh\nexec "$@"\n' >"$work/bin/sudo"
  stand_in dpkg-query ""
  chmod +x "$work/bin/apt-get" "$work/bin/sudo"
  ! with sh "$root/scripts/setup.sh" >"$work/out" 2>&1 || fail "apt-get $at fails, setup.sh doesn't"
  grep -q "^setup.sh: apt-get $at failed: .* cmake " "$work/out" || fail "apt-get $at fails: $(cat "$work/out")"
done

# setup.sh knows systems by their os-release: on_system TEXT GROUP… says what it would install there.
mkdir -p "$work/system/scripts"
sed "s|/etc/os-release|$work/os-release|" "$root/scripts/setup.sh" >"$work/system/scripts/setup.sh"
printf '#!/bin/sh\nexit 0\n' >"$work/bin/apt-get"
on_system() {
  printf '%s\n' "$1" >"$work/os-release" && shift
  with sh "$work/system/scripts/setup.sh" "$@" >"$work/out" 2>&1
}
on_system 'VERSION_CODENAME=noble' fuzz || fail "setup.sh on Ubuntu 24.04: $(cat "$work/out")"
grep -q "^setup: installing .* libmujoco-dev .* clang-18 " "$work/out" || fail "setup.sh on Ubuntu 24.04: $(cat "$work/out")"
! grep -q "never tried" "$work/out" || fail "setup.sh on Ubuntu 24.04, which was tried: $(cat "$work/out")"
on_system 'NAME="Linux Mint"
VERSION_CODENAME=wilma
UBUNTU_CODENAME="noble"' && grep -q " libmujoco-dev" "$work/out" || fail "setup.sh on a derivative of Ubuntu 24.04: $(cat "$work/out")"
code=0 && on_system "UBUNTU_CODENAME='jammy'" || code=$?
[ "$code" -eq 2 ] && [ "$(wc -l <"$work/out")" -eq 1 ] && grep -q "jammy.*no MuJoCo.*(allowed: " "$work/out" ||
  fail "setup.sh on Ubuntu 22.04 ends with $code: $(cat "$work/out")"
on_system 'VERSION_CODENAME=bookworm
PRETTY_NAME="Debian GNU/Li' && grep -q " libsdformat-dev" "$work/out" || fail "an os-release that was cut: $(cat "$work/out")"
on_system 'NAME="some' && grep -q "never tried.*unknown" "$work/out" || fail "an unknown system: $(cat "$work/out")"

# A package that apt doesn't know is named. Where it knows none, its lists are what is missing.
printf '#!/bin/sh\n[ "$1" != install ]\n' >"$work/bin/apt-get"
cat >"$work/bin/apt-cache" <<'EOF'
#!/bin/sh
shift
for p in "$@"; do [ "$p" = libpagmo-dev ] || echo "Package: $p"; done
exit 100
EOF
chmod +x "$work/bin/apt-cache"
! on_system 'VERSION_CODENAME=trixie' || fail "a package that apt doesn't know is installed"
grep -q "^setup.sh: apt knows no package of these names: libpagmo-dev: " "$work/out" || fail "an unknown package: $(cat "$work/out")"
printf '#!/bin/sh\nexit 100\n' >"$work/bin/apt-cache"
! on_system 'VERSION_CODENAME=trixie' || fail "packages that apt doesn't know are installed"
grep -q "^setup.sh: apt-get install failed: without a network" "$work/out" || fail "no lists of packages: $(cat "$work/out")"
rm "$work/bin/apt-get" "$work/bin/apt-cache" "$work/bin/sudo" "$work/bin/dpkg-query"

# A tree without a repository, below another's: its sources are found, and no archive is made of it.
tree="$work/a tree"
mkdir -p "$tree/scripts" "$tree/src/build" "$tree/build" "$tree/.hidden" "$tree/web/node_modules"
cp "$root/scripts/sources.sh" "$root/scripts/dist.sh" "$tree/scripts"
cp "$root/Makefile" "$tree"
! sh "$tree/scripts/sources.sh" >"$work/out" 2>&1 || fail "a tree without a source is fine"
for file in src/a.cpp src/b.hpp build/c.cpp .hidden/d.cpp web/node_modules/e.hpp src/f.txt; do : >"$tree/$file"; done
[ "$(sh "$tree/scripts/sources.sh" | tr '\n' ' ')" = "src/a.cpp src/b.hpp " ] || fail "sources: $(sh "$tree/scripts/sources.sh")"
! sh "$tree/scripts/dist.sh" >"$work/out" 2>&1 || fail "an archive without a repository"
! grep -q "File exists" "$work/out" || fail "$(cat "$work/out")"
if command -v git >/dev/null; then
  git -c init.defaultBranch=main init -q "$work"
  ! sh "$tree/scripts/dist.sh" >"$work/out" 2>&1 || fail "an archive of another's repository"
  grep -q "it lies in that of $work" "$work/out" || fail "an archive of another's repository: $(cat "$work/out")"
  # git refuses: nothing is looked at, and that isn't fine.
  : >"$tree/.git"
  ! sh "$tree/scripts/sources.sh" >/dev/null 2>&1 || fail "sources where git fails"
  ! make -s -C "$tree" format >/dev/null 2>&1 || fail "make format where git fails"
  rm "$tree/.git"
  if [ "$(id -u)" -eq 0 ]; then
    git -c init.defaultBranch=main init -q "$tree"
    chown -R 12345 "$tree"
    ! sh "$tree/scripts/dist.sh" >"$work/out" 2>&1 || fail "an archive of a repository that git doesn't trust"
    grep -q "dubious ownership" "$work/out" || fail "a repository that git doesn't trust: $(cat "$work/out")"
    chown -R 0 "$tree" && rm -rf "$tree/.git"
  fi
fi

# Only a repository needs git: the sources' archive is built without. Nothing is installed, and nothing is what would be.
for tool in dpkg-query apt-get sudo; do stand_in "$tool" ""; done
cp "$root/scripts/setup.sh" "$tree/scripts"
! with sh "$tree/scripts/setup.sh" 2>&1 | grep -w git || fail "setup.sh asks for git where there is no repository"
: >"$tree/.git"
with sh "$tree/scripts/setup.sh" | grep -qw git || fail "setup.sh doesn't ask for git in a repository"
rm "$tree/.git"

# A file that can't be written, as on a full disk, is one line.
version=$(sed -n 's/^project(vsasim VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
cant() { (ulimit -f 0 && ! python3 -B "$@" 2>&1) || fail "$1 writes where nothing can be written"; }
said=$(cant "$root/packaging/prepare.py" --version "$version" --release 1 --maintainer m --out "$work/packaging")
[ "$said" = "prepare.py: $work/packaging/changelog.Debian.gz: File too large" ] || fail "prepare.py: $said"
said=$(cant "$root/packaging/manual.py" --out "$work/manual")
echo "$said" | grep -qx "manual.py: $work/manual/.*: File too large" || fail "manual.py: $said"

# Arguments that are missing, and a build that fails, are a line too.
code=0 && python3 -B "$root/packaging/sbom.py" "$work" >"$work/out" 2>&1 || code=$?
[ "$code" -eq 2 ] && grep -q "^sbom.py: not PACKAGES BUILD" "$work/out" || fail "sbom.py without a build ends with $code: $(cat "$work/out")"
if python3 -c "import setuptools" 2>/dev/null; then
  printf '#!/bin/sh\nexit 3\n' >"$work/bin/cmake"
  ! (cd "$work" && env -u VSA_BUILD_DIR PATH="$work/bin:$PATH" python3 -B "$root/setup.py" -q build_ext --build-temp "$work/pip" >"$work/out" 2>&1) ||
    fail "setup.py doesn't fail where CMake does"
  grep -q "^setup.py: cmake -S .*: exit code 3" "$work/out" || fail "setup.py where CMake fails: $(cat "$work/out")"
  ! grep -q Traceback "$work/out" || fail "setup.py where CMake fails: $(cat "$work/out")"
  rm "$work/bin/cmake"
fi

# Missing libraries are told all at once, with what brings them.
mkdir "$work/needs"
cat >"$work/needs/CMakeLists.txt" <<EOF
cmake_minimum_required(VERSION 3.18)
project(needs LANGUAGES NONE)
include("$root/cmake/required.cmake")
set(old_DIR "$work/needs")
vsa_need_package(old libold-dev 9.1)
vsa_need_package(nosuch libnosuch-dev)
find_path(NOSUCH_INCLUDE_DIR nosuch.h)
vsa_need(nosuch.h libnosuch-dev NOSUCH_INCLUDE_DIR)
set(THERE TRUE)
vsa_need(there libthere-dev THERE)
vsa_need_module(nosuch nosuch-module libnosuch2-dev)
vsa_end_of_needs()
EOF
echo >"$work/needs/oldConfig.cmake"
echo 'set(PACKAGE_VERSION 8.3)' >"$work/needs/oldConfigVersion.cmake"
! cmake -S "$work/needs" -B "$work/needs/build" >"$work/out" 2>&1 || fail "configuring without libraries"
for line in "old: libold-dev (found 8.3, needed 9.1)" "nosuch: libnosuch-dev" "nosuch.h: libnosuch-dev" "nosuch-module: libnosuch2-dev"; do
  grep -qx "    $line" "$work/out" || fail "not told: $line: $(cat "$work/out")"
done
! grep -q "libthere-dev" "$work/out" || fail "told of a library that is there: $(cat "$work/out")"

# A package that dpkg has as installed, and whose files are gone: setup.sh alone doesn't bring them back.
! grep -q reinstall "$work/out" || fail "told to install again what never was: $(cat "$work/out")"
mkdir "$work/dpkg"
printf '#!/bin/sh\n[ "$3" = libnosuch-dev ] && printf "install ok installed"\n' >"$work/dpkg/dpkg-query" && chmod +x "$work/dpkg/dpkg-query"
! PATH="$work/dpkg:$PATH" cmake -S "$work/needs" -B "$work/needs/again" >"$work/out" 2>&1 || fail "configuring without libraries"
grep -qx "    apt-get install --reinstall libnosuch-dev" "$work/out" || fail "of a package that is broken: $(cat "$work/out")"

# make -f from elsewhere does its work where the Makefile stands.
mkdir "$tree/out"
(cd "$work" && make -s -f "$tree/Makefile" clean)
if [ -e "$tree/build" ] || [ ! -e "$tree/out" ]; then fail "make -f PATH/Makefile clean"; fi
