# SPDX-License-Identifier: MIT
"""rovernet.Session: steps, views, commands, callbacks, errors; the same run as through other interfaces."""
import gc
import json
import os
import signal
import subprocess
import sys
import threading
import time
import unittest
import weakref

import numpy as np

import rovernet as rn
from scenes import COMMAND, RESCUE, ROW, SEARCH, STOREYS, FolderTest, command, still

CONTROLLER = """
import base64, json, sys
def ask(**q):
    print(json.dumps(q), flush=True)
    return json.loads(sys.stdin.readline())
ask(type="hello", protocol=1, name="python", robots=["A", "B", "C"], step="100 ms", seed=9)
for n in range(1, 21):
    send = [{"from": "B", "to": "*", "port": n, "data": "Rg=="}] if n % 3 == 0 else []
    ask(type="step", n=n, do={"A": {"v": 0.1 * n, "w": 0.3}, "B": {"v": 1, "w": 0}, "C": {"v": 0, "w": -1}}, send=send)
ask(type="bye")
"""


def drive_as_the_controller(session):
    for n in range(1, 21):
        session.drive([[0.1 * n, 0.3], [1, 0], [0, -1]])
        if n % 3 == 0:
            session.send("B", b"F", port=n)
        session.step()


class SameRun(FolderTest):
    def test_the_same_controller_gives_the_same_run_in_lock_step_and_in_python(self):
        session = rn.Session(ROW, seed=9, out=self.folder / "python")
        drive_as_the_controller(session)
        run = session.finish()
        scenario, program = self.folder / "python" / "scenario.toml", self.write("controller.py", CONTROLLER)
        code, _, errors = command("live", scenario, "--controller", f"{sys.executable} {program}", "--out",
                                  self.folder / "live", folder=self.folder)
        self.assertEqual(code, 0, errors)
        summary = json.loads((self.folder / "live" / "summary.json").read_text())
        self.assertEqual(run.fingerprint, summary["fingerprint"])
        inputs = [(self.folder / door / "inputs.jsonl").read_text().split("\n") for door in ("python", "live")]
        self.assertEqual(inputs[0][1:], inputs[1][1:])  # the first line has the version

    def test_replay_of_the_logged_inputs_reproduces_the_run(self):
        with rn.Session(ROW, seed=9, out=self.folder / "run") as session:
            drive_as_the_controller(session)
            fingerprint = session.fingerprint
        code, out, _ = command("replay", self.folder / "run", "--verify", folder=self.folder)
        self.assertEqual(code, 0, out)
        self.assertTrue(out.startswith("identical: 69 inputs, fingerprint "), out)  # with 3 stops at the end
        self.assertNotIn(fingerprint, out)

    def test_a_session_without_commands_has_the_same_results_as_rn_run(self):
        session = rn.Session(ROW, step=0.3)
        while not session.done:
            session.step()
        self.assertEqual(session.fingerprint, rn.run(ROW).fingerprint)
        self.assertEqual(session.metrics | {"flows": None}, rn.run(ROW).metrics | {"flows": None})

    def test_an_exception_in_a_with_block_leaves_no_result_files(self):
        with self.assertRaises(KeyError):
            with rn.Session(ROW, out=self.folder / "run") as session:
                session.step()
                raise KeyError
        del session
        gc.collect()
        self.assertEqual(list((self.folder / "run").iterdir()), [])


