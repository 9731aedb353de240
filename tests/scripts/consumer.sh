#!/bin/sh
# An outside project that consumes the installed package: installs this build, builds examples/library against it, runs both programs.
set -eu
source=$1 build=$2
work=$build/consumer
rm -rf "$work"
cmake --install "$build" --prefix "$work/prefix" > /dev/null
cmake -Wno-dev -S "$source/examples/library" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null
cmake --build "$work/build"
cmake -Wno-dev -S "$source/examples/snake_gait_topics" -B "$work/topics" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null
cmake --build "$work/topics"
cmake -Wno-dev -S "$source/examples/serial_client" -B "$work/serial" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null
cmake --build "$work/serial"
"$work/build/one_actuator"
VSA_DATA_DIR="$work/prefix/share/vsa" "$work/build/move_a_joint" | tee "$work/output"
grep -qE '^shaft (0.9|1.0)' "$work/output"
grep -q '^back at 0.000 s' "$work/output"

# The serial client against units on a virtual port of the installed command, which is ready when it has said how to end it.
mkfifo "$work/emulated"
VSA_DATA_DIR="$work/prefix/share/vsa" "$work/prefix/bin/vsa" emulate qbmove_maker_pro --port "$work/port" > "$work/emulated" &
emulate=$!
trap 'kill $emulate 2> /dev/null || true' EXIT
exec 3< "$work/emulated"
while read -r line <&3; do case $line in *Ctrl-C*) break ;; esac; done
"$work/serial/serial_client" "$work/port" | tee "$work/moved"
grep -qE '^asked for 10°: the shaft is at (7|8|9|10|11|12)' "$work/moved"
kill $emulate
wait $emulate
test ! -e "$work/port"
