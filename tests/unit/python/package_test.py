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


def stl_of_box(size) -> str:
    """ASCII, about the origin."""
    corners = [[(-0.5 + (k >> a & 1)) * size[a] for a in range(3)] for k in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    facets = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    text = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex {} {} {}\n".format(*corners[k]) for k in facet) + "endloop\nendfacet\n"
                   for facet in facets)
    return "solid box\n" + text + "endsolid box\n"


class Hydrostatics(unittest.TestCase):
    def afloat(self, size, share, **options):
        """A box with a share of the water's density; the file is in millimetres."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "box.stl")
            file.write_text(stl_of_box([1000 * s for s in size]))
            return splashdown.hydrostatics(file, share * 1000 * math.prod(size), scale=0.001, **options)

    def test_a_box_has_the_draft_and_heights_of_archimedes(self):
        random = np.random.default_rng(3)
        for _ in range(10):
            breadth, height, share = random.uniform(0.5, 1), random.uniform(0.1, 0.15), random.uniform(0.2, 0.8)
            length, heels = 1.5, np.radians([0, 1, 2])
            box = self.afloat([length, breadth, height], share, heels=np.degrees(heels))
            draft = share * height
            gm = breadth**2 / (12 * draft) - 0.5 * (height - draft)
            self.assertTrue(box.floats)
            self.assertAlmostEqual(box.draft, draft, delta=1e-9)
            self.assertAlmostEqual(box.gm_roll, gm, delta=1e-9 * gm)
            self.assertAlmostEqual(box.gm_pitch, length**2 / (12 * draft) - 0.5 * (height - draft), delta=1e-6)
            self.assertAlmostEqual(box.waterplane, length * breadth, delta=1e-9)
            # wall-sided: GZ = sin(phi) (GM + BM tan^2(phi)/2), while deck and bottom stay dry and wet
            gz = np.sin(heels) * (gm + breadth**2 / (24 * draft) * np.tan(heels) ** 2)
            np.testing.assert_allclose(box.levers, gz, atol=1e-9)

    def test_a_low_centre_of_mass_rights_and_lead_sinks(self):
        box = self.afloat([1, 1, 1], 0.5, centre_of_mass=[0, 0, -0.3])
        self.assertAlmostEqual(box.draft, 0.5, delta=1e-9)
        self.assertGreater(box.gm_roll, 0)
        self.assertFalse(self.afloat([1, 1, 1], 1.2).floats)

    def test_mistakes_are_told(self):
        for options, words in (({"mass": -1}, "mass = -1: must be positive"), ({"heels": [10, 5]}, "must rise")):
            with self.assertRaisesRegex(ValueError, words):
                splashdown.hydrostatics(EXAMPLES / "uav_landing" / "uav.stl", **{"mass": 100, **options})
        with self.assertRaisesRegex(ValueError, "nowhere.stl"):
            splashdown.hydrostatics("nowhere.stl", 1)


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
