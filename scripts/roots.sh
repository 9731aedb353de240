# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# For scripts that make roots of other systems with debootstrap; sourced. Mirror, proxy and certificates are those of this machine's
# apt. What is mounted is mounted in a namespace of its own and is gone with the command.
roots_folder="${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/vsasim" # HOME: none by cron and in some containers

# find_mirror SUITE: the first of the repositories that this machine's apt knows that has the suite.
find_mirror() {
  probe=$(mktemp -d)
  for uri in $(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | sort -u); do
    if /usr/lib/apt/apt-helper -qq download-file "${uri}dists/$1/InRelease" "$probe/InRelease" >/dev/null 2>&1; then
      rm -rf "$probe"
      echo "$uri"
      return 0
    fi
  done
  rm -rf "$probe"
  return 1
}

use_apt_proxy() {
  eval "$(apt-config shell proxy Acquire::http::Proxy https_proxy_of_apt Acquire::https::Proxy)"
  if [ -n "${proxy:-}" ] && [ "$proxy" != DIRECT ]; then export http_proxy="$proxy"; fi
  if [ -n "${https_proxy_of_apt:-}" ] && [ "$https_proxy_of_apt" != DIRECT ]; then export https_proxy="$https_proxy_of_apt"; fi
}

# bootstrap SUITE ROOT: a bare system with this machine's way to packages; its log is ROOT.log.
bootstrap() {
  keyring=/usr/share/keyrings/debian-archive-keyring.gpg
  mirror=$(find_mirror "$1") || { echo "no package source of this machine has $1"; return 3; }
  mkdir -p "$2"
  if ! unshare --mount debootstrap --variant=minbase --include=ca-certificates --keyring="$keyring" "$1" "$2" "$mirror" >"$2.log" 2>&1; then
    tail -n 5 "$2.log" >&2
    echo "debootstrap failed, see $2.log"
    return 3
  fi
  apt-config dump | grep -E '^Acquire::' | grep -v '^Acquire::IndexTargets' >"$2/etc/apt/apt.conf.d/90machine" || true
  cp /etc/ssl/certs/ca-certificates.crt "$2/etc/ssl/certs/ca-certificates.crt" 2>/dev/null || true
  cp /etc/resolv.conf "$2/etc/resolv.conf" 2>/dev/null || true
  echo force-unsafe-io >"$2/etc/dpkg/dpkg.cfg.d/vsasim"
}

# enter ROOT TREE MOUNTPOINT COMMAND…: in the root, where TREE is MOUNTPOINT.
enter() {
  # shellcheck disable=SC2016 # expanded by the inner shell
  unshare --mount --propagation private sh -c '
    root=$1; tree=$2; at=$3; shift 3
    mkdir -p "$root$at"
    mount --bind "$tree" "$root$at"
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount -t tmpfs tmpfs "$root/run"
    exec chroot "$root" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@"
  ' sh "$@"
}
