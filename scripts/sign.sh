#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# sign.sh FOLDER [KEY]: signs FOLDER/SHA256SUMS with a key of yours (GnuPG's default one unless named) as SHA256SUMS.asc, after the sums
# were found true; checks the signature. Who downloads checks both: gpg --verify SHA256SUMS.asc && sha256sum --strict -c SHA256SUMS
set -eu
folder=${1:?usage: sign.sh FOLDER [KEY]}
key=${2:-}
command -v gpg >/dev/null || { echo "sign.sh: gpg is missing (Debian: gnupg)" >&2; exit 1; }
cd "$folder"
[ -f SHA256SUMS ] || { echo "sign.sh: no SHA256SUMS in $folder: make packages or make dist writes it" >&2; exit 1; }
sha256sum --quiet --strict -c SHA256SUMS
for file in *.deb *.tar.xz *.spdx.json; do
  [ ! -e "$file" ] || grep -q "  $file\$" SHA256SUMS || { echo "sign.sh: SHA256SUMS doesn't tell of $file" >&2; exit 1; }
done
# A signature that is there stays until there is a better one.
trap 'rm -f SHA256SUMS.asc.new' EXIT
gpg --batch --yes ${key:+--local-user "$key"} --armor --detach-sign --output SHA256SUMS.asc.new SHA256SUMS
gpg --verify SHA256SUMS.asc.new SHA256SUMS
mv SHA256SUMS.asc.new SHA256SUMS.asc