class Steps(unittest.TestCase):
    def test_a_driven_robot_follows_its_arc(self):
        session = rn.Session(still(3), robots=["r1"])
        session.drive([[0.5, 0.2]])
        for _ in range(20):
            session.step()
        expected = [10 + 0.5 / 0.2 * np.sin(0.4), 0.5 / 0.2 * (1 - np.cos(0.4)), 0.4]
        chord = 1e-3  # [m] that a chord is beside its arc at most
        np.testing.assert_allclose(session.pose, [expected], rtol=0, atol=chord)
        np.testing.assert_allclose(session.twist, [[0.5, 0.2]], atol=1e-12)
        self.assertEqual((session.time, session.t_ns), (2.0, 2_000_000_000))

    def test_a_row_of_nan_leaves_the_command_of_a_robot_unchanged(self):
        session = rn.Session(still(2))
        session.drive([[1, 0], [1, 0]])
        session.step()
        session.drive([[np.nan, np.nan], [0, 0]])
        session.step()
        np.testing.assert_allclose(session.pose[:, 0], [0.2, 10.1], atol=1e-9)

    def test_a_timeout_stops_a_robot(self):
        session = rn.Session(still(1), step=1)
        session.drive([[1, 0]], timeout=0.25)
        session.step()
        np.testing.assert_allclose(session.pose[0, 0], 0.25, atol=1e-9)

    def test_a_robot_drives_towards_a_goal_and_stops_on_command(self):
        session = rn.Session(still(1), step=1)
        session.go_to("r0", (3, 4), speed=2)
        session.step()
        np.testing.assert_allclose(session.pose[0, :2], [1.2, 1.6], atol=1e-9)
        session.stop("r0")
        session.step()
        np.testing.assert_allclose(session.pose[0, :2], [1.2, 1.6], atol=1e-9)

    def test_the_error_for_a_wrong_type_names_the_argument_and_what_was_expected(self):
        session = rn.Session(RESCUE, step=1)
        robot = r'robot: expected the name of a robot, such as "A"'
        for call, why in (
                (lambda: session.go_to(0, (1, 2)), robot + ", got 0"),
                (lambda: session.neighbors(0), robot),
                (lambda: session.scan(0), robot + ", or None, got 0"),
                (lambda: session.go_to("A", "1,2"), r"to: expected a place \(x, y\) or \(x, y, z\) in metres, got '1,2'"),
                (lambda: session.go_to("A", (1, 2), speed="1 m/s"),
                 "speed: expected a number of metres per second, got '1 m/s'"),
                (lambda: session.place("A", "1 m", 2), "x: expected a number of metres, got '1 m'"),
                (lambda: session.drive(np.zeros((5, 2)), timeout="1 s"), "timeout: expected a number of seconds, or None"),
                (lambda: session.send("A", "hello"), "data: expected bytes, such as b\"F\", got 'hello'"),
                (lambda: session.send("A", b"F", to=1), "to: expected the name of a robot"),
                (lambda: session.command("A", v="1 m/s"), "v: expected a number, got '1 m/s'"),
                (lambda: session.command("A", place=3), "place: expected a place"),
                (lambda: session.reset(-1), "seed: expected a whole number >= 0, or None, got -1"),
                (lambda: rn.Session(RESCUE, step="100 ms"), "step: expected a number of seconds, got '100 ms'"),
                (lambda: rn.Session(RESCUE, robots="A"), r'robots: expected a list of names, such as \["A", "B"\], or None'),
                (lambda: rn.run(RESCUE, records="received"), "records: expected a list of kinds of records"),
                (lambda: rn.run(None), "scenario: expected the path of a file or a dict, got None"),
                (lambda: rn.run(RESCUE, out=3), "out: expected the path of a folder, or None, got 3"),
                (lambda: rn.run(RESCUE, progress=3), "progress: expected a function, or None, got 3"),
                (lambda: session.on_record("moved", 3), "function: expected a function, or None, got 3"),
                (lambda: session.go_to("A", list(range(1000)) + ["x"]), r"got \[0, 1, 2, [0-9, ]+\.\.\.$")):
            with self.assertRaisesRegex(TypeError, why):
                call()
        with self.assertRaisesRegex(ValueError, 'there is no robot "a"; .*; did you mean "A"'):
            session.go_to("a", (1, 2))
        with self.assertRaisesRegex(ValueError, "command: found vv, w; expected v, w, timeout; or goal"):
            session.command("A", vv=1, w=2)

    def test_an_error_about_the_folder_names_no_option_of_the_command(self):
        with self.assertRaisesRegex(rn.RunError, "/proc/nope: cannot create this folder") as raised:
            rn.Session(RESCUE, out="/proc/nope")
        self.assertNotIn("--", str(raised.exception))

    def test_a_goal_off_the_map_is_an_error_with_the_extent_of_the_map(self):
        session = rn.Session(RESCUE, robots=["A"], step=1)
        why = r"goal: \(48.1, 12\) m is off the map, which goes from \(0, 0\) to \(48, 24\) m"
        with self.assertRaisesRegex(ValueError, why):
            session.go_to("A", (48.1, 12))
        with self.assertRaisesRegex(ValueError, why):
            session.command("A", goal=[48.1, 12])
        open_field = rn.Session(still(1), step=1)
        open_field.go_to("r0", (1e6, -1e6))

    def test_a_position_without_room_is_an_error_and_a_goal_without_a_path_sets_session_no_way(self):
        session = rn.Session(RESCUE, robots=["A", "B"], step=1)
        for x, y, why in ((-5, 3, r"off the map, which goes from \(0, 0\) to \(48, 24\) m"),
                          (2, 6, "in a wall, or nearer to a wall than the radius of robot A")):
            with self.assertRaisesRegex(ValueError, why):
                session.place("A", x, y)
        session.place("A", 24, 12)
        session.go_to("B", (2, 6))
        session.step()
        np.testing.assert_allclose(session.pose[0, :2], [24, 12])
        self.assertEqual(session.no_way.tolist(), [False, True])
        session.go_to("B", (24, 12))
        session.step()
        self.assertEqual(session.no_way.tolist(), [False, False])

    def test_range_finders_measure_distances_to_other_robots(self):
        scene = still(3)
        for robot, beams in zip(scene["robot"], (3, 3, 1)):
            robot["scan"] = {"beams": beams, "range": 20}
        scene["robot"][0]["scan"] = [scene["robot"][0]["scan"], {"kind": "sonar", "name": "back", "angles": ["180 deg"],
                                                                 "at": ["-0.1 m", "0 m"]}]
        session = rn.Session(scene, robots=["r0", "r1"])
        np.testing.assert_allclose(session.scan(), [[20, 9.8, 20], [20, 9.8, 20]])
        np.testing.assert_allclose(session.scan("r2"), [20])
        np.testing.assert_allclose(session.scan("r0", "back"), session.scan("r0", 1))
        front, back = session.scanners("r0")
        self.assertEqual((front["name"], front["range"], back["kind"]), ("laser", 20, "sonar"))
        np.testing.assert_allclose(front["angles"], [-np.pi / 2, 0, np.pi / 2])
        np.testing.assert_allclose(np.abs(back["angles"]), [np.pi])
        np.testing.assert_allclose(back["places"], [[-0.1, 0]])
        for arguments, why in ((("r0", "front"), "expected one of laser, back"), (("r0", 2), "expected 0 to 1"),
                               (("r9",), 'no robot "r9"')):
            with self.assertRaisesRegex(ValueError, why):
                session.scan(*arguments)
        with self.assertRaisesRegex(ValueError, "robot r0 has 3 beams, but robot r2 has 1"):
            rn.Session(scene).scan()
        with self.assertRaisesRegex(ValueError, "robot r0 has no range finder"):
            rn.Session(still(1)).scan()

    def test_the_matrix_of_links_has_the_levels_of_neighbors(self):
        session = rn.Session(ROW)
        links = session.links()
        self.assertEqual(links.shape, (3, 3))
        self.assertEqual(np.isnan(links).tolist(), [[True, False, True], [False, True, False], [True, False, True]])
        for row, name in enumerate(session.names):
            for each in session.neighbors(name):
                self.assertEqual(links[row, session.names.index(each["name"])], each["rssi"])

    def test_a_robot_goes_up_the_stairs(self):
        session = rn.Session(STOREYS, robots=["courier", "landing"])
        self.assertEqual(session.z.tolist(), [0, 3])

        def go(*to):
            session.go_to("courier", to)
            for _ in range(150):
                session.step()
                yield session.z[0]
                if session.pose[0, :2].tolist() == list(to[:2]):
                    return
        self.assertEqual(set(go(5.5, 8.4)), {0})
        stairs = list(go(9.5, 8.4, 3))  # 5 m in space, at 1 m/s
        np.testing.assert_allclose(stairs, 3 * np.arange(1, 51) / 50, atol=1e-9)
        self.assertEqual(set(go(13.2, 2)), {3})

    def test_place_moves_a_robot_at_the_next_step_and_stops_it(self):
        session = rn.Session(still(2))
        session.drive([[1, 0.5], [0, 0]])
        session.step()
        session.place("r0", 7, -8)
        session.place("r1", 1, 2, heading=-1.5, z=5)
        self.assertNotEqual(session.pose[0, 0], 7)  # it holds from the next step on
        session.step()
        self.assertEqual((session.pose[0].tolist(), session.z.tolist()), ([7, -8, 0.05], [0, 5]))
        self.assertEqual((session.pose[1].tolist(), session.twist[0].tolist()), ([1, 2, -1.5], [0, 0]))
        session.place("r1", 3, 4)
        session.step()
        self.assertEqual((session.pose[1].tolist(), session.z[1]), ([3, 4, -1.5], 5))

    def test_a_received_message_has_origin_last_hop_hops_port_and_level(self):
        session = rn.Session(ROW, robots=["C", "B"])
        session.send("C", b"\0F", port=7)
        heard = session.step()
        self.assertEqual([(h.at, h.origin, h.last_hop, h.hops, h.port, h.data) for h in heard],
                         [("B", "C", "C", 1, 7, b"\0F")])  # A is not among its robots
        self.assertGreater(heard[0].t_ns, 0)
        self.assertIn("b'\\x00F'", repr(heard[0]))
        self.assertAlmostEqual(heard[0].rssi, session.neighbors("B")["rssi"][1], places=9)

    def test_a_message_that_a_flow_sends_at_the_beginning_has_its_level(self):
        flow = {"from": "C", "payload": "x", "every": "1 s"}
        session = rn.Session(ROW | {"traffic": [flow]}, robots=["B"])
        first = session.step()[0]
        self.assertLess(first.t_ns, 1_000_000)
        self.assertAlmostEqual(first.rssi, session.neighbors("B")["rssi"][1], places=9)

    def test_a_unicast_is_received_only_by_its_destination(self):
        session = rn.Session(ROW)
        session.send("B", b"x", to="C")
        self.assertEqual([h.at for h in session.step()], ["C"])

    def test_reset_repeats_the_run_or_starts_another_one_with_a_new_seed(self):
        session = rn.Session(ROW, seed=4)

        def played():
            drive_as_the_controller(session)
            return session.fingerprint
        first = played()
        self.assertTrue(session.done)
        session.reset()
        self.assertEqual((session.time, session.seed, session.pose[2].tolist()), (0.0, 4, [300, 0, 0]))
        self.assertEqual(played(), first)
        session.reset(seed=5)
        self.assertEqual(session.seed, 5)
        self.assertNotEqual(played(), first)

    def test_a_session_that_has_ended_refuses_to_step_until_a_reset(self):
        session = rn.Session(ROW, step=3)
        session.step()
        self.assertEqual((session.done, session.time, session.end), (True, 2.0, 2.0))
        with self.assertRaisesRegex(rn.RunError, "expected reset\\(\\) or finish\\(\\)"):
            session.step()
        run = session.finish()
        self.assertEqual(run.duration, 2.0)
        for use in (session.step, session.finish, lambda: session.time, lambda: session.send("A", b"")):
            with self.assertRaisesRegex(rn.RunError, "expected reset\\(\\) first"):
                use()
        session.reset()
        session.step()

    def test_requested_records_can_be_read_during_and_after_the_run(self):
        session = rn.Session(ROW, records=["sent"])
        session.send("B", b"F")
        session.step()
        self.assertEqual(session.records("sent")["robot"].tolist(), [1])
        with self.assertRaisesRegex(ValueError, r'were not kept; expected records=\["received"\]'):
            session.records("received")
        run = session.finish()
        self.assertEqual(run.records("sent")["robot"].tolist(), [1])
        with self.assertRaisesRegex(ValueError, "were not kept"):
            run.records("received")
        session.reset()
        self.assertEqual(len(session.records("sent")), 0)


