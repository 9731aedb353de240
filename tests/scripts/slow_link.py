#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""slow_link.py PID_A PID_B SECONDS: a link "slow0" between the network namespaces of two processes that keeps every packet for so long.

Prints "ready" once both ends are there; runs until it is killed. Ends with 77 where the kernel has no tunnels.
"""
import collections
import ctypes
import fcntl
import os
import select
import struct
import sys
import time

TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
CLONE_NEWNET = 0x40000000


def end_in(pid):
    libc = ctypes.CDLL(None, use_errno=True)
    with open(f"/proc/{pid}/ns/net", "rb") as namespace:
        if libc.setns(namespace.fileno(), CLONE_NEWNET) != 0:
            raise OSError(ctypes.get_errno(), "setns")
    end = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(end, TUNSETIFF, struct.pack("16sH22x", b"slow0", IFF_TUN | IFF_NO_PI))
    return end


def main():
    delay_s = float(sys.argv[3])
    try:
        ends = [end_in(pid) for pid in sys.argv[1:3]]
    except OSError as error:
        print(error, file=sys.stderr)
        sys.exit(77)
    print("ready", flush=True)
    under_way = collections.deque()  # (due, to, packet): all wait equally long
    while True:
        wait = max(0.0, under_way[0][0] - time.monotonic()) if under_way else None
        for end in select.select(ends, [], [], wait)[0]:
            try:
                packet = os.read(end, 65536)
            except OSError:  # the other side isn't up yet
                continue
            under_way.append((time.monotonic() + delay_s, ends[1 - ends.index(end)], packet))
        while under_way and under_way[0][0] <= time.monotonic():
            _, to, packet = under_way.popleft()
            try:
                os.write(to, packet)
            except OSError:
                pass  # as a wire loses it


if __name__ == "__main__":
    main()
