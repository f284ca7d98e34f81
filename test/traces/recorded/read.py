#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""read.py TRACE: prints the records of a recorded trace, one a line.

Written from docs/formats/trace-format.md and the MCAP specification alone. Chunks are unpacked by the command zstd.
"""
import struct
import subprocess
import sys
import zlib

FATES = "waiting ttl duplicate off garbled collided busy arrived".split()


class Bytes:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, n):
        assert self.at + n <= len(self.data), "beyond the end"
        self.at += n
        return self.data[self.at - n:self.at]

    def fixed(self, letter):
        return struct.unpack("<" + letter, self.take(struct.calcsize("<" + letter)))[0]

    def text(self):
        return self.take(self.fixed("I")).decode()

    def v(self):
        value = shift = 0
        while True:
            byte = self.take(1)[0]
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def z(self):
        value = self.v()
        return value >> 1 if value % 2 == 0 else -(value + 1 >> 1)

    def b(self):
        return self.take(1)[0]

    def d(self):
        return repr(self.fixed("d")).removesuffix(".0")

    def d3(self):
        return " ".join([self.d(), self.d(), self.d()])

    def s(self):
        return self.take(self.v())

    def node(self):
        number = self.v()
        return number - 1 if number else "-"


def frame(m, uids):
    slot, sender, ttl, hops, next_hop, size = m.v(), m.v(), m.v(), m.v(), m.node(), m.v()
    return uids.get(slot, "-"), f"{sender} {ttl} {hops} {next_hop} {size}"


def air(m, uids):
    uid, rest = frame(m, uids)
    heard_from, kind, attempt, number, reserved = m.node(), m.b(), m.b(), m.v(), m.z()
    return f"{uid if kind == 0 else '-'} {rest} {heard_from} {kind} {attempt} {number} {reserved}"


def fate(byte):
    return FATES[byte // 2] + ("+" if byte % 2 else "")


def lines(number, time, m, uids):
    """The records of a message as lines."""
    if number == 1:
        slot, uid = m.v(), m.v()
        uids[slot] = uid
        m.take(len(m.data) - m.at)
    elif number == 2:
        node, slot, ttl, robots = m.v(), m.v(), m.v(), m.v()
        reachable, shortest = (count - 1 if count else "-" for count in (m.v(), m.v()))
        yield f"{time} Sent {node} {uids[slot]} {ttl} {robots} {reachable} {shortest}"
    elif number == 3:
        uid, rest = frame(m, uids)
        yield f"{time} Transmitted {uid} {rest} {m.node()}"
    elif number == 4:
        uid, rest = frame(m, uids)
        sender = int(rest.split()[0])
        reserved, header, n = m.z(), m.v(), m.v()
        times, nodes = [], []
        for _ in range(n):
            times.append((times[-1] if times else time) + m.z())
        for _ in range(n):
            nodes.append((nodes[-1] if nodes else sender) + m.z())
        for t, node in zip(times, nodes):
            yield f"{t} Received {uid} {rest} {reserved} {header} {node} {fate(m.b())}"
    elif number == 5:
        node = m.v()
        uid, rest = frame(m, uids)
        yield f"{time} Dropped {node} {uid} {rest} {m.b()} {m.b()}"
    elif number == 6:
        node, start, end, place = m.v(), time + m.z(), m.v(), m.d3()
        if end:
            end -= 1
            end = start + (end >> 1 if end % 2 == 0 else -(end + 1 >> 1))
        parts = m.b()
        velocity, to = (m.d3(), m.d3()) if parts & 1 else ("0 0 0", place)
        heading = m.d() if parts & 2 else "0"
        turning = m.d() if parts & 4 else "0"
        yield f"{time} Moved {node} {start} {end or '-'} {place} {velocity} {to} {heading} {turning}"
    elif number == 7:
        yield f"{time} Arrived {m.v()}"
    elif number == 8:
        yield f"{time} NoWay {m.v()} {m.d3()}"
    elif number == 9:
        yield f"{time} Switched {m.v()} {m.b()}"
    elif number in (10, 11):
        yield f"{time} {'LinkUp' if number == 10 else 'LinkDown'} {m.v()} {m.v()}"
    elif number == 12:
        yield f"{time} AirSent {air(m, uids)} {m.v()} {m.v()} {m.z()} {m.d()} {m.v()}"
    elif number == 13:
        yield f"{time} ControlReceived {air(m, uids)} {m.v()} {fate(m.b())} {m.v()}"
    elif number == 30:
        m.s(), m.s()  # protocol and bytes of a header
    elif number == 14:
        uid, rest = frame(m, uids)
        yield f"{time} Routed {uid} {rest} {m.node()}"
    assert m.at == len(m.data), "the message is longer than its record"


def records(data):
    """Opcode and content of each MCAP record."""
    at = 0
    while at < len(data):
        opcode, length = data[at], struct.unpack_from("<Q", data, at + 1)[0]
        yield opcode, data[at + 9:at + 9 + length]
        at += 9 + length


def main(path):
    with open(path, "rb") as file:
        data = file.read()
    magic = b"\x89MCAP0\r\n"
    assert data.startswith(magic) and data.endswith(magic), "this is no MCAP file"
    uids = {}
    for opcode, content in records(data[8:-8]):
        if opcode != 6:
            continue
        c = Bytes(content)
        c.take(16)
        size, crc, compression, packed = c.fixed("Q"), c.fixed("I"), c.text(), c.take(c.fixed("Q"))
        assert compression == "zstd"
        plain = subprocess.run(["zstd", "-dc"], input=packed, capture_output=True, check=True).stdout
        assert len(plain) == size and zlib.crc32(plain) == crc, "the chunk is broken"
        for kind, message in records(plain):
            if kind == 5:
                m = Bytes(message)
                number, _, time, _ = m.fixed("H"), m.fixed("I"), m.fixed("Q"), m.fixed("Q")
                for line in lines(number, time, Bytes(message[22:]), uids):
                    print(line)


main(sys.argv[1])