class Neighbors(unittest.TestCase):
    def test_neighbors_equal_the_links_that_the_command_prints(self):
        session = rn.Session(SEARCH)
        found = session.neighbors("A")
        code, out, _ = command("links", SEARCH, "--robot", "A", "--json")
        self.assertEqual(code, 0, out)
        self.assertEqual(found.dtype.names, ("name", "rssi", "noise", "quality"))
        keys = ("robot", "level_dbm", "noise_dbm", "quality")
        links = json.loads(out)["robots"][0]["links"]
        self.assertEqual(found.tolist(), [tuple(link[key] for key in keys) for link in links])
        self.assertGreater(len(found), 0)
        with self.assertRaisesRegex(ValueError, 'no robot "a".*did you mean "A"'):
            session.neighbors("a")


class Views(unittest.TestCase):
    def test_the_pose_is_read_only_and_updated_in_place(self):
        session = rn.Session(still(2))
        pose = session.pose
        with self.assertRaisesRegex(ValueError, "read-only"):
            pose[0, 0] = 1
        with self.assertRaises(ValueError):
            pose.setflags(write=True)
        session.drive([[1, 0], [0, 0]])
        session.step()
        self.assertAlmostEqual(pose[0, 0], 0.1)
        session.reset()
        self.assertEqual(pose[0, 0], 0)
        self.assertEqual(pose.__array_interface__["data"], session.pose.__array_interface__["data"])

    def test_an_array_of_poses_stays_valid_after_its_session_is_deleted(self):
        session = rn.Session(still(1000))
        pose = session.pose
        del session
        gc.collect()
        filler = [np.ones(3000) for _ in range(100)]
        self.assertEqual(pose[:, 0].tolist(), [10.0 * i for i in range(1000)])
        del filler

    def test_a_session_in_a_reference_cycle_is_freed(self):
        session = rn.Session(still(1))
        session.on_record("sent", lambda row: session.time)  # a circle
        gone = weakref.ref(session)
        del session
        gc.collect()
        self.assertIsNone(gone())


