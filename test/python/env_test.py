# SPDX-License-Identifier: MIT
"""rovernet.ParallelEnv and Env: the shapes that programs for reinforcement learning expect."""
import copy
import inspect
import pickle
import unittest
import warnings

import numpy as np

import rovernet as rn
from rovernet import spaces
from scenes import ROW, still

# Names, parameters and their defaults as PettingZoo 1.24 (ParallelEnv) and Gymnasium 0.29 (Env) document them.
PARALLEL_ENV = {
    "reset": "(self, seed=None, options=None)",
    "step": "(self, actions)",
    "render": "(self)",
    "close": "(self)",
    "state": "(self)",
    "observation_space": "(self, agent)",
    "action_space": "(self, agent)",
}
PARALLEL_ENV_ATTRIBUTES = ("metadata agents possible_agents num_agents max_num_agents observation_spaces "
                           "action_spaces unwrapped")
ENV = {
    "reset": "(self, *, seed=None, options=None)",
    "step": "(self, action)",
    "render": "(self)",
    "close": "(self)",
}
ENV_ATTRIBUTES = "metadata render_mode spec observation_space action_space unwrapped"

FAILING = {
    "scenario": {"duration": "1 s"},
    "robot": [{"name": "A", "at": [0, 0]},
              {"name": "B", "at": [10, 0], "off": ["0.25 s"]}],
}
"""B is switched off at 0.25 s."""

SPEAKING = {
    "scenario": {"duration": "1 s"},
    "robot": [{"name": "A", "at": [0, 0]}, {"name": "B", "at": [10, 0]}],
    "traffic": [{"from": "A", "payload": "hello", "start": "0.05 s"}],
}
"""A says something once, in the first step."""


def signature(function):
    plain = inspect.signature(function)
    without_types = [each.replace(annotation=inspect.Parameter.empty) for each in plain.parameters.values()]
    return str(plain.replace(parameters=without_types, return_annotation=inspect.Signature.empty))


def nothing(session, heard):
    return np.zeros(len(session.robots))


class Shapes(unittest.TestCase):
    def test_parallel_env_has_the_functions_of_pettingzoo(self):
        for name, expected in PARALLEL_ENV.items():
            self.assertEqual(signature(getattr(rn.ParallelEnv, name)), expected, name)
        env = rn.ParallelEnv(ROW, nothing)
        for name in PARALLEL_ENV_ATTRIBUTES.split():
            self.assertTrue(hasattr(env, name), name)
        self.assertIn("render_modes", env.metadata)

    def test_env_has_the_functions_of_gymnasium(self):
        for name, expected in ENV.items():
            self.assertEqual(signature(getattr(rn.Env, name)), expected, name)
        with rn.Env(ROW, lambda session, heard: 0) as env:
            for name in ENV_ATTRIBUTES.split():
                self.assertTrue(hasattr(env, name), name)

    def test_the_checker_of_gymnasium_passes(self):
        try:
            from gymnasium.utils.env_checker import check_env
        except ImportError:
            self.skipTest("gymnasium is not installed")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # advice
            check_env(rn.Env(ROW, lambda session, heard: 0), skip_render_check=True)
            check_env(rn.Env(SPEAKING, lambda session, heard: 0), skip_render_check=True)

    def test_the_checker_of_pettingzoo_passes(self):
        try:
            from pettingzoo.test import parallel_api_test
        except ImportError:
            self.skipTest("pettingzoo is not installed")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # advice
            parallel_api_test(rn.ParallelEnv(ROW, nothing), num_cycles=100)
            parallel_api_test(rn.ParallelEnv(FAILING, nothing), num_cycles=100)

    def test_a_step_after_a_reset_with_the_same_seed_has_the_same_results(self):
        """The checker of gymnasium requires equal results, also equal infos."""
        env, results = rn.Env(SPEAKING, lambda session, heard: len(heard)), []
        for _ in range(2):
            env.reset(seed=123)
            observation, *rest = env.step(np.full((2, 2), 0.5))
            results.append((observation.tolist(), *rest))
        self.assertEqual(results[0], results[1])
        self.assertEqual(results[0][1], 1)  # a message was heard


