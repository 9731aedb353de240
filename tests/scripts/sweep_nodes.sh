#!/bin/sh
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# sweep_nodes.sh BIN: a sweep of 1,000 points on two nodes that have nothing in common but the disk: network namespaces with hostnames
# of their own and TCP between them. Its table must be that of this machine's threads, byte for byte; then once more over a slow link
# (50 ms each way), and with a rank killed half-way and --resume.
# Ends with 77 (left out) where it isn't root, namespaces can't be made, or there is no Open MPI 4.
set -eu
export ASAN_OPTIONS="${ASAN_OPTIONS:-}"
bin=$1
left_out() { echo "left out: $1"; exit 77; }
[ -x "$bin/vsa-mpi" ] || left_out "this build has no vsa-mpi"
[ "$(id -u)" -eq 0 ] || left_out "namespaces need root"
for tool in mpirun ip unshare nsenter; do command -v $tool > /dev/null || left_out "no $tool"; done
# Open MPI 5's launcher has other words for agents and interfaces.
mpirun --version 2> /dev/null | grep -q 'Open MPI) 4' || left_out "mpirun isn't Open MPI 4's"

work=$(mktemp -d)
nodes=""
end() { for pid in $nodes; do kill -9 "$pid" 2> /dev/null || true; done; rm -rf "$work"; }
trap end EXIT

node() {  # NAME: sleeps in namespaces of its own; sets $pid
  unshare --net --uts sh -c "hostname $1 2> /dev/null; exec sleep 3600" &
  pid=$!
  nodes="$nodes $pid"
  for _ in 1 2 3 4 5 6 7 8 9 10; do
    own=$(readlink "/proc/$pid/ns/net" 2> /dev/null) || left_out "no namespaces here"
    [ "$own" != "$(readlink /proc/self/ns/net)" ] && return 0
    sleep 0.1
  done
  left_out "no network namespaces here"
}
node vsa-node-a; a=$pid
node vsa-node-b; b=$pid
in_node() { target=$1; shift; nsenter -t "$target" -n -u "$@"; }
ip link add "vsa$$a" type veth peer name "vsa$$b" 2> /dev/null || left_out "no virtual links here"
ip link set "vsa$$a" netns "$a"
ip link set "vsa$$b" netns "$b"
in_node "$a" sh -c "ip link set lo up; ip addr add 10.213.7.1/24 dev vsa$$a; ip link set vsa$$a up"
in_node "$b" sh -c "ip link set lo up; ip addr add 10.213.7.2/24 dev vsa$$b; ip link set vsa$$b up"

# What ssh is to a cluster: AGENT HOST COMMAND…
cat > "$work/agent" << AGENT
#!/bin/sh
case "\$1" in *.1) node=$a ;; *) node=$b ;; esac
shift
exec nsenter -t \$node -n -u sh -c "\$*"
AGENT
chmod +x "$work/agent"

cat > "$work/plan.toml" << PLAN
samples = 1000
[scenario]
world = "bench_pole"
duration_s = 0.2
[[command]]
time_s = 0.0
actuator = "shaft"
equilibrium_rad = 0.3
[[vary]]
key = "drive.friction_Nm"
random = [0.2, 0.8]
[[vary]]
key = "link.mass_kg"
of = "qbmove_bench_pole::pole"
random = [0.1, 0.5]
[[measure]]
name = "supply_J"
signal = "supply_J"
PLAN

net=10.213.7
job() {  # ARGUMENTS…
  in_node "$a" env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --host $net.1:1,$net.2:1 \
    --mca plm_rsh_agent "$work/agent" --mca btl tcp,self --mca oob_tcp_if_include $net.0/24 \
    --mca btl_tcp_if_include $net.0/24 -x ASAN_OPTIONS "$bin/vsa-mpi" sweep "$work/plan.toml" "$@"
}
same() {  # FOLDER
  for table in results.csv results.h5; do
    [ ! -e "$work/threads/$table" ] || cmp "$work/threads/$table" "$work/$1/$table" || { echo "$1/$table differs"; exit 1; }
  done
  echo "$1: the same bytes"
}

"$bin/vsa" sweep "$work/plan.toml" --out "$work/threads" > /dev/null
job --out "$work/nodes" > /dev/null
hosts=$(ls "$work/nodes/log" | sed 's/-[0-9]*-[0-9]*$//' | sort -u | wc -l)
[ "$hosts" -eq 2 ] || { echo "the logs are of $hosts hosts, not of 2"; exit 1; }
same nodes

# The same over a link that keeps each packet for 50 ms.
python3 "$(dirname "$0")/slow_link.py" "$a" "$b" 0.05 > "$work/slow.txt" &
nodes="$nodes $!"
for _ in 1 2 3 4 5 6 7 8 9 10; do grep -qs ready "$work/slow.txt" && break; sleep 0.2; done
if grep -qs ready "$work/slow.txt"; then
  in_node "$a" sh -c "ip addr add 10.213.8.1 peer 10.213.8.2 dev slow0; ip link set slow0 up"
  in_node "$b" sh -c "ip addr add 10.213.8.2 peer 10.213.8.1 dev slow0; ip link set slow0 up"
  net=10.213.8
  job --out "$work/slow" > /dev/null
  same slow
  net=10.213.7
else
  echo "slow link left out: this kernel has no tunnels"
fi

# Whoever is quicker than its end is tried again.
for try in 1 2 3 4 5; do
  died=died_$try
  job --out "$work/$died" > /dev/null 2>&1 &
  running=$!
  while [ "$(cat "$work/$died"/log/vsa-node-b-* 2> /dev/null | wc -l)" -lt 20 ] && kill -0 $running 2> /dev/null; do sleep 0.05; done
  kill -9 "$(ls "$work/$died/log" | sed -n 's/vsa-node-b-\([0-9]*\)-.*/\1/p')" 2> /dev/null || true
  if ! wait $running; then
    job --out "$work/$died" --resume > /dev/null
    same "$died"
    exit 0
  fi
done
echo "five jobs ended well although a rank was killed"
exit 1