class Commands(unittest.TestCase):
    def test_command_with_keys_has_the_effect_of_the_function_with_that_name(self):
        def by_functions(session, n):
            session.drive([[0.1 * n, -0.2], [np.nan, np.nan], [np.nan, np.nan]], timeout=0.25)
            if n == 3:
                session.go_to("B", (12, 3), speed=2)
                session.place("C", 31, 1, heading=-0.5)
                session.send("A", b"x", to="B", port=7, size=100)
                session.send("C", b"y")
            if n == 6:
                session.stop("B")

        def by_keys(session, n):
            session.command("A", v=0.1 * n, w=-0.2, timeout=0.25)
            if n == 3:
                session.command("B", goal=(12, 3), speed=2)
                session.command("C", place=[31, 1], heading=-0.5)
                session.command("A", data=b"x", to="B", port=7, size=100)
                session.command("C", data=b"y")
            if n == 6:
                session.command("B", stop=True)

        fingerprints, poses = [], []
        for give in by_functions, by_keys:
            session = rn.Session(ROW, seed=9)
            for n in range(1, 11):
                give(session, n)
                session.step()
            poses.append(session.pose.tolist())
            fingerprints.append(session.finish().fingerprint)
        self.assertEqual(*fingerprints)
        self.assertEqual(*poses)

    def test_command_refuses_invalid_keys_numbers_and_types(self):
        session = rn.Session(ROW)
        for words, keys in (("expected v, w, timeout; or goal, speed; or stop", {}), ("expected v", {"v": 1, "goal": (1, 2)}),
                            ("expected v", {"vv": 1}), ("goal is missing", {"speed": 1}), ("data is missing", {"port": 1}),
                            ("speed of robot A must be from -1000 to 1000 m/s, got 5000", {"v": 5000}),
                            ("timeout of robot A must be > 0 s", {"timeout": 0}), ("got 4 numbers", {"place": (1, 2, 3, 4)}),
                            ("port must be from 0 to 65535, got -1", {"data": b"", "port": -1}),
                            ("size of robot A must be 65507 at most", {"data": b"", "size": 70000}),
                            ('no robot "Z"', {"data": b"", "to": "Z"}), ("expected another robot", {"data": b"", "to": "A"})):
            with self.subTest(keys), self.assertRaisesRegex(ValueError, words):
                session.command("A", **keys)
        for keys in {"v": "fast"}, {"data": "text"}, {"place": 7}:
            with self.subTest(keys), self.assertRaises(TypeError):
                session.command("A", **keys)
        session.step()
        self.assertEqual(session.pose[0].tolist(), [0, 0, 0])


