#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Two relays learn how fast to follow an explorer, so that its base hears it for as long as can be.

A policy is two numbers: the speeds of the relays as shares of the explorer's. Random search changes them a
little, and keeps what is better. Three equal hops are best: 1/3 and 2/3.

    PYTHONPATH=build/release/python /usr/bin/python3 examples/relay/learn.py
"""
import random
from pathlib import Path

import numpy as np

import rovernet as rn


def heard_at_base(session, heard):
    return sum(message.at == "base" for message in heard)


env = rn.Env(Path(__file__).parent / "relay.toml", heard_at_base, robots=["relay1", "relay2", "base"], step=10)


def score(policy):
    """Messages that the base hears of an episode with that policy."""
    env.reset(seed=1)
    velocities = np.zeros((3, 2))
    velocities[:2, 0] = 3 * np.array(policy)  # [m/s], along x as the explorer
    total, is_over = 0, False
    while not is_over:
        _, reward, terminated, truncated, _ = env.step(velocities)
        total += reward
        is_over = terminated or truncated
    return total


draw = random.Random(1)
best, policy = -1, (0.5, 0.5)
for trial in range(300):
    candidate = tuple(min(max(share + draw.uniform(-0.2, 0.2), 0), 1) for share in policy)
    reached = score(candidate)
    if reached > best:
        best, policy = reached, candidate
        print(f"trial {trial:3}: shares {policy[0]:.2f} and {policy[1]:.2f}, the base hears {best:.0f} of 200")
