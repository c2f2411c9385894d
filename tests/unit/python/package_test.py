#!/usr/bin/env python3
"""The Python package: what the command does comes out, step by step and as a whole; mistakes are told in its words.

    package_test.py EXAMPLES"""
import math
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import splashdown

EXAMPLES = Path(sys.argv.pop())
COMMAND = Path(splashdown.__file__).with_name("splashdown")

DROP = {
    "time": {"end": 0.01},
    "gravity": {},
    "tank": {"min": [-1, -0.5], "max": [1, 0.6]},
    "fluid": {"density": 1000, "size": {"surface": 0.04, "far": 0.1}, "region": [{"shape": "box", "min": [-1, -0.5], "max": [1, 0]}]},
    "body": [{"name": "wedge", "shape": {"type": "wedge", "deadrise_deg": 30, "breadth": 0.4}, "density": 300, "position": [0, 0.005],
              "velocity": [0, -4], "size": 0.02}],
}
STONE = {"time": {"end": 1, "dt_max": 0.01}, "gravity": {}, "body": [{"name": "stone", "shape": {"type": "circle", "radius": 0.1}, "mass": 2,
                                                                     "velocity": [3, 4]}]}


class Steps(unittest.TestCase):
    def test_a_loop_sees_what_the_command_writes_bit_for_bit(self):
        result = splashdown.run(DROP, report=False, threads=1)
        table = result.table("bodies", body="wedge")
        rows = []
        for now in splashdown.Simulation.of_text(splashdown.scene_text(DROP)):
            wedge = now.bodies["wedge"]
            rows.append([now.time, *wedge.position[:2], *wedge.velocity[:2], *wedge.force[:2]])
        columns = np.array(rows).T
        for column, values in zip(("time", "x", "y", "vx", "vy", "fx", "fy"), columns):
            np.testing.assert_array_equal(table[column], values, column)

    def test_the_water_is_arrays_that_stay(self):
        simulation = splashdown.Simulation.of_text(splashdown.scene_text(DROP))
        self.assertTrue(simulation.advance())
        water = simulation.water
        kept = water["positions"].copy()
        while simulation.advance():
            pass
        np.testing.assert_array_equal(kept, water["positions"])
        x, cells = water["positions"], water["cells"]
        a, b, c = (x[cells[:, k]] for k in range(3))
        area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
        self.assertTrue((area > 0).all())
        self.assertAlmostEqual(area.sum(), water["volume"], delta=1e-12)
        self.assertEqual(set(np.unique(water["walls"])), {-1, 1})  # the wedge, wall 0, is dry at the start

    def test_pushes_and_paths_are_python(self):
        simulation = splashdown.Simulation.of_text(
            splashdown.scene_text(STONE), forces={"stone": lambda time, body: ([0, 2 * 9.81, 0], [0, 0, 0])})
        self.assertTrue(simulation.advance_to(1))
        np.testing.assert_allclose(simulation.bodies["stone"].position, [3, 4, 0], atol=1e-12)
        led = {**STONE, "body": [{"name": "stone", "shape": STONE["body"][0]["shape"], "motion": "prescribed"}]}
        simulation = splashdown.Simulation.of_text(splashdown.scene_text(led), paths={"stone": lambda t: ([math.sin(t), 0, 0], np.eye(3))})
        self.assertTrue(simulation.advance_to(1))
        self.assertAlmostEqual(simulation.bodies["stone"].position[0], math.sin(1), delta=1e-12)

    def test_what_a_callback_raises_comes_out(self):
        def broken(time, body):
            raise ZeroDivisionError("my mistake")

        simulation = splashdown.Simulation.of_text(splashdown.scene_text(STONE), forces={"stone": broken})
        with self.assertRaises(Exception) as raised:
            simulation.advance()
        self.assertIn("my mistake", str(raised.exception))

    def test_other_threads_go_on_meanwhile(self):
        ticks, stop = [], threading.Event()

        def tick():
            while not stop.is_set():
                ticks.append(time.perf_counter())
                time.sleep(0.001)

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.perf_counter()
        splashdown.Simulation.of_text(splashdown.scene_text(DROP)).advance_to(0.01)
        end = time.perf_counter()
        stop.set()
        thread.join()
        self.assertGreater(sum(begin < t < end for t in ticks), 3)

    def test_a_state_is_gone_back_to(self):
        with tempfile.TemporaryDirectory() as folder:
            simulation = splashdown.Simulation.of_text(splashdown.scene_text(DROP))
            for _ in range(4):
                simulation.advance()
            simulation.save(folder)
            at = simulation.time
            simulation.advance_to(0.01)
            last = simulation.bodies["wedge"].position
            simulation.restore(folder)
            self.assertEqual(simulation.time, at)
            simulation.advance_to(0.01)
            np.testing.assert_array_equal(last, simulation.bodies["wedge"].position)


class Runs(unittest.TestCase):
    def test_a_file_an_override_and_tables(self):
        result = splashdown.run(EXAMPLES / "floating_box" / "scene.toml", set={"time.end": 0.05}, report=False)
        self.assertEqual(result.status, "done")
        self.assertIn("bodies", result.tables)
        self.assertAlmostEqual(result.table("fluid")["time"][-1], 0.05)
        with self.assertRaises(KeyError):
            result.table("bodies", bdoy="box")
        with self.assertRaises(FileNotFoundError):
            result.table("loads")

    def test_a_wrong_scene_is_told_as_the_command_tells_it(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "scene.toml"
            file.write_text(splashdown.scene_text(DROP).replace('"wedge", deadrise_deg', '"wegde", deadrise_deg'))
            told = subprocess.run([COMMAND, "check", file], capture_output=True, text=True, check=False).stderr
            for call in (splashdown.check, splashdown.run, splashdown.Simulation.open):
                with self.assertRaises(splashdown.SceneError) as raised:
                    call(file)
                self.assertEqual(str(raised.exception).strip(), told.replace("error: ", "").strip())

    def test_a_folder_without_a_run_says_so(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(FileNotFoundError) as raised:
            splashdown.Result(folder)
        self.assertIn("there is no run", str(raised.exception))

    def test_scenes_of_numpy_numbers_are_written(self):
        self.assertEqual(splashdown.scene_text({"a": {"b": np.float64(0.5), "c": np.arange(2), "d": True, "e f": "\"q\""}}),
                         'a = {b = 0.5, c = [0, 1], d = true, "e f" = "\\"q\\""}')


if __name__ == "__main__":
    unittest.main()
