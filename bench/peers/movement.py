# SPDX-License-Identifier: MIT
"""Movement files of the peers' workloads, in the syntax of ns-2.

N nodes uniform in a square of side 250 sqrt(pi N / 12) m: mean degree 12 at a range of 250 m, less
at the borders. The same seed gives the same bytes on every machine (Python keeps random() as it is).
"""
import math
import random

RANGE = 250.0  # [m]
DEGREE = 12
MARGIN = 0.01  # [m]; ns-2 ends at once when a node is sent to the edge of its field
SLOWEST, FASTEST = 1.0, 20.0  # [m/s]
DURATION = 70.0  # [s]
DIGITS = 6  # written; arrivals are those of the written numbers


def side(nodes):
    """Of the square [m]."""
    return RANGE * math.sqrt(math.pi * nodes / DEGREE)


def legs(start, point, draw):
    """(time [s], target [m], speed [m/s]) of one random waypoint node without pauses."""
    time, here = 0.0, start
    while time < DURATION:
        target, speed = point(), round(draw.uniform(SLOWEST, FASTEST), DIGITS)
        yield time, target, speed
        time += math.dist(here, target) / speed
        here = target


def text(kind, nodes, seed):
    """The whole file; `kind` is "static" or "rwp"."""
    draw, edge = random.Random(seed), side(nodes)

    def point():
        return tuple(round(draw.uniform(MARGIN, edge - MARGIN), DIGITS) for _ in "xy")

    starts = [point() for _ in range(nodes)]
    lines = [f"# {kind}, nodes: {nodes}, seed: {seed}, max x: {edge:.2f}, max y: {edge:.2f}"]
    for node, (x, y) in enumerate(starts):
        lines += [f"$node_({node}) set {axis}_ {value:.6f}" for axis, value in zip("XYZ", (x, y, 0.0))]
    if kind == "rwp":
        moves = [(time, node, target, speed) for node, start in enumerate(starts)
                 for time, target, speed in legs(start, point, draw)]
        lines += [f'$ns_ at {time:.9f} "$node_({node}) setdest {x:.6f} {y:.6f} {speed:.6f}"'
                  for time, node, (x, y), speed in sorted(moves)]
    return "\n".join(lines) + "\n"
