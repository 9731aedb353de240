#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# What bare.sh does within its root: install, use, upgrade, purge. /first and /packages are two versions of the same packages.
set -eu
fail() { echo "packages: $*" >&2; exit 1; }
quiet() { "$@" >/tmp/log 2>&1 || { tail -n 30 /tmp/log >&2; fail "failed: $*"; }; }
install() { quiet apt-get install -y -q "$@"; }
seconds() { date +%s.%N; }
since() { awk -v a="$1" -v b="$(seconds)" 'BEGIN { printf "%.0f", b - a }'; }
# Every file and folder of the system but what apt and dpkg keep of their own work, and what runs leave.
listing() { find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /run -o -path /tests -o -path /tmp -o -path /root \
  -o -path /home -o -path /first -o -path /packages -o -path /var/cache -o -path /var/lib/apt -o -path /var/lib/dpkg \
  -o -path /var/log \) -prune -o -print | sort; }

start=$(seconds)
quiet apt-get update -q
echo "apt update: $(since "$start") s"
listing >/tmp/before

# From nothing to a moving robot: the command and what it needs.
start=$(seconds)
install /first/vsasim_*.deb /first/vsasim-data_*.deb /first/vsasim-doctor_*.deb
installed=$(since "$start")
mkdir -p /root/work && cd /root/work
vsa run snake_rubble --gait climb --duration-s 20 --record out --no-topics >run.log 2>&1 || { cat run.log; fail "vsa run"; }
moving=$(since "$start")
test -s out/replay.html || fail "the run left no page"
grep -q WebGLRenderer out/replay.html || fail "the page has no 3-D view"
awk -F, 'NR == 2 { x = $3; y = $4 } { u = $3; v = $4 } END { exit !((u - x) ^ 2 + (v - y) ^ 2 > 0.01) }' out/links.csv || fail "the snake stayed where it was"
echo "apt install to a crawled snake and its page: $moving s (packages $installed s, 20 s of the snake $((moving - installed)) s)"
[ "$moving" -lt 60 ] || fail "a moving robot takes $moving s, a minute at most"
vsa actuators of_the_first_version >/dev/null 2>&1 && fail "a file without a type is a type"
test -e /usr/share/vsa/actuators/of_the_first_version.toml || fail "the first version lacks its file"

# The others. The manual's examples are what a user compiles.
start=$(seconds)
install /first/*.deb
echo "all packages: $(since "$start") s more"
python3 - <<'PY' || fail "the Python module"
import vsasim
world = vsasim.World.load("bench_free")
world.command(world.actuators[0], 1.0, 0.3)
world.run(2.0)
shaft_rad = world.read()["shaft_rad"][0]
assert 0.8 < shaft_rad < 1.2, shaft_rad
PY
man_page=$(dpkg -L vsasim | grep 'man1/vsa.1.gz') && gzip -t "$man_page"
vsa export --fmu qbmove_maker_pro_6_1 --out unit.fmu >/dev/null && test -s unit.fmu
( . /usr/share/vsa/setup.sh; test "$VSA_DATA_DIR" = /usr/share/vsa )
vsa-doctor >doctor.log || test $? = 1
grep -q 'ok: data directory: /usr/share/vsa' doctor.log || { cat doctor.log; fail "vsa-doctor"; }
if command -v mpirun >/dev/null; then vsa-mpi --version >/dev/null; fi

start=$(seconds)
install g++ cmake make
echo "a compiler: $(since "$start") s"
start=$(seconds)
quiet cmake -S /usr/share/doc/vsasim-doc/examples/library -B /root/work/build -DCMAKE_BUILD_TYPE=Release
quiet cmake --build /root/work/build
/root/work/build/move_a_joint | grep -qE '^shaft (0.9|1.0)' || fail "a program of a user's own"
/root/work/build/one_actuator >/dev/null
quiet cmake -S /tests/shared -B /root/work/shared -DCMAKE_BUILD_TYPE=Release
quiet cmake --build /root/work/shared
/root/work/shared/move_a_joint | grep -qE '^shaft (0.9|1.0)' || fail "a program with the shared library"
echo "a C++ program with find_package(vsasim): $(since "$start") s"

# What is a user's: types, a world, recordings, settings, compiled programs. None is a package's to touch.
mkdir -p /root/types /usr/local/share/vsa/actuators /etc/vsa
printf '[type]\nname = "mine"\ntitle = "mine"\nbase = "sea_example"\n' >/root/types/mine.toml
cp /root/types/mine.toml /usr/local/share/vsa/actuators/
echo 'export VSA_ACTUATOR_PATH=/root/types' >/etc/vsa/mine.sh
cp /usr/share/vsa/models/worlds/bench_load.sdf /root/types/world.sdf
mine() { find /root/types /root/work /usr/local/share/vsa /etc/vsa -type f -exec sha256sum {} + | sort -k 2; }
mine >/tmp/mine

start=$(seconds)
install /packages/*.deb
echo "upgrade: $(since "$start") s"
mine | diff /tmp/mine - || fail "the upgrade changed what is a user's"
test ! -e /usr/share/vsa/actuators/of_the_first_version.toml || fail "the first version's file is still there"
for p in $(dpkg-query -W -f '${Package} ${Version}\n' '*vsasim*' | awk '$2 == "0.0.9-1" { print $1 }'); do fail "$p was not upgraded"; done
VSA_ACTUATOR_PATH=/root/types vsa actuators mine | grep -q mine || fail "a user's type isn't read any more"
for program in build shared; do
  /root/work/$program/move_a_joint >/dev/null || fail "a program that was compiled before the upgrade ($program)"
done
python3 -c 'import vsasim, importlib.metadata as m; assert m.version("vsasim") == vsasim.__version__' || fail "the Python module after the upgrade"
cmp -s /usr/share/vsa/LICENSE /usr/share/common-licenses/Apache-2.0 || grep -q Apache /usr/share/vsa/LICENSE

# As root, so that what a run would compile beside the module is there to be left over.
python3 -c 'import vsasim.envs, vsasim.learn'
quiet apt-get purge -y -q '*vsasim*'
dpkg-query -W -f '${Package} ${Status}\n' '*vsasim*' 2>/dev/null | grep -v 'not-installed$' && fail "dpkg still knows a package"
quiet apt-get autoremove --purge -y -q
mine | diff /tmp/mine - || fail "the purge changed what is a user's"
rm -rf /usr/local/share/vsa /etc/vsa
listing >/tmp/after
if left=$(comm -13 /tmp/before /tmp/after | grep -i 'vsa'); then echo "$left"; fail "the purge left something of ours"; fi
echo "purged: nothing of ours is left; $(comm -13 /tmp/before /tmp/after | wc -l) paths of other packages are"
comm -13 /tmp/before /tmp/after | head -n 5
