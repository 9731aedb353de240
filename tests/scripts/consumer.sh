#!/bin/sh
# An outside project that consumes the installed package: installs this build, builds examples/library against it, runs its programs.
set -eu
source=$1 build=$2
# check PATTERN FILE: some line of it is as the extended pattern says.
check() {
  grep -qE -e "$1" "$2" || { echo "consumer.sh: no line of $2 matches '$1':" >&2; cat "$2" >&2; exit 1; }
}
work=$build/consumer
rm -rf "$work"
cmake --install "$build" --prefix "$work/prefix" > /dev/null
test -s "$work/prefix/share/man/man1/vsa.1" || test -s "$work/prefix/share/man/man1/vsa.1.gz"  # compressed where packages are made
cmp "$source/apps/vsa/vsa.bash" "$work/prefix/share/bash-completion/completions/vsa"
cmake -S "$source/examples/library" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null 2> "$work/warnings"
if [ -s "$work/warnings" ]; then echo "consumer.sh: find_package(vsasim) warns a user of what isn't his:" >&2; cat "$work/warnings" >&2; exit 1; fi
cmake --build "$work/build"
# Components are rooms; one that there isn't is named, with those that there are.
mkdir "$work/components"
printf '%s\n' 'cmake_minimum_required(VERSION 3.18)' 'project(asks CXX)' 'find_package(vsasim REQUIRED COMPONENTS ${ROOMS})' > "$work/components/CMakeLists.txt"
cmake -S "$work/components" -B "$work/components/engine" -DCMAKE_PREFIX_PATH="$work/prefix" "-DROOMS=engine;record" > /dev/null 2>&1 ||
  { echo "consumer.sh: find_package(vsasim COMPONENTS engine record) fails" >&2; exit 1; }
if cmake -S "$work/components" -B "$work/components/none" -DCMAKE_PREFIX_PATH="$work/prefix" "-DROOMS=engine;nonsense" > /dev/null 2> "$work/components/said"; then
  echo "consumer.sh: a component that there isn't is found" >&2; exit 1
fi
tr -s '\n ' '  ' < "$work/components/said" | grep -q 'no component nonsense (allowed: actuator, .*engine' ||
  { echo "consumer.sh: of a component that there isn't CMake says:" >&2; cat "$work/components/said" >&2; exit 1; }
if [ "${VSA_TOPICS:-yes}" = yes ]; then
  cmake -Wno-dev -S "$source/examples/snake_gait_topics" -B "$work/topics" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null
  cmake --build "$work/topics"
else
  echo "left out: examples/snake_gait_topics: this build has no topics"
fi
cmake -Wno-dev -S "$source/examples/serial_client" -B "$work/serial" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null
cmake --build "$work/serial"
cmake -Wno-dev -S "$source/examples/host" -B "$work/host" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null
cmake --build "$work/host"
cmake -Wno-dev -S "$source/examples/law_module" -B "$work/law" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null
cmake --build "$work/law"
VSA_LAW_PATH="$work/law" VSA_ACTUATOR_PATH="$source/examples/law_module/types" "$work/prefix/bin/vsa" actuators cubic > "$work/cubic"
check 'elastic law: cubic' "$work/cubic"
"$work/build/one_actuator"
"$work/host/host" | tee "$work/swung"
check '^after 2 s at (0\.[789]|1\.0)' "$work/swung"
# It finds the data of the installation by itself, and no others: without them it says where it looked.
unset VSA_DATA_DIR
"$work/build/move_a_joint" | tee "$work/output"
mv "$work/prefix/share/vsa/models" "$work/models"
if "$work/build/move_a_joint" 2> "$work/error"; then echo "consumer.sh: a world from elsewhere was taken" >&2; exit 1; fi
mv "$work/models" "$work/prefix/share/vsa/models"
check '^shaft (0.9|1.0)' "$work/output"
check '^back at 0.000 s' "$work/output"
"$work/build/measure_an_actuator" > "$work/measured" 2> "$work/progress"
check '^preset 0.6 rad: [1-9]\.[0-9]+ rad/s' "$work/measured"
check '[ 0-9]+ % of 20 s' "$work/progress" # which first depends on how busy the machine is

# The serial client against units on a virtual port of the installed command, which is ready when it has said how to end it.
mkfifo "$work/emulated"
VSA_DATA_DIR="$work/prefix/share/vsa" "$work/prefix/bin/vsa" emulate qbmove_maker_pro_6_1 --port "$work/port" > "$work/emulated" &
emulate=$!
trap 'kill $emulate 2> /dev/null || true' EXIT
exec 3< "$work/emulated"
while read -r line <&3; do case $line in *Ctrl-C*) break ;; esac; done
"$work/serial/serial_client" "$work/port" | tee "$work/moved"
check '^asked for 10°: the shaft is at (7|8|9|10|11|12)\.[0-9]°$' "$work/moved"
kill $emulate
wait $emulate
test ! -e "$work/port"

# What setup.sh sets, in a shell where unset variables are errors; and again, which changes nothing.
prefix=$work/prefix
unset VSA_DATA_DIR GAZEBO_PLUGIN_PATH GAZEBO_MODEL_PATH IGN_GAZEBO_RESOURCE_PATH IGN_GAZEBO_SYSTEM_PLUGIN_PATH GZ_SIM_SYSTEM_PLUGIN_PATH
export GZ_SIM_RESOURCE_PATH=/somewhere/else
. "$prefix/share/vsa/setup.sh"
env | grep -v '^_=' | sort > "$work/once"
. "$prefix/share/vsa/setup.sh"
env | grep -v '^_=' | sort | diff "$work/once" -
test "$VSA_DATA_DIR" = "$prefix/share/vsa"
test "$GZ_SIM_RESOURCE_PATH" = "$prefix/share/vsa/models:/somewhere/else"
test "$(command -v vsa)" = "$prefix/bin/vsa"

# The hook of a colcon workspace says the same, relative to the prefix.
count=0
while IFS=';' read -r how variable path; do
  eval "value=\$$variable"
  case "$how $value" in
    "set $prefix/$path" | "prepend-non-duplicate $prefix/$path" | "prepend-non-duplicate $prefix/$path:"*) count=$((count + 1)) ;;
    *) echo "consumer.sh: vsa.dsv and setup.sh differ: $variable" >&2; exit 1 ;;
  esac
done < "$prefix/share/vsa/environment/vsa.dsv"
test "$count" = 8
test -r "$prefix/share/vsa/environment/vsa.sh"

# The installed command, by its name alone. What else is wrong on this machine is none of this test's business.
cd "$work"
vsa doctor bench_load > "$work/doctor" || test $? = 1
check "^ok: data directory: $prefix/share/vsa\$" "$work/doctor"
check "^ok: GZ_SIM_RESOURCE_PATH: has vsasim's models\$" "$work/doctor"
check "^ok: world: $prefix/share/vsa/models/worlds/bench_load.sdf loads" "$work/doctor"
vsa run bench_load --no-topics --duration-s 0.1