class BadInput(unittest.TestCase):
    def setUp(self):
        self.session = rn.Session(ROW)

    def refused(self, words, use, *arguments, error=ValueError, **options):
        with self.assertRaisesRegex(error, words):
            use(*arguments, **options)

    def test_arrays_of_a_wrong_shape_are_refused(self):
        drive = self.session.drive
        self.refused(r"expected numbers of shape \(3, 2\), got \(2, 2\)", drive, [[1, 1], [1, 1]])
        self.refused(r"expected numbers of shape \(3, 2\), got \(6,\)", drive, np.zeros(6))
        self.refused(r"expected numbers of shape \(3, 2\), got \(3, 2, 1\)", drive, np.zeros((3, 2, 1)))
        self.refused(r"expected numbers of shape \(3, 2\), got \(\)", drive, 3.0)
        self.refused(r"expected numbers of shape \(3, 2\), got <class 'str'>", drive, "fast")
        self.refused(r"expected numbers of shape \(3, 2\), got <class 'list'>", drive, [[1, 2], [3]])
        self.refused("expected a place", self.session.go_to, "A", (1, 2, 3, 4))

    def test_numbers_out_of_range_are_refused(self):
        self.refused("speed of robot B must be from -1000 to 1000 m/s, got 5000", self.session.drive,
                     [[0, 0], [5000, 0], [0, 0]])
        self.refused("turn rate of robot C must be", self.session.drive, [[0, 0], [0, 0], [0, np.inf]])
        self.refused("got nan", self.session.drive, [[0, np.nan], [0, 0], [0, 0]])
        self.refused("timeout of robot A must be > 0 s", self.session.drive, np.zeros((3, 2)), timeout=-1)
        self.refused("292 years", self.session.drive, np.zeros((3, 2)), timeout=1e300)
        self.refused("port must be from 0 to 65535, got 65536", self.session.send, "A", b"", port=65536)
        self.refused("size must be from 0 to 65535, got -1", self.session.send, "A", b"", size=-1)
        self.refused("65536 bytes", self.session.send, "A", bytes(65536))
        self.refused("speed of robot A must be above 0", self.session.go_to, "A", (1, 2), speed=0)
        self.refused("place of robot A must be from -1e9 to 1e9 m, got nan", self.session.place, "A", 1, np.nan)
        self.refused("heading of robot A must be", self.session.place, "A", 1, 2, heading=np.inf)
        self.refused("1 us or more", rn.Session, ROW, step=0)
        self.refused("1 us or more, got 1e-10 s", rn.Session, ROW, step=1e-10)
        self.refused("292 years", rn.Session, ROW, step=float("nan"))
        self.session.step()
        self.assertEqual(self.session.pose[0].tolist(), [0, 0, 0])

    def test_unknown_or_repeated_names_of_robots_are_refused(self):
        self.refused('no robot "Z"; expected one of A, B, C', self.session.send, "Z", b"")
        self.refused('no robot "Z"', self.session.send, "A", b"", to="Z")
        self.refused("expected another robot", self.session.send, "A", b"", to="A")
        self.refused("listed twice", rn.Session, ROW, robots=["A", "A"])
        self.refused("not among the robots", rn.Session(ROW, robots=["A"]).stop, "B")

    def test_values_of_a_wrong_type_are_refused(self):
        for use in (lambda: self.session.send("A", "text"), lambda: self.session.send("A", None),
                    lambda: self.session.go_to("A", "there"), lambda: self.session.place("A", (1, 2)), lambda: self.session.stop(0),
                    lambda: self.session.reset("seed"), lambda: self.session.reset(-1),
                    lambda: rn.Session(ROW, robots="A B")):
            with self.assertRaises((TypeError, ValueError)):
                use()


