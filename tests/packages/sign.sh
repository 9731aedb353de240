#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# sign.sh ROOT: what scripts/sign.sh signs is verified, and what was changed afterwards isn't; files that the sums don't tell of or that
# differ aren't signed. With a key made for the test. 77: no GnuPG here.
set -eu
for tool in gpg gpg-agent; do
  command -v "$tool" >/dev/null || { echo "signing left out: $tool isn't installed (Debian: gnupg)"; exit 77; }
done
root=$1
work=$(mktemp -d)
# The agent that gpg starts is of this folder alone, and ends with it.
trap 'GNUPGHOME="$work/keys" gpgconf --kill all 2>/dev/null || true; rm -rf "$work"' EXIT
fail() { echo "sign.sh: $*" >&2; exit 1; }
export GNUPGHOME="$work/keys"
mkdir -m 700 "$work/keys"
mkdir "$work/out"
gpg --batch --quiet --pinentry-mode loopback --passphrase '' --quick-generate-key 'A test <test@localhost>' ed25519 sign 1d 2>"$work/log" ||
  { cat "$work/log"; fail "no key"; }
cd "$work/out"
echo one >one.deb
sha256sum -- *.deb >SHA256SUMS
sh "$root/scripts/sign.sh" "$work/out" test@localhost 2>"$work/log" || { cat "$work/log"; fail "not signed"; }
gpg --quiet --verify SHA256SUMS.asc SHA256SUMS 2>/dev/null || fail "not verified"
echo more >>SHA256SUMS
if gpg --quiet --verify SHA256SUMS.asc SHA256SUMS 2>/dev/null; then fail "changed sums are verified"; fi
if sh "$root/scripts/sign.sh" "$work/out" test@localhost >/dev/null 2>&1; then fail "signed a line that is no sum"; fi
sha256sum -- *.deb >SHA256SUMS
if sh "$root/scripts/sign.sh" "$work/out" nobody@localhost 2>/dev/null; then fail "signed without a key"; fi
gpg --quiet --verify SHA256SUMS.asc SHA256SUMS 2>/dev/null || fail "a signature is gone before there is another"
test "$(ls)" = "$(printf '%s\n' SHA256SUMS SHA256SUMS.asc one.deb | sort)" || fail "something is left: $(ls)"
echo two >two.deb
if sh "$root/scripts/sign.sh" "$work/out" test@localhost 2>/dev/null; then fail "signed beside a file that nobody summed"; fi
rm two.deb
echo other >one.deb
if sh "$root/scripts/sign.sh" "$work/out" test@localhost >/dev/null 2>&1; then fail "signed a wrong sum"; fi
echo "signed, verified, and refused where it should be"
