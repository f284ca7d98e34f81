# SPDX-License-Identifier: MIT
"""Wireless networks of moving robots, simulated event by event.

    import rovernet as rn

    run = rn.run("rescue.toml", seed=3)        # run.metrics, run.timeline, run.records("received")
    session = rn.Session("rescue.toml")        # session.drive(vw), session.send("A", b"F"), session.step()
    env = rn.ParallelEnv("rescue.toml", reward=lambda session, heard: ...)

Lengths are in metres, angles in radians, levels in dBm; times are in seconds, or whole nanoseconds where
they are called t_ns. docs/guide/python.md tells more.
"""
from . import spaces
from ._core import Heard, InputError, Run, RunError, Session, __version__, run
from .env import Env, ParallelEnv

__all__ = ["Env", "Heard", "InputError", "ParallelEnv", "Run", "RunError", "Session", "__version__", "run", "spaces"]
