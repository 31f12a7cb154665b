#!/usr/bin/env python3
"""bad_link.py PID CONTROL: a cable between two hosts that are network namespaces, ours with the
interface robot0 (10.77.0.1) and that of process PID with base0 (10.77.0.2), for hosts whose kernel
has no netem. The file CONTROL holds how bad it is and may be replaced at any time: "DELAY_MS LOSS",
each way, LOSS being a share of the packets, or "down". Prints "up" once both ends are there; ends
with 77 where tunnels or namespaces are not permitted. Same losses each time."""
import ctypes
import fcntl
import heapq
import os
import random
import select
import struct
import subprocess
import sys
import time

TUNSETIFF = 0x400454CA
IFF_TAP_NO_PI = 0x0002 | 0x1000
CLONE_NEWNET = 0x40000000
CONTROL_PERIOD_S = 0.02


def open_end(name, address):
    """An end of the cable in the present namespace, as a file descriptor of its packets."""
    end = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(end, TUNSETIFF, struct.pack("16sH22x", name.encode(), IFF_TAP_NO_PI))
    for command in (["addr", "add", address + "/24", "dev", name], ["link", "set", name, "up"],
                    ["link", "set", "lo", "up"]):
        subprocess.run(["ip"] + command, check=True)
    return end


def enter_network_of(pid):
    libc = ctypes.CDLL(None, use_errno=True)
    namespace = os.open(f"/proc/{pid}/ns/net", os.O_RDONLY)
    if libc.setns(namespace, CLONE_NEWNET) != 0:
        raise OSError(ctypes.get_errno(), "setns")
    os.close(namespace)


class Control:
    """What the file says, looked at every CONTROL_PERIOD_S."""

    def __init__(self, path):
        self.path = path
        self.next_look = 0.0
        self.is_up, self.delay_s, self.loss = True, 0.0, 0.0

    def look(self, now):
        if now < self.next_look:
            return
        self.next_look = now + CONTROL_PERIOD_S
        with open(self.path) as file:
            words = file.read().split()
        self.is_up = words != ["down"]
        if self.is_up:
            self.delay_s, self.loss = float(words[0]) / 1000.0, float(words[1])


def forward(ends, control):
    """Hands packets from each end to the other, late or not at all."""
    other = {ends[0]: ends[1], ends[1]: ends[0]}
    chance = random.Random(1)
    waiting, count = [], 0
    while True:
        now = time.monotonic()
        control.look(now)
        while waiting and waiting[0][0] <= now:
            _, _, end, packet = heapq.heappop(waiting)
            try:
                os.write(end, packet)
            except OSError:  # that interface is down: lost, as on any cable
                pass
        due = waiting[0][0] - now if waiting else CONTROL_PERIOD_S
        for end in select.select(ends, [], [], min(max(due, 0.0), CONTROL_PERIOD_S))[0]:
            try:
                packet = os.read(end, 65536)
            except OSError:
                continue
            if control.is_up and chance.random() >= control.loss:
                count += 1
                heapq.heappush(waiting, (time.monotonic() + control.delay_s, count, other[end],
                                         packet))


def main():
    pid, control = sys.argv[1], Control(sys.argv[2])
    try:
        ends = [open_end("robot0", "10.77.0.1")]
        enter_network_of(pid)
        ends.append(open_end("base0", "10.77.0.2"))
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"no link between two network namespaces can be made here: {error}", flush=True)
        sys.exit(77)
    print("up", flush=True)
    forward(ends, control)


if __name__ == "__main__":
    main()
