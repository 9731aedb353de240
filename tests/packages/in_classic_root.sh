#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# What gazebo_classic.sh does within its root, where the source tree is /vsasim and /packages has vsasim-data.
set -eu
fail() { echo "package of Gazebo Classic: $*" >&2; exit 1; }
quiet() { "$@" >/tmp/log 2>&1 || { tail -n 30 /tmp/log >&2; fail "failed: $*"; }; }
start=$(date +%s)
say() { echo "package of Gazebo Classic: $* after $(($(date +%s) - start)) s"; }
listing() { find /usr /etc /var/lib/dpkg/info -xdev ! -name '__pycache__' ! -path '*/__pycache__/*' | sort; }

quiet apt-get update -q
quiet apt-get install -y -q --no-install-recommends dpkg-dev file
quiet cmake -S /vsasim -B /vsasim/build/classic_package -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DVSA_PACKAGES=ON \
  -DVSA_SIMULATOR=OFF -DVSA_TESTS=OFF -DVSA_BENCH=OFF -DVSA_GAZEBO_CLASSIC=ON -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -Wno-dev
quiet cmake --build /vsasim/build/classic_package
say "built"
umask 022
rm -rf /vsasim/build/classic_package/packages
(cd /vsasim/build/classic_package && quiet cpack -G DEB)
cp /vsasim/build/classic_package/packages/*.deb /packages
say "packed"

# What is needed besides is there, so that the lists before and after are of these packages alone.
listing >/tmp/before
quiet dpkg -i /packages/vsasim-data_*.deb /packages/vsasim-doctor_*.deb /packages/gazebo11-plugin-vsasim_*.deb
plugin=$(dpkg -L gazebo11-plugin-vsasim | grep 'libvsa-robot\.so$') || fail "the package has no plug-in"
ldd "$plugin" | grep 'not found' && fail "a library is missing"
readelf -d "$plugin" | grep -qE 'RPATH|RUNPATH|/vsasim' && fail "the plug-in names folders of the build"
dpkg-deb -f /packages/gazebo11-plugin-vsasim_*.deb Depends | grep -q 'libgazebo11' || fail "the package doesn't say that it needs Gazebo 11"

# As the how-to has it. Nothing is found in the source tree: it stands nowhere that Gazebo looks.
cd /tmp
. /usr/share/vsa/setup.sh
# No models from elsewhere, no other machine; a bare root has no name for itself.
export GAZEBO_MODEL_DATABASE_URI="" GAZEBO_IP=127.0.0.1 IGN_IP=127.0.0.1 GAZEBO_MASTER_URI=http://127.0.0.1:11345
gzserver --verbose /usr/share/vsa/models/worlds/bench_load.sdf >/tmp/gzserver.log 2>&1 &
server=$!
reading() {  # NAME: of the last message of the robot's readings
  timeout 20 gz topic -e /model/qbmove_bench_load/vsa/readings -d 3 2>/dev/null |
    awk -v name="\"$1\"" '$1 == "name:" { mine = $2 == name } mine && $1 == "double_value:" { v = $2 } END { print v }'
}
trap 'kill $server 2>/dev/null' EXIT
# until_stiffness CONDITION: reads it until awk says that it is so, a minute at most.
until_stiffness() {
  tries=0
  until stiffness=$(reading shaft/stiffness) && awk -v s="$stiffness" -v soft="${soft:-0}" "BEGIN { exit !($1) }"; do
    tries=$((tries + 1))
    [ $tries -lt 10 ] || { tail -n 20 /tmp/gzserver.log >&2; fail "stiffness '$stiffness', which isn't $1"; }
  done
}
until_stiffness 's > 0'
soft=$stiffness
gz topic -p /model/qbmove_bench_load/joint/shaft/cmd_equilibrium -m 'type: DOUBLE double_value: 0.5'
gz topic -p /model/qbmove_bench_load/joint/shaft/cmd_preset -m 'type: DOUBLE double_value: 0.5'
until_stiffness 's > 2 * soft'
kill $server
wait $server || true
trap - EXIT
# A bare root has neither sound nor display.
if grep 'Err' /tmp/gzserver.log | grep -vE 'OpenAL|open display'; then fail "Gazebo tells of errors"; fi
say "used (stiffness $soft, with preset 0.5 rad $stiffness N·m/rad)"

quiet dpkg -P gazebo11-plugin-vsasim vsasim-doctor vsasim-data
listing >/tmp/after
diff /tmp/before /tmp/after || fail "files stay"
say "purged"