class Callbacks(unittest.TestCase):
    def test_a_callback_gets_records_in_order_and_its_commands_take_effect_in_the_next_step(self):
        session, told = rn.Session(ROW, records=["received"]), []

        def answer(row):
            told.append(row)
            if row["robot"] == 2:
                session.send("C", b"back")
        session.on_record("received", answer)
        session.send("B", b"F")
        session.step()
        self.assertEqual([(row["robot"], row["sender"], row["delivered"]) for row in told],
                         [(0, 1, True), (2, 1, True)] + [(row["robot"], row["sender"], row["delivered"])
                                                          for row in told[2:]])
        self.assertEqual(session.metrics["messages"], 1)
        kept = session.records("received")
        self.assertEqual([tuple(row.values())[:7] for row in told], [row[:7] for row in kept.tolist()])
        session.on_record("received", None)
        count = len(told)
        session.step()
        self.assertEqual(session.metrics["messages"], 2)
        self.assertEqual(len(told), count)

    def test_an_error_in_a_callback_ends_the_step_and_is_raised_by_step(self):
        session = rn.Session(ROW, step=1)

        def fail(row):
            raise ZeroDivisionError(row["t_ns"])
        session.on_record("sent", fail)
        with self.assertRaises(ZeroDivisionError) as raised:
            session.step()
        self.assertEqual(raised.exception.args, (500_000_000,))
        self.assertEqual(session.t_ns, 500_000_000)
        session.on_record("sent", None)
        session.step()
        self.assertEqual(session.t_ns, 1_500_000_000)

    def test_an_error_in_a_callback_during_reset_or_finish_is_raised_by_them(self):
        session = rn.Session(ROW)

        def fail(row):
            raise ZeroDivisionError
        session.on_record("moved", fail)
        for use in session.reset, session.finish, session.reset:
            with self.assertRaises(ZeroDivisionError):
                use()
        session.on_record("moved", None)
        session.step()

    def test_a_callback_may_not_step_reset_or_finish_its_session(self):
        session = rn.Session(ROW, step=1)
        for use in (session.step, session.reset, session.finish, lambda: session.on_record("sent", None)):
            session.reset()
            session.on_record("sent", lambda row: use())
            with self.assertRaisesRegex(rn.RunError, "in a step"):
                session.step()

    def test_a_callback_may_read_time_poses_and_names(self):
        session, asked = rn.Session(ROW, step=1), []
        session.on_record("sent", lambda row: asked.append((session.t_ns, session.pose[1, 0], session.names)))
        session.step()
        self.assertEqual(asked, [(500_000_000, 150.0, ("A", "B", "C"))])


