#!/bin/sh
# Installs what building, testing and running vsasim needs on Debian 12 and 13 and on Ubuntu 24.04 (docs/reference/systems.md).
# Idempotent: when every package is present it touches neither the network nor the package manager.
set -eu

# Read, not sourced: a file that was cut in the middle is no error of the shell's here.
of_system() { sed -n "s/^$1=[\"']\{0,1\}\([A-Za-z0-9._-]*\).*/\1/p" /etc/os-release 2>/dev/null | tail -n 1; }
# Ubuntu's derivatives (Mint) have names of their own, and say whose packages they take.
codename=$(of_system UBUNTU_CODENAME)
[ -n "$codename" ] || codename=$(of_system VERSION_CODENAME)

packages="
  build-essential cmake ninja-build pkg-config ca-certificates
  libqhull-dev libgl-dev libopengl-dev liblodepng-dev libzip-dev
  libtomlplusplus-dev libtinyxml2-dev libcli11-dev libfmt-dev nlohmann-json3-dev libboost-dev libceres-dev libeigen3-dev libnlopt-cxx-dev libhdf5-dev libpagmo-dev
  libgtest-dev libbenchmark-dev python3-yaml
  python3-dev python3-numpy pybind11-dev
"
# Only a repository has commits to ask about: an archive of the sources is built without it.
[ ! -e "$(dirname "$0")/../.git" ] || packages="$packages git"
browser=chromium
tried=yes
clang=14
# What SDF, URDF and topics need, where the system packages it; MuJoCo, where it does. docs/reference/systems.md
case "$codename" in
  bookworm)
    packages="$packages libmujoco-dev libsdformat-dev liburdfdom-dev libassimp-dev libbullet-extras-dev libignition-transport-dev libignition-msgs-dev ignition-transport-cli"
    ;;
  trixie)
    packages="$packages libmujoco-dev liburdfdom-dev libassimp-dev libbullet-extras-dev"
    clang=19
    ;;
  # No browser: Ubuntu's is a snap.
  noble)
    packages="$packages libmujoco-dev liburdfdom-dev libassimp-dev libbullet-extras-dev"
    browser=""
    clang=18
    ;;
  jammy)
    echo "setup.sh: Ubuntu 22.04 (jammy) packages no MuJoCo, lodepng, toml++ and pagmo, and too old a pybind11 (2.9; needed: 2.10) and Node.js (12; needed: 18) (allowed: Ubuntu 24.04, Debian 12, Debian 13)" >&2
    exit 2
    ;;
  *) tried=no ;;
esac

# The page tests drive Debian's Chromium, the man page's groff; a developer's tools are asked for by name: setup.sh test tidy
for group in "$@"; do
  case "$group" in
    test) packages="$packages $browser groff-base libopenmpi-dev openmpi-bin iproute2 abigail-tools" ;;
    mpi) packages="$packages libopenmpi-dev openmpi-bin" ;;
    soak) packages="$packages python3-matplotlib" ;;
    coverage) packages="$packages gcovr" ;;
    docs) packages="$packages doxygen python3-sphinx python3-myst-parser python3-sphinx-rtd-theme" ;;
    tidy) packages="$packages clang-format clang-tidy" ;;
    fuzz) packages="$packages clang-$clang libclang-rt-$clang-dev" ;;
    packages) packages="$packages dpkg-dev file lintian" ;;
    classic | roots) packages="$packages debootstrap" ;;
    *) echo "setup.sh: unknown group '$group' (allowed: test, mpi, soak, coverage, docs, tidy, fuzz, classic, packages, roots)" >&2; exit 2 ;;
  esac
done
missing=""
for p in $packages; do
  dpkg-query -W -f='${Status}' "$p" 2>/dev/null | grep -q 'install ok installed' || missing="$missing $p"
done
# Node.js and npm: whatever is on the PATH serves; Debian's npm conflicts with other sources' Node.js. A source archive has its pages.
if [ -e "$(dirname "$0")/../web/prebuilt/replay.html" ]; then :
elif ! command -v npm >/dev/null 2>&1 || ! command -v node >/dev/null 2>&1; then missing="$missing nodejs npm"; fi

[ -n "$missing" ] || exit 0

for tool in dpkg-query apt-get; do
  command -v "$tool" >/dev/null 2>&1 ||
    { echo "setup.sh: there is no $tool here, so nothing can be installed; what Debian calls:$missing" >&2; exit 1; }
done
sudo=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null 2>&1 || { echo "setup.sh: needs root or sudo to install:$missing" >&2; exit 1; }
  sudo="sudo"
fi
[ "$tried" = yes ] || echo "setup.sh: the list of packages was never tried on this system (${codename:-unknown}; tried: bookworm, trixie, noble)" >&2
echo "setup: installing$missing"
export DEBIAN_FRONTEND=noninteractive
failed() {
  unknown=""
  if [ "$1" = install ]; then
    # shellcheck disable=SC2086 # the list is words on purpose
    known=" $(apt-cache show $missing 2>/dev/null | sed -n 's/^Package: //p' | tr '\n' ' ')"
    for p in $missing; do case $known in *" $p "*) ;; *) unknown="$unknown $p" ;; esac; done
  fi
  if [ -n "$unknown" ] && [ "$unknown" != "$missing" ]; then
    echo "setup.sh: apt knows no package of these names:$unknown: this system's sources lack them (Ubuntu: universe is needed), so nothing was installed of:$missing" >&2
    exit 1
  fi
  echo "setup.sh: apt-get $1 failed: without a network, or another source of packages, these can't be installed:$missing" >&2
  exit 1
}
$sudo apt-get update -qq || failed update
# shellcheck disable=SC2086 # the list is words on purpose
$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null || failed install
