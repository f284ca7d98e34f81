# SPDX-License-Identifier: MIT
"""Sessions in the shape that programs for reinforcement learning expect."""
from __future__ import annotations

from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from . import spaces
from ._core import Heard, Session

try:
    from gymnasium import Env as GymnasiumEnv
except ImportError:

    class GymnasiumEnv:
        """What gymnasium.Env gives its environments, without gymnasium."""

        metadata: dict = {"render_modes": []}
        render_mode: Optional[str] = None
        spec: Any = None
        np_random: np.random.Generator

        def reset(self, *, seed: Optional[int] = None, options: Optional[dict] = None):
            if seed is not None:
                self.np_random = np.random.default_rng(seed)

        @property
        def unwrapped(self):
            return self

        def __enter__(self):
            return self

        def __exit__(self, *error):
            self.close()
            return False


try:
    from pettingzoo import ParallelEnv as PettingZooEnv
except ImportError:

    class PettingZooEnv:
        """What pettingzoo.ParallelEnv gives its environments, without pettingzoo."""

        agents: list
        possible_agents: list

        @property
        def num_agents(self) -> int:
            return len(self.agents)

        @property
        def max_num_agents(self) -> int:
            return len(self.possible_agents)

        @property
        def unwrapped(self):
            return self


Observe = Union[str, Callable[[Session, Sequence[Heard]], Any]]
Reward = Callable[[Session, Sequence[Heard]], Any]
Act = Callable[[Session, Any], None]
Terminated = Callable[[Session, Sequence[Heard]], Any]


def _pose(session: Session, heard: Sequence[Heard]) -> np.ndarray:
    return session.pose.copy()


def _scan(session: Session, heard: Sequence[Heard]) -> np.ndarray:
    return session.scan()


def _drive(session: Session, velocities: Any) -> None:
    session.drive(velocities)


def _off(session: Session, heard: Sequence[Heard]) -> np.ndarray:
    return ~session.on


def _all_off(session: Session, heard: Sequence[Heard]) -> bool:
    return not session.on.any()


def _observations(session: Session, observe: Optional[Observe]) -> tuple[Callable, Optional[tuple]]:
    """Function of observations, and (low, high, shape) of one robot's observations; None: not known."""
    if observe is None or observe == "pose":
        return _pose, (-np.inf, np.inf, (3,))
    if observe == "scan":
        shape = session.scan().shape[1:]
        return _scan, (0.0, max(session.scanners(robot)[0]["range"] for robot in session.robots), shape)
    if callable(observe):
        return observe, None
    raise ValueError(f'observe: expected "pose", "scan" or a function, got {observe!r}')


def _velocities(shape: tuple) -> spaces.Box:
    return spaces.Box(-1.0, 1.0, shape, np.float64)


class _Episodes:
    """Session of an environment, one episode after the other."""

    def __init__(self, seed: Optional[int], **scenario: Any):
        self._scenario = scenario
        self.session = Session(**scenario, seed=seed)
        self._is_new = True

    # A session cannot be copied. A copy of an environment stands at the begin of its episode; whatever
    # begins next is the same for both.
    def __getstate__(self) -> dict:
        return {**self.__dict__, "session": self.session.seed}

    def __setstate__(self, state: dict) -> None:
        self.__dict__.update(state)
        self.session = Session(**self._scenario, seed=state["session"])

    def _begin(self, seed: Optional[int]) -> None:
        # Without a seed each episode is another: it has the seed after that of the one before.
        if seed is None and not self._is_new:
            seed = self.session.seed + 1
        self._is_new = False
        self.session.reset(seed)

    def render(self) -> None:
        """Shows nothing: `rovernet draw` makes pictures."""

    def close(self) -> None:
        """Nothing is left open."""


