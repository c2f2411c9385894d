"""`splashdown check` under damaged scenes: it ends within 10 s and 1 GB, with exit code 0 or 2, whatever the scene says.

  mutate_scenes.py PATH_OF_SPLASHDOWN FOLDER_OF_EXAMPLES COUNT [--seed N] [--first K] [--jobs N] [--keep FOLDER]

Scene K of a seed is always the same, so a failure is repeated by its number: --first K with a COUNT of 1 and --keep.
"""

import argparse
import concurrent.futures
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SECONDS, BYTES = 10, 2**30  # of processor time, which a busy machine does not stretch, and of memory
PATIENCE = 300  # seconds on the clock: for what waits and does not work
TOKEN = re.compile(r'"[^"\n]*"|[A-Za-z_][A-Za-z_0-9.]*|-?\d[\d.eE+-]*|[\[\]{}=,]|\s+|.')
NUMBER = re.compile(r"(?<![A-Za-z_0-9.])-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?(?![A-Za-z_0-9])")
EXTREMES = ("0", "-1", "1e-308", "1e308", "-1e308", "1e9", "1e-9", "inf", "nan", "9007199254740993", "99999999999999999999",
            "2147483648", "-0.0", "0x10", "1_0", "1e400", "true", "3", '"a"', "[]", "{}", "1979-05-27")


def number(rng, text):
    """A mistake of the kind that people make: units, a lost or an added digit, a sign; or no number that fits."""
    if rng.random() < 0.35:
        return rng.choice(EXTREMES)
    value = float(text)
    factor = rng.choice((1000, 0.001, 100, 0.01, 10, 0.1, -1, 2, 0.5, 57.29577951308232, 0, 1e6, 1e-6, 1 + 1e-12))
    return repr(value * factor)


def swapped_number(rng, text):
    places = list(NUMBER.finditer(text))
    if not places:
        return text
    at = rng.choice(places)
    return text[: at.start()] + number(rng, at.group()) + text[at.end() :]


def swapped_tokens(rng, text):
    tokens = TOKEN.findall(text)
    words = [i for i, token in enumerate(tokens) if not token.isspace()]
    a, b = rng.choice(words), rng.choice(words)
    action = rng.randrange(3)
    if action == 0:
        tokens[a], tokens[b] = tokens[b], tokens[a]
    elif action == 1:
        tokens[a] = tokens[b]
    else:
        del tokens[a]
    return "".join(tokens)


def moved_line(rng, text):
    lines = text.splitlines(True)
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    action = rng.randrange(3)
    if action == 0:
        lines.insert(b, lines.pop(a))
    elif action == 1:
        lines.insert(b, lines[a])
    else:
        del lines[a]
    return "".join(lines)


def flipped_bytes(rng, text):
    data = bytearray(text.encode())
    for _ in range(rng.choice((1, 1, 2, 8))):
        data[rng.randrange(len(data))] = rng.randrange(256)
    return data.decode("latin-1")


def mutated(rng, text):
    actions = (swapped_number,) * 5 + (swapped_tokens,) * 3 + (moved_line,) * 2 + (flipped_bytes,) * 2
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        text = rng.choice(actions)(rng, text) or "x"
    return text


def unlimited():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def limited():
    # Far above what is allowed: it protects the machine, the peak is judged afterwards.
    resource.setrlimit(resource.RLIMIT_AS, (8 * BYTES, 8 * BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (3 * SECONDS, 3 * SECONDS))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def try_scene(program, scene, instrumented):
    """What is wrong with the program's answer; nothing if all is well."""
    with tempfile.TemporaryFile() as out:
        begin = time.monotonic()
        process = subprocess.Popen([program, "check", scene], stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                   preexec_fn=unlimited if instrumented else limited)
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - begin > PATIENCE:
                process.send_signal(signal.SIGKILL)
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = 0
                return f"still there after {PATIENCE} s"
            time.sleep(0.002)
        process.returncode = code = os.waitstatus_to_exitcode(status)
        out.seek(0)
        said = out.read().decode("utf-8", "replace")
    spent, peak = usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024  # CPU: the machine may be busy
    if spent >= 3 * SECONDS and not instrumented:
        return f"still at work after {spent:.0f} s"
    if code not in (0, 2):
        return f"exit code {code}: {said[-300:].strip()}"
    if code == 2 and "error" not in said:
        return "exit code 2 without an error"
    if instrumented:
        return ""
    if spent > SECONDS:
        return f"{spent:.1f} s"
    if peak > BYTES:
        return f"{peak / BYTES:.2f} GB"
    return ""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("examples", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--instrumented", action="store_true",
                        help="a program with sanitizers: what it takes of time and memory is not judged")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for scenes that failed")
    options = parser.parse_args()

    scenes = sorted(options.examples.glob("*/scene*.toml"))
    with tempfile.TemporaryDirectory() as work:
        for example in {scene.parent for scene in scenes}:  # hulls stand beside their scenes
            folder = pathlib.Path(work, example.name)
            folder.mkdir()
            for hull in (*example.glob("*.stl"), *example.glob("*.obj")):
                shutil.copy(hull, folder)

        def one(k):
            rng = random.Random(f"{options.seed}.{k}")
            origin = rng.choice(scenes)
            scene = pathlib.Path(work, origin.parent.name, f"{k}.toml")
            scene.write_text(mutated(rng, origin.read_text()), encoding="utf-8" if rng.random() < 0.9 else "latin-1",
                             errors="replace", newline="")
            wrong = try_scene(options.program, scene, options.instrumented)
            if options.keep and (wrong or options.count == 1):
                options.keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(scene, options.keep / f"{options.seed}_{k}.toml")
            scene.unlink()
            return k, origin, wrong

        failures = 0
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for k, origin, wrong in pool.map(one, range(options.first, options.first + options.count)):
                if wrong:
                    failures += 1
                    print(f"FAIL  seed {options.seed}, scene {k}, from {origin.parent.name}/{origin.name}: {wrong}", flush=True)
    print(f"{options.count} scenes, {failures} failures")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
