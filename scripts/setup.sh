#!/bin/sh
# Installs what building, testing and running vsasim needs on Debian 12 and 13; its lists for Ubuntu 22.04 and 24.04, which don't
# package MuJoCo, were never tried.
# Idempotent: when every package is present it touches neither the network nor the package manager.
set -eu

codename=$([ ! -r /etc/os-release ] || { . /etc/os-release && echo "${VERSION_CODENAME:-}"; })

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
# What SDF and topics need, where the system packages it; MuJoCo, where it does. docs/reference/systems.md
case "$codename" in
  bookworm)
    packages="$packages libmujoco-dev libsdformat-dev libassimp-dev libbullet-extras-dev libignition-transport-dev libignition-msgs-dev ignition-transport-cli"
    ;;
  trixie)
    packages="$packages libmujoco-dev"
    clang=19
    ;;
  # Never tried. Without MuJoCo, which Ubuntu doesn't package: a release of it belongs where CMake looks. Gazebo's archive has SDF and topics.
  jammy) packages="$packages libassimp-dev libbullet-extras-dev" browser="" tried=no ;;
  noble) packages="$packages libassimp-dev libbullet-extras-dev" browser="" clang=18 tried=no ;;
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
[ "$tried" = yes ] || echo "setup.sh: the list of packages was never tried on this system (${codename:-unknown}; tried: bookworm, trixie)" >&2
echo "setup: installing$missing"
export DEBIAN_FRONTEND=noninteractive
failed() {
  echo "setup.sh: apt-get $1 failed: without a network, or another source of packages, these can't be installed:$missing" >&2
  exit 1
}
$sudo apt-get update -qq || failed update
# shellcheck disable=SC2086 # the list is words on purpose
$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null || failed install
