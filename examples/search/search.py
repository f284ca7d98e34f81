#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A searches the rooms of an office for somebody who is hurt, and calls for help; who hears it comes."""
import base64
import json
import math
import sys

HURT = (37.3, 20.7)  # A sees the place within 2 m
ROOMS = [(29.2, 3.6), (37.3, 15.8), (37.3, 20.7), (10.5, 4.0)]


def ask(**question):
    print(json.dumps(question), flush=True)
    answer = json.loads(sys.stdin.readline())
    if answer["type"] == "error":
        sys.exit("{at}: {msg}".format(**answer))
    return answer


def step(do, send=()):
    step.number += 1
    return ask(type="step", n=step.number, do=do, send=list(send))


def distance(state, robot, place):
    at = state["robots"][robot]
    return math.dist((at["x"], at["y"]), place)


step.number = 0
ask(type="hello", protocol=1, name="search", robots=["A", "B", "C"], step="200 ms", observe=["pose", "heard"])
for room in ROOMS:  # A goes from room to room, and turns about in each
    state = step({"A": {"goal": room, "speed": 1.2}})
    while distance(state, "A", HURT) > 2 and distance(state, "A", room) > 0.1:
        state = step({})
    if distance(state, "A", HURT) <= 2:
        break
    for _ in range(10):
        state = step({"A": {"v": 0, "w": math.pi}})

step({"A": {"stop": True}})
call = {"from": "A", "port": 7, "data": base64.b64encode(b"help").decode()}
on_the_way = set()
while not state["done"] and not any(distance(state, robot, HURT) < 3 for robot in "BC"):
    hearers = {message["at"] for message in state["heard"]} - on_the_way
    on_the_way |= hearers
    state = step({robot: {"goal": HURT, "speed": 1.5} for robot in hearers},
                 [call] if step.number % 10 == 0 else [])
ask(type="bye")