class ParallelEnv(unittest.TestCase):
    def test_actions_drive_robots_and_observations_are_their_poses(self):
        env = rn.ParallelEnv(still(2), lambda session, heard: session.pose[:, 0], step=1)
        observations, infos = env.reset(seed=3)
        self.assertEqual(env.session.seed, 3)
        self.assertEqual({agent: each.tolist() for agent, each in observations.items()},
                         {"r0": [0, 0, 0], "r1": [10, 0, 0]})
        self.assertEqual(infos, {"r0": {"heard": []}, "r1": {"heard": []}})
        result = env.step({"r1": np.array([0.5, 0.0])})
        observations, rewards, terminations, truncations, infos = result
        self.assertEqual([set(each) for each in result], [{"r0", "r1"}] * 5)
        self.assertEqual(observations["r1"].tolist(), [10.5, 0, 0])
        self.assertEqual(rewards, {"r0": 0.0, "r1": 10.5})
        self.assertEqual(list(terminations.values()) + list(truncations.values()), [False] * 4)
        later = env.step({})[0]  # goes on as it was told
        self.assertEqual(later["r1"].tolist(), [11, 0, 0])
        self.assertEqual(observations["r1"].tolist(), [10.5, 0, 0])  # a copy
        self.assertTrue(all(env.observation_space(agent).contains(each) for agent, each in later.items()))
        with self.assertRaisesRegex(ValueError, "no agent 'x'; expected one of r0, r1"):
            env.step({"x": [0, 0]})

    def test_a_message_is_in_the_infos_of_the_robots_that_received_it(self):
        env = rn.ParallelEnv(ROW, nothing)
        env.reset()
        env.session.send("B", b"F")
        infos = env.step({})[4]
        self.assertEqual([each.data for each in infos["A"]["heard"]], [b"F"])
        self.assertEqual([each.at for each in infos["C"]["heard"]], ["C"])
        self.assertEqual(infos["B"]["heard"], [])

    def test_a_robot_switched_off_is_terminated_and_the_end_of_the_run_truncates_the_others(self):
        env = rn.ParallelEnv(FAILING, nothing)
        env.reset()
        lives, ends = [], []
        while env.agents:
            lives.append(list(env.agents))
            _, _, terminations, truncations, _ = env.step({agent: [0.1, 0] for agent in env.agents})
            self.assertEqual(list(terminations), lives[-1])
            ends.append((terminations, truncations))
        self.assertEqual(lives, [["A", "B"]] * 3 + [["A"]] * 7)
        self.assertEqual(ends[2], ({"A": False, "B": True}, {"A": False, "B": False}))
        self.assertEqual(ends[9], ({"A": False}, {"A": True}))
        env.reset()
        self.assertEqual(env.agents, ["A", "B"])

    def test_a_robot_terminated_at_the_end_is_not_truncated(self):
        env = rn.ParallelEnv(FAILING, nothing, step=1, terminated=lambda session, heard: [True, False])
        env.reset()
        self.assertEqual(env.step({})[2:4], ({"A": True, "B": False}, {"A": False, "B": True}))

    def test_a_reset_without_a_seed_increments_the_last_seed(self):
        env = rn.ParallelEnv(ROW, nothing, seed=5)
        seeds = []
        for seed in (None, None, None, 9, None):
            env.reset(seed=seed)
            seeds.append(env.session.seed)
        self.assertEqual(seeds, [5, 6, 7, 9, 10])

    def test_functions_of_the_user_can_define_observations_actions_and_termination(self):
        said = spaces.Discrete(2)

        def speak(session, actions):
            for agent, action in actions.items():
                if action:
                    session.send(agent, b"F")

        def count(session, heard):
            return {name: sum(each.at == name for each in heard) for name in session.robots}
        env = rn.ParallelEnv(ROW, count, observe=count, observation_space=spaces.Discrete(10), act=speak,
                             action_space=said, terminated=lambda session, heard: [False, True, False])
        env.reset()
        observations, rewards, terminations, *_ = env.step({"A": 0, "B": 1, "C": 0})
        self.assertEqual(observations, {"A": 1, "B": 0, "C": 1})
        self.assertEqual(rewards, observations)
        self.assertEqual(env.agents, ["A", "C"])
        self.assertIs(env.action_space("A"), said)
        with self.assertRaisesRegex(ValueError, "observation_space"):
            rn.ParallelEnv(ROW, nothing, observe=count)
        with self.assertRaisesRegex(ValueError, "a row for each of 3 robots, got 2"):
            env = rn.ParallelEnv(ROW, lambda session, heard: [1, 2])
            env.reset()
            env.step({})

    def test_an_error_in_the_reward_function_is_raised_by_step(self):
        def fail(session, heard):
            raise ZeroDivisionError
        env = rn.ParallelEnv(ROW, fail)
        env.reset()
        with self.assertRaises(ZeroDivisionError):
            env.step({})


class Env(unittest.TestCase):
    def test_an_env_takes_one_array_of_actions_and_returns_one_reward(self):
        env = rn.Env(FAILING, lambda session, heard: -session.pose[0, 0], robots=["A"])
        observation, info = env.reset(seed=1)
        self.assertEqual(observation.tolist(), [[0, 0, 0]])
        self.assertTrue(env.observation_space.contains(observation))
        self.assertEqual(info, {"heard": []})
        steps = 0
        ended = False
        while not ended:
            observation, reward, terminated, truncated, info = env.step(np.array([[1.0, 0.0]]))
            steps += 1
            ended = terminated or truncated
        self.assertEqual((steps, terminated, truncated), (10, False, True))
        self.assertAlmostEqual(reward, -1)
        self.assertIsInstance(reward, float)

    def test_an_env_terminates_only_when_all_its_robots_are_off(self):
        env = rn.Env(FAILING, lambda session, heard: 0, robots=["B"])
        env.reset()
        ends = [env.step(np.zeros((1, 2)))[2:4] for _ in range(3)]
        self.assertEqual(ends, [(False, False), (False, False), (True, False)])
        with self.assertRaisesRegex(ValueError, r"shape \(1, 2\)"):
            env.step([0, 0])
        both = rn.Env(FAILING, lambda session, heard: 0, step=0.5)
        both.reset()
        self.assertEqual(both.step(np.zeros((2, 2)))[2:4], (False, False))  # B is off


