# SPDX-License-Identifier: MIT
"""rovernet.run: scenarios from files and dicts, results, records, errors."""
import json
import threading
import time
import unittest
import warnings

import numpy as np

import rovernet as rn
from scenes import RESCUE, ROW, TREE, FolderTest, command


class Run(FolderTest):
    def test_a_run_has_the_results_that_the_command_prints(self):
        run = rn.run(RESCUE, set={"propagation.model": "friis"}, seed=3)
        code, out, _ = command("run", RESCUE, "--set", "propagation.model=friis", "--seed", 3, "--json",
                               folder=self.folder)
        self.assertEqual(code, 0)
        printed = json.loads(out)
        self.assertEqual(run.fingerprint, printed["fingerprint"])
        self.assertEqual(run.seed, 3)
        self.assertEqual(run.duration, printed["sim_s"])
        for key, value in run.metrics.items():
            self.assertEqual(value, printed[key], key)
        self.assertIsNone(run.folder)
        self.assertEqual(list(self.folder.iterdir()), [self.folder / "runs"])  # the command's

    def test_the_timeline_begins_as_in_the_readme(self):
        first, second = rn.run(RESCUE).timeline[:2]
        self.assertEqual((first["robot"], first["text"]), ("A", "arrives at (29.20, 3.60) m"))
        self.assertEqual(f"{first['t_ns'] / 1e9:.6f}", "9.109388")
        self.assertEqual(second, {"t_ns": 10_000_000_000, "robot": "A", "text": 'says "F"'})

    def test_a_run_with_out_writes_a_folder_that_replay_verifies(self):
        run = rn.run(RESCUE, out=self.folder / "out")
        self.assertEqual(run.folder, str(self.folder / "out"))
        names = {path.name for path in (self.folder / "out").iterdir()}
        self.assertEqual(names, {"scenario.toml", "summary.json", "trace.tr"})
        code, out, _ = command("replay", self.folder / "out" / "trace.tr", "--verify", folder=self.folder)
        self.assertEqual((code, out.split()[0]), (0, "identical:"), out)

    def test_a_dict_gives_the_same_run_as_a_file_with_the_same_tables(self):
        path = self.write("row.toml", """
            [scenario]
            name = "row"
            duration = "2 s"
            [propagation]
            model = "friis"
            [radio]
            sensitivity = "-70 dBm"
            [[robot]]
            name = "A"
            at = ["0 m", "0 m"]
            [[robot]]
            name = "B"
            at = ["150 m", "0 m"]
            [[robot]]
            name = "C"
            at = ["300 m", "0 m"]
            [[traffic]]
            from = "A"
            payload = "tick"
            start = "0.5 s"
            every = "1 s"
            """)
        self.assertEqual(rn.run(ROW).fingerprint, rn.run(path).fingerprint)
        self.assertEqual(rn.run(ROW).fingerprint, rn.run(str(path)).fingerprint)

    def test_numbers_without_a_unit_are_in_si_units(self):
        numbers = rn.run(ROW, set={"radio.power": 0.03, "robot.B.at": [np.float64(140), np.int64(1)]})
        texts = rn.run(ROW, set={"radio.power": "30 mW", "robot.B.at": ["140 m", "1 m"]})
        self.assertEqual(numbers.fingerprint, texts.fingerprint)
        self.assertNotEqual(numbers.fingerprint, rn.run(ROW).fingerprint)

    def test_scalars_and_arrays_of_numpy_count_as_the_values_of_python_that_they_have(self):
        def run(number, at):
            robots = [{"name": "a", "at": at, "radius": number}, {"name": "b", "at": [number, 2]}]
            traffic = [{"from": "a", "payload": "F", "every": 1}]
            return rn.run({"scenario": {"duration": 2}, "robot": robots, "traffic": traffic},
                          set={"robot.a.heading": number})
        expected = run(0.5, [0.0, 0.0]).fingerprint
        for number in (np.float16(0.5), np.float32(0.5), np.float64(0.5), np.longdouble(0.5), np.array(0.5)):
            for at in (np.zeros(2), np.zeros(2, dtype=int), (np.int8(0), np.float32(0))):
                self.assertEqual(run(number, at).fingerprint, expected, (number, at))
        for truth in (True, np.bool_(True)):
            with self.assertRaisesRegex(rn.InputError, r'set\["robot.B.radius"\].*found true'):
                rn.run(ROW, set={"robot.B.radius": truth})
        with self.assertRaisesRegex(rn.InputError, r'set\["robot.B.at"\]'):
            rn.run(ROW, set={"robot.B.at": np.zeros((2, 2))})
        with self.assertRaisesRegex(rn.InputError, r'set\["radio.power"\].*expected a text, a number'):
            rn.run(ROW, set={"radio.power": np.array([object()])[0]})

    def test_progress_gets_the_finished_share_and_an_error_in_it_ends_the_run(self):
        told = []
        rn.run(ROW, progress=told.append)
        self.assertTrue(told and all(0 <= share <= 1 for share in told), told)

        def fail(share):
            raise ZeroDivisionError("enough")
        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            rn.run(ROW, progress=fail, out=self.folder / "out")
        self.assertEqual(list((self.folder / "out").iterdir()), [])

    def test_runs_in_four_threads_give_the_same_results_as_one_after_the_other(self):
        expected = [rn.run(RESCUE, seed=seed).fingerprint for seed in range(4)]
        found = [None] * 4

        def run(seed):
            found[seed] = rn.run(RESCUE, seed=seed).fingerprint
        threads = [threading.Thread(target=run, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, expected)

    def test_warnings_have_the_text_of_the_notices_of_the_command(self):
        path = self.write("w.world", 'position ( name "r" pose [1 1 0] wifi ( model "friis" ) unknown_key 3 )\n')
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            rn.run(path, set={"scenario.duration": 0.01})
        code, _, printed = command("run", path, "--set", "scenario.duration=0.01", folder=self.folder)
        self.assertEqual(code, 0, printed)
        for warning in caught:
            self.assertIn(str(warning.message), printed)


class Records(unittest.TestCase):
    def test_there_are_as_many_records_as_the_metrics_count(self):
        run = rn.run(RESCUE)
        received = run.records("received")
        self.assertEqual(len(received), run.metrics["receptions"])
        self.assertEqual(received["delivered"].sum(), run.metrics["deliveries"])
        self.assertEqual((received["reason"] == "DUP").sum(), run.metrics["drops"]["DUP"])
        self.assertEqual(len(run.records("transmitted")), run.metrics["transmissions"])
        self.assertEqual(len(run.records("sent")), run.metrics["messages"])
        self.assertEqual({run.names[i] for i in received["robot"]}, set("ABCDE"))

    def test_records_kept_in_a_run_equal_those_that_a_repeated_run_returns(self):
        kept = rn.run(RESCUE, records=["received", "moved"])
        for kind in "received", "moved":
            np.testing.assert_array_equal(kept.records(kind), rn.run(RESCUE).records(kind))

    def test_delay_and_level_of_a_frame_follow_the_speed_of_light_and_friis(self):
        """At B, 150 m from A, the level is that of Friis' equation, and the delay is 150 m / c."""
        light = 299_792_458.0  # [m/s]
        scene = {"radio.power": "15 dBm", "medium.propagation_delay": True}
        first = rn.run(ROW, set=scene).records("received")[0]
        at_once = rn.run(ROW, set=scene | {"medium.propagation_delay": False}).records("received")[0]
        self.assertEqual(first["t_ns"] - at_once["t_ns"], round(150 / light * 1e9))
        self.assertAlmostEqual(first["level"], 15 - 20 * np.log10(4 * np.pi * 150 * 2450e6 / light), places=9)

    def test_each_kind_of_record_is_an_array_with_the_expected_columns(self):
        run = rn.run(ROW)
        columns = {
            "sent": "t_ns robot uid to size flow ttl",
            "transmitted": "t_ns robot uid origin heard_from next_hop ttl hops",
            "received": "t_ns robot uid origin sender ttl hops level reason delivered",
            "dropped": "t_ns robot uid origin sender ttl hops reason",
            "moved": "t_ns end_ns robot x y z vx vy vz heading turning",
            "arrived": "t_ns robot",
            "no_way": "t_ns robot x y z",
            "switched": "t_ns robot on",
            "link_up": "t_ns robot sender",
            "link_down": "t_ns robot sender",
            "air_sent": "t_ns robot next_hop kind attempt bytes reserved_ns",
            "control_received": "t_ns robot sender kind bytes reason",
            "routed": "t_ns robot uid origin heard_from next_hop ttl hops",
        }
        for kind, names in columns.items():
            self.assertEqual(run.records(kind).dtype.names, tuple(names.split()), kind)
        self.assertEqual(run.records("air_sent")["kind"].tolist(), ["DATA"] * run.metrics["transmissions"])
        with self.assertRaisesRegex(ValueError, 'no record "recieved".*did you mean "received"'):
            run.records("recieved")
        with self.assertRaisesRegex(ValueError, "no record"):
            rn.run(ROW, records=["x"])


class Errors(FolderTest):
    def test_a_mistake_in_a_file_has_the_message_of_the_command_with_line_and_column(self):
        path = self.write("bad.toml", RESCUE.read_text().replace('"raytrace_2007"', '"raytrace_2070"')
                          .replace('"map.yaml"', f'"{TREE}/examples/rescue/map.yaml"'))
        code, _, printed = command("run", path, folder=self.folder)
        self.assertEqual(code, 3)
        with self.assertRaises(rn.InputError) as raised:
            rn.run(path)
        error = raised.exception
        self.assertEqual(str(error), printed.strip())
        self.assertEqual(error.file, str(path))
        self.assertEqual(path.read_text().splitlines()[error.line - 1][error.column - 1:][:15], '"raytrace_2070"')
        self.assertIn('did you mean "raytrace_2007"?', error.message)
        self.assertIsInstance(error, ValueError)

    def test_the_error_for_a_missing_file_has_no_line(self):
        with self.assertRaises(rn.InputError) as raised:
            rn.run(self.folder / "absent.toml")
        self.assertIsNone(raised.exception.line)
        self.assertEqual(raised.exception.file, str(self.folder / "absent.toml"))

    def test_the_error_for_a_mistake_in_a_dict_names_its_keys(self):
        def place(scenario, **options):
            with self.assertRaises(rn.InputError) as raised:
                rn.run(scenario, **options)
            return raised.exception.file
        robots = [{"name": "A", "at": [0, 0]}]
        self.assertEqual(place({"robot": robots, "radio": {"power": "30 mm"}}), 'scenario["radio"]["power"]')
        self.assertEqual(place({"robot": robots, "radio": {"powr": 1}}), 'scenario["radio"]["powr"]')
        self.assertEqual(place({"robot": [{"name": "A", "at": [0, "x"]}]}), 'scenario["robot"][0]["at"][1]')
        self.assertEqual(place({"robot": robots, "radio": {"power": object}}), 'scenario["radio"]["power"]')
        self.assertEqual(place({"robot": robots, 3: 4}), "scenario")
        self.assertEqual(place({"robot": robots, "x": None}), 'scenario["x"]')
        self.assertEqual(place({"robot": robots}, set={"radio.power": "x"}), 'set["radio.power"]')
        self.assertEqual(place({"robot": robots}, set={"radio.": 1}), 'set["radio."]')
        self.assertEqual(place({"robot": robots}, seed=-1), "argument seed")
        self.assertEqual(place({"robot": robots}, seed=2 ** 80), "argument seed")
        self.assertEqual(place({"robot": 5}), 'scenario["robot"]')
        deep = []
        deep.append(deep)
        self.assertTrue(place({"robot": deep}).startswith('scenario["robot"][0]'))

    def test_arguments_of_a_wrong_type_are_refused(self):
        for bad in (None, 3, [ROW], b"x.toml\0"):
            with self.assertRaises((TypeError, ValueError)):
                rn.run(bad)
        for bad in ([1], {3: 4}, "radio.power=1"):
            with self.assertRaisesRegex(TypeError, "set: expected"):
                rn.run(ROW, set=bad)
        with self.assertRaisesRegex(ValueError, "seed: found \"x\"; expected a whole number"):
            rn.run(ROW, seed="x")

    def test_a_run_beyond_the_event_limit_is_a_run_error(self):
        with self.assertRaisesRegex(rn.RunError, "event"):
            rn.run(ROW, set={"scenario.event_limit": 3})


if __name__ == "__main__":
    unittest.main()
