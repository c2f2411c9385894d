"""Runs that are killed at random instants and continued leave the same tables as runs that nobody killed, byte for byte.

  kill_and_resume.py PATH_OF_SPLASHDOWN KILLS [--seed N]     KILLS: in all, shared by the scenes

Only wall-clock seconds may differ.
"""

import argparse
import csv
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

PLANE = """
[time]
end = {end}
[gravity]
[tank]
min = [-1, -0.6]
max = [1, 0.6]
[fluid]
density = 1000
[fluid.size]
surface = 0.05
far = 0.15
[[fluid.region]]
shape = "box"
min = [-1, -0.6]
max = [1, 0]
[output]
checkpoint = 0.03
[[record]]
kind = "surface_elevation"
name = "gauge"
x = 0.8
"""

SCENES = {
    # Two light boxes side by side in the water, one pushed against the other.
    "contact in the plane": PLANE.format(end=0.15) + """
[contact]
[[body]]
name = "left"
shape = { type = "box", width = 0.3, height = 0.2 }
density = 300
position = [-0.2, 0.03]
velocity = [2, 0]
size = 0.04
[[body]]
name = "right"
shape = { type = "box", width = 0.3, height = 0.2 }
density = 300
position = [0.2, 0.03]
size = 0.04
""",
    # Bodies and fluid in turns, with what an accelerator remembers.
    "in turns in the plane": PLANE.format(end=0.06) + """
[coupling]
interface_term = "laplacian"
accelerator = "iqn_ils"
reuse = 4
[[body]]
name = "wedge"
mass = 60
position = [0, 0.02]
velocity = [0, -3]
pitch_deg = 5
size = 0.03
shape = { type = "wedge", deadrise_deg = 30, breadth = 0.4, height = 0.2 }
""",
    "in space": """
dimension = 3
[time]
end = 0.1
[gravity]
[tank]
min = [-0.6, -0.6, -0.4]
max = [0.6, 0.6, 0.4]
[fluid]
density = 1000
[fluid.size]
surface = 0.12
far = 0.2
[[fluid.region]]
shape = "box"
min = [-0.6, -0.6, -0.4]
max = [0.6, 0.6, 0]
[[body]]
name = "ball"
shape = { type = "sphere", radius = 0.15 }
density = 300
position = [0, 0, 0.14]
velocity = [1, 0, -2]
spin_deg = [0, 300, 0]
size = 0.08
[output]
checkpoint = 0.05
""",
}


def tables(folder):
    """Every table without the column that no two runs share."""
    content = {}
    for file in sorted(folder.glob("*.csv")):
        rows = list(csv.reader(file.open(newline="")))
        keep = [i for i, name in enumerate(rows[0]) if name != "wall_seconds"]
        content[file.name] = [[row[i] for i in keep] for row in rows]
    return content


def finish(command):
    """Wall seconds of the run."""
    begin = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        raise RuntimeError(f"exit code {done.returncode}: {' '.join(map(str, command))}\n{done.stderr[-500:]}")
    return time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("kills", type=int)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = random.Random(options.seed)
    failures = 0
    with tempfile.TemporaryDirectory() as work:
        for number, (name, text) in enumerate(SCENES.items()):
            scene = pathlib.Path(work, f"scene_{number}.toml")
            scene.write_text(text)
            run = [options.program, "run", scene, "--quiet", "--threads", "1", "--out"]
            whole = pathlib.Path(work, f"whole_{number}")
            seconds = finish([*run, whole])
            expected = tables(whole)
            kills = options.kills // len(SCENES) + (number < options.kills % len(SCENES))
            killed = runs = resumed = 0
            while killed < kills:
                # Up to eight kills a run; every run ends on its own at last.
                folder = pathlib.Path(work, f"killed_{number}_{runs}")
                for _ in range(min(kills - killed, rng.randrange(1, 9))):
                    process = subprocess.Popen([*run, folder, "--resume"], stdout=subprocess.DEVNULL,
                                               stderr=subprocess.DEVNULL)
                    time.sleep(rng.uniform(0, 0.8 * seconds))
                    process.send_signal(signal.SIGKILL)
                    killed += process.wait() == -signal.SIGKILL
                    resumed += (folder / "checkpoint" / "state").exists()
                    if process.returncode == 0:
                        break  # it was faster
                finish([*run, folder, "--resume"])
                runs += 1
                found = tables(folder)
                if found != expected:
                    failures += 1
                    for file in sorted(expected.keys() | found.keys()):
                        if expected.get(file) != found.get(file):
                            print(f"FAIL  {name}: {file} of run {runs} differs (seed {options.seed})")
            print(f"{name}: {killed} kills in {runs} runs of {seconds:.1f} s, {resumed} of them behind a checkpoint", flush=True)
            if kills > 20 and not resumed:
                failures += 1
                print(f"FAIL  {name}: no kill came behind a checkpoint: the run is too short for this machine")
    print(f"{failures} failures")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
