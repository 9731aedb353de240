#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# A private Debian 11 with Gazebo Classic 11, for machines whose own distribution has none.
#
#   debian11_root.sh prepare            make it once (about 0.5 GB to download, 3 GB on disk), keep it
#   debian11_root.sh run COMMAND…       run a command in it; this source tree is /vsasim there
#   debian11_root.sh path               where it is
#
# It lies under ${XDG_CACHE_HOME:-~/.cache}/vsasim. What is mounted is mounted in a namespace of its own and is gone with the command.
# Mirror, proxy and certificates are those of this machine's apt. Exit code 3: not to be had here, with one line that says why.
set -eu

source_tree=$(cd "$(dirname "$0")/.." && pwd)
root="${XDG_CACHE_HOME:-$HOME/.cache}/vsasim/debian11"
packages="g++ ccache cmake ninja-build pkg-config libtinyxml2-dev libfmt-dev nlohmann-json3-dev libgtest-dev
  gazebo libgazebo-dev libignition-transport-dev libignition-msgs-dev"

left_out() { echo "Classic left out: $1"; exit 3; }

# Every repository that this machine's apt knows; the first that has Debian 11 is our mirror.
find_mirror() {
  for uri in $(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | sort -u); do
    if /usr/lib/apt/apt-helper -qq download-file "${uri}dists/bullseye/InRelease" "$1/InRelease" >/dev/null 2>&1; then
      rm -f "$1/InRelease"
      echo "$uri"
      return 0
    fi
  done
  return 1
}

use_apt_proxy() {
  eval "$(apt-config shell proxy Acquire::http::Proxy https_proxy_of_apt Acquire::https::Proxy)"
  if [ -n "${proxy:-}" ] && [ "$proxy" != DIRECT ]; then export http_proxy="$proxy"; fi
  if [ -n "${https_proxy_of_apt:-}" ] && [ "$https_proxy_of_apt" != DIRECT ]; then export https_proxy="$https_proxy_of_apt"; fi
}

prepare() {
  want="$packages $(dpkg-query -W -f='${Version}' libtomlplusplus-dev 2>/dev/null || echo none)"
  if [ -f "$root/.vsasim" ] && [ "$(cat "$root/.vsasim")" = "$want" ]; then return 0; fi
  [ "$(id -u)" -eq 0 ] || left_out "a private Debian 11 root needs to be made by root (run it with sudo -E)"
  command -v debootstrap >/dev/null 2>&1 || left_out "debootstrap is not installed"
  [ -d /usr/include/toml++ ] || left_out "libtomlplusplus-dev is not installed"
  rm -rf "$root" "$root.part"
  mkdir -p "$root.part"
  use_apt_proxy
  mirror=$(find_mirror "$root.part") || left_out "no package source of this machine has Debian 11"
  echo "classic: making a Debian 11 root with Gazebo 11 in $root (once)"
  keyring=/usr/share/keyrings/debian-archive-keyring.gpg
  if ! unshare --mount debootstrap --variant=minbase --include=ca-certificates --keyring="$keyring" \
       bullseye "$root.part" "$mirror" >"$root.log" 2>&1; then
    tail -n 5 "$root.log" >&2
    left_out "debootstrap failed, see $root.log"
  fi
  apt-config dump | grep -E '^Acquire::' | grep -v '^Acquire::IndexTargets' >"$root.part/etc/apt/apt.conf.d/90machine" || true
  cp /etc/ssl/certs/ca-certificates.crt "$root.part/etc/ssl/certs/ca-certificates.crt" 2>/dev/null || true
  cp /etc/resolv.conf "$root.part/etc/resolv.conf" 2>/dev/null || true
  echo force-unsafe-io >"$root.part/etc/dpkg/dpkg.cfg.d/vsasim"
  # shellcheck disable=SC2086 # the list is words on purpose
  if ! enter "$root.part" sh -c 'apt-get update -qq && apt-get install -y -qq --no-install-recommends "$@" && apt-get clean' \
       sh $packages >>"$root.log" 2>&1; then
    tail -n 5 "$root.log" >&2
    left_out "its packages could not be installed, see $root.log"
  fi
  cp -r /usr/include/toml++ "$root.part/usr/include/"
  echo "$want" >"$root.part/.vsasim"
  mv "$root.part" "$root"
}

# enter ROOT COMMAND…
enter() {
  in=$1
  shift
  unshare --mount --propagation private sh -c '
    root=$1; tree=$2; shift 2
    mkdir -p "$root/vsasim"
    mount --bind "$tree" "$root/vsasim"
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount -t tmpfs tmpfs "$root/run"
    exec chroot "$root" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@"
  ' sh "$in" "$source_tree" env -C /vsasim "$@"
}

case "${1:-}" in
  prepare) prepare ;;
  path) echo "$root" ;;
  run)
    shift
    [ -f "$root/.vsasim" ] || { echo "debian11_root.sh: not prepared" >&2; exit 1; }
    enter "$root" "$@"
    ;;
  *) echo "usage: debian11_root.sh prepare | run COMMAND… | path" >&2; exit 2 ;;
esac