def no_reward(session, heard):
    return 0


def no_rewards(session, heard):
    return np.zeros(len(session.robots))


class Copies(unittest.TestCase):
    def test_a_copy_restarts_its_episode_and_then_continues_like_the_original(self):
        env = rn.Env(SPEAKING, no_reward, set={"radio.power": "10 dBm"}, seed=5, step=0.5)
        env.reset()
        env.step(np.ones(env.action_space.shape))
        self.assertEqual(env.np_random.random(), np.random.default_rng(5).random())
        for copied in (pickle.loads(pickle.dumps(env)), copy.deepcopy(env)):
            self.assertEqual((copied.session.seed, copied.session.time), (5, 0))
            self.assertEqual(copied.np_random.random(), copy.deepcopy(env.np_random).random())
            self.assertEqual(copied.step(np.ones(env.action_space.shape))[1:4], (0, False, False))
            copied.reset()
            self.assertEqual(copied.session.seed, 6)
        env.reset(seed=9)
        self.assertEqual(env.np_random.random(), np.random.default_rng(9).random())
        agents = rn.ParallelEnv(FAILING, no_rewards, step=0.5)
        agents.reset(seed=3)
        copied = pickle.loads(pickle.dumps(agents))
        action = {agent: np.array([1.0, 0.0]) for agent in agents.agents}
        self.assertEqual(str(copied.step(action)), str(agents.step(action)))

    def test_scans_can_be_the_observations(self):
        scene = still(2)
        for robot in scene["robot"]:
            robot["scan"] = {"beams": 5, "range": 12}
        env = rn.Env(scene, no_reward, observe="scan")
        self.assertEqual(env.observation_space, spaces.Box(0, 12, (2, 5), np.float64))
        observation = env.reset()[0]
        self.assertTrue(env.observation_space.contains(observation))
        np.testing.assert_array_equal(observation, env.session.scan())
        agents = rn.ParallelEnv(scene, no_rewards, observe="scan")
        self.assertEqual(agents.observation_space("r0").shape, (5,))
        np.testing.assert_array_equal(agents.reset()[0]["r1"], observation[1])
        for observe, why in (("scam", 'expected "pose", "scan" or a function'), (no_reward, "needs an observation_space")):
            with self.assertRaisesRegex(ValueError, why):
                rn.Env(scene, no_reward, observe=observe)
        with self.assertRaisesRegex(ValueError, "robot r0 has no range finder"):
            rn.Env(still(1), no_reward, observe="scan")


class Spaces(unittest.TestCase):
    def test_samples_of_a_box_are_inside_it_and_repeatable(self):
        box = spaces.Box(np.array([-1, 0, -np.inf, -np.inf]), np.array([1, np.inf, 0, np.inf]), dtype=np.float64)
        self.assertEqual((box.shape, box.dtype), ((4,), np.dtype(float)))
        box.seed(3)
        samples = [box.sample() for _ in range(1000)]
        self.assertTrue(all(box.contains(each) for each in samples))
        self.assertLess(abs(np.mean(samples, axis=0)[0]), 0.1)  # 5 sigma: 1 / sqrt(3 * 1000) is 0.018
        self.assertFalse(box.contains(np.array([2.0, 0, 0, 0])))
        self.assertFalse(box.contains(np.array([0, -1.0, 0, 0])))
        self.assertFalse(box.contains(np.zeros(3)))
        self.assertFalse(box.contains(np.array(["a"] * 4)))
        box.seed(3)
        np.testing.assert_array_equal(box.sample(), samples[0])
        whole = spaces.Box(0, 2, (100,), np.int64)
        self.assertEqual(set(whole.sample().tolist()), {0, 1, 2})
        self.assertEqual(spaces.Box(0, 1, (2,)), spaces.Box(0, 1, (2,)))
        self.assertNotEqual(spaces.Box(0, 1, (2,)), spaces.Box(0, 1, (3,)))

    def test_a_discrete_space_contains_its_whole_numbers_only(self):
        space = spaces.Discrete(3, start=-1)
        self.assertEqual({int(space.sample()) for _ in range(100)}, {-1, 0, 1})
        self.assertTrue(0 in space and np.int64(1) in space)
        self.assertFalse(2 in space or 0.5 in space or "a" in space)

    def test_a_dict_space_contains_values_with_all_its_keys_only(self):
        space = spaces.Dict({"say": spaces.Discrete(2), "drive": spaces.Box(-1, 1, (2,), np.float64)})
        self.assertTrue(space.contains(space.sample()))
        self.assertFalse(space.contains({"say": 1}))
        self.assertEqual(space["say"], spaces.Discrete(2))


if __name__ == "__main__":
    unittest.main()