BUSY = {
    "scenario": {"duration": "1e6 s", "event_limit": 10 ** 12},
    "robot": [{"name": "r", "count": 30, "place": {"model": "uniform", "area": [[0, 0], [100, 100]]}}],
    "traffic": [{"from": "r0", "payload": "x", "every": "10 ms"}],
}
"""A scenario that takes for ever."""


class Threads(unittest.TestCase):
    def test_ctrl_c_ends_a_long_step_or_run_soon_and_the_session_remains_usable(self):
        session = rn.Session(BUSY, step=1e5)
        for use in (session.step, lambda: rn.run(BUSY)):
            threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
            begun = time.monotonic()
            with self.assertRaises(KeyboardInterrupt):
                use()
            self.assertGreater(time.monotonic() - begun, 0.25)
            self.assertLess(time.monotonic() - begun, 5)  # 0.3 + 0.2 on a quiet machine
        self.assertGreater(session.time, 0)

    def test_other_threads_run_during_a_step_but_may_not_use_its_session(self):
        session = rn.Session(BUSY, step=1e5)
        refused = []

        def ask():
            for use in (session.step, session.reset, lambda: session.time, lambda: session.stop("r0")):
                try:
                    use()
                except rn.RunError as error:
                    refused.append(str(error))
            os.kill(os.getpid(), signal.SIGINT)
        threading.Timer(0.2, ask).start()
        with self.assertRaises(KeyboardInterrupt):
            session.step()
        self.assertEqual(len(refused), 4)
        self.assertIn("in a step", refused[0])

    def test_sessions_in_two_threads_give_the_same_runs_as_one_after_the_other(self):
        def play(seed, found):
            session = rn.Session(ROW, seed=seed)
            for _ in range(5):
                session.reset()
                drive_as_the_controller(session)
            found[seed] = session.fingerprint
        expected, found = {}, {}
        for seed in (1, 2):
            play(seed, expected)
        threads = [threading.Thread(target=play, args=(seed, found)) for seed in (1, 2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, expected)


def resident_kib():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") // 1024


class Leaks(unittest.TestCase):
    def test_ten_thousand_resets_add_less_than_1_mib_of_memory(self):
        session = rn.Session(ROW, records=["received"])
        session.on_record("sent", lambda row: None)

        def play(times):
            for _ in range(times):
                session.reset()
                session.drive(np.ones((3, 2)))
                session.send("B", b"F")
                session.step()
                session.neighbors("A")
        play(2000)
        before = resident_kib()
        play(10000)
        self.assertLess(resident_kib() - before, 1024)


if __name__ == "__main__":
    unittest.main()