class ParallelEnv(_Episodes, PettingZooEnv):
    """Robots of a scenario as agents, in the shape of PettingZoo's parallel API.

    An episode ends for all robots, truncated, at the end of the scenario; for a robot that is switched off
    it is terminated, and the robot leaves `agents`. `infos[agent]["heard"]` has the messages of the step.

    scenario, step, seed, set, robots: see Session
    reward(session, heard): rewards of the step, as an array (n,) or a dict by agent
    observe(session, heard): observations, as an array with a row for each robot or a dict by agent;
        "pose" or None: x [m], y [m] and heading [rad]; "scan": distances of the first range finder [m]
    observation_space: of one agent; required if `observe` is a function
    act(session, actions): carries out the dict of actions; None: an action is speed [m/s] and turn rate
        [rad/s], and a robot without an action keeps its last command
    action_space: of one agent; None: speed and turn rate from -1 to 1
    terminated(session, heard): which robots have ended their episode, as an array (n,); None: those
        that are off
    """

    metadata = {"name": "rovernet", "render_modes": []}

    def __init__(self, scenario: Any, reward: Reward, *, observe: Optional[Observe] = None,
                 observation_space: Optional[spaces.Space] = None, act: Optional[Act] = None,
                 action_space: Optional[spaces.Space] = None, terminated: Optional[Terminated] = None,
                 step: float = 0.1, seed: Optional[int] = None, set: Optional[Mapping[str, Any]] = None,
                 robots: Optional[Sequence[str]] = None):
        super().__init__(seed, scenario=scenario, step=step, set=set, robots=robots)
        self.possible_agents = self.session.robots
        self.agents = list(self.possible_agents)
        self._rows = {agent: row for row, agent in enumerate(self.possible_agents)}
        self._reward = reward
        self._observe, bounds = _observations(self.session, observe)
        self._act, self._terminated = act or self._drive, terminated or _off
        if observation_space is None and bounds is None:
            raise ValueError("ParallelEnv: observe is a function, which needs an observation_space: the space of one agent")
        observation_space = observation_space or spaces.Box(*bounds, np.float64)
        action_space = action_space or _velocities((2,))
        self.observation_spaces = {agent: observation_space for agent in self.possible_agents}
        self.action_spaces = {agent: action_space for agent in self.possible_agents}

    def observation_space(self, agent: str) -> spaces.Space:
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> spaces.Space:
        return self.action_spaces[agent]

    def reset(self, seed: Optional[int] = None, options: Optional[dict] = None) -> tuple[dict, dict]:
        """Begins an episode; without a seed, the next one. Returns observations and infos."""
        self._begin(seed)
        self.agents = list(self.possible_agents)
        return self._by_agent(self._observe(self.session, [])), self._infos([])

    def step(self, actions: Mapping[str, Any]) -> tuple[dict, dict, dict, dict, dict]:
        """Runs for a step. Returns observations, rewards, terminations, truncations and infos."""
        session = self.session
        self._act(session, actions)
        heard = session.step()
        observations = self._by_agent(self._observe(session, heard))
        rewards = {agent: float(each) for agent, each in self._by_agent(self._reward(session, heard)).items()}
        ended = self._by_agent(self._terminated(session, heard))
        terminations = {agent: bool(each) for agent, each in ended.items()}
        is_done = session.done
        truncations = {agent: is_done and not each for agent, each in terminations.items()}
        infos = self._infos(heard)
        self.agents = [each for each in self.agents if not (terminations[each] or truncations[each])]
        return observations, rewards, terminations, truncations, infos

    def state(self) -> np.ndarray:
        """(n, 3): x [m], y [m] and heading [rad] of all robots."""
        return self.session.pose.copy()

    def _by_agent(self, values: Any) -> dict:
        if isinstance(values, Mapping):
            return {agent: values[agent] for agent in self.agents}
        if len(values) != len(self._rows):
            raise ValueError(f"expected a row for each of {len(self._rows)} robots, got {len(values)}")
        if isinstance(values, np.ndarray) and values.ndim == 1:
            values = values.tolist()  # numbers of Python take half the time
        return {agent: values[self._rows[agent]] for agent in self.agents}

    def _infos(self, heard: Sequence[Heard]) -> dict:
        infos: dict = {agent: {"heard": []} for agent in self.agents}
        for message in heard:
            if message.at in infos:
                infos[message.at]["heard"].append(message)
        return infos

    def _drive(self, session: Session, actions: Mapping[str, Any]) -> None:
        velocities = np.full((len(self._rows), 2), np.nan)
        for agent, action in actions.items():
            if agent not in self._rows:
                raise ValueError(f"there is no agent {agent!r}; expected one of {', '.join(self._rows)}")
            velocities[self._rows[agent]] = action
        session.drive(velocities)


class Env(_Episodes, GymnasiumEnv):
    """All robots of a scenario under one controller, in the shape of Gymnasium's Env.

    scenario, step, seed, set, robots: see Session
    reward(session, heard): reward of the step
    observe(session, heard): observation; "pose" or None: (n, 3), x [m], y [m] and heading [rad] of each
        robot; "scan": (n, beams), distances of the first range finder of each robot [m]
    observation_space: required if `observe` is a function
    act(session, action): carries out the action; None: (n, 2), speed [m/s] and turn rate [rad/s] of each robot
    action_space: None: speeds and turn rates from -1 to 1
    terminated(session, heard): whether the episode has ended; None: once all robots are off

    `np_random` is a generator for what the program itself draws; reset(seed=...) begins it anew. A copy, by
    pickle or copy, begins its episode anew.
    """

    metadata = {"name": "rovernet", "render_modes": []}

    def __init__(self, scenario: Any, reward: Reward, *, observe: Optional[Observe] = None,
                 observation_space: Optional[spaces.Space] = None, act: Optional[Act] = None,
                 action_space: Optional[spaces.Space] = None, terminated: Optional[Terminated] = None,
                 step: float = 0.1, seed: Optional[int] = None, set: Optional[Mapping[str, Any]] = None,
                 robots: Optional[Sequence[str]] = None):
        super().__init__(seed, scenario=scenario, step=step, set=set, robots=robots)
        self.np_random = np.random.default_rng(self.session.seed)
        count = len(self.session.robots)
        self._reward = reward
        self._observe, bounds = _observations(self.session, observe)
        self._act, self._terminated = act or _drive, terminated or _all_off
        if observation_space is None and bounds is None:
            raise ValueError("Env: observe is a function, which needs an observation_space: the space of all robots together")
        if observation_space is None:
            low, high, shape = bounds
            observation_space = spaces.Box(low, high, (count, *shape), np.float64)
        self.observation_space = observation_space
        self.action_space = action_space or _velocities((count, 2))

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict] = None) -> tuple[Any, dict]:
        """Begins an episode; without a seed, the next one. Returns observation and info."""
        GymnasiumEnv.reset(self, seed=seed, options=options)
        self._begin(seed)
        return self._observe(self.session, []), {"heard": []}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict]:
        """Runs for a step. Returns observation, reward, terminated, truncated and info."""
        session = self.session
        self._act(session, action)
        heard = session.step()
        reward = float(self._reward(session, heard))
        terminated = bool(self._terminated(session, heard))
        truncated = session.done and not terminated
        return self._observe(session, heard), reward, terminated, truncated, {"heard": heard}
