#!/usr/bin/env python3
"""Renders stills and a film of a cheap run in space and of one in the plane, without a display: sizes, pixels, number of frames, and
what an interrupt leaves.

    render_in_browser.py BINARY EXAMPLES

Exit code 77: there is no chromium or no ffmpeg. Standard library only, ffprobe beside ffmpeg."""
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib

RUNS = {
    "plane": ["capsule_drop_2d", "--refine", "0.35", "--until", "0.1", "--set", "output.frames=0.01"],
    "space": ["sphere_entry", "--refine", "0.35", "--until", "0.004", "--set", "output.frames=0.0005"],
    "half": ["sphere_entry", "--refine", "0.35", "--until", "0.002", "--set", "output.frames=0.0005", "--set", "symmetry={}"],
}
failures = 0


def check(what, holds):
    global failures
    failures += not holds
    print("ok   " if holds else "FAIL ", what)


def pixels_of(path):
    """Width, height, rows of bytes; PNG specification, 8 bits a channel."""
    with open(path, "rb") as file:
        data = file.read()
    at, header, packed = 8, None, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", data[at + 8:at + 8 + size])
        elif kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += size + 12
    width, height, _, colour = header[:4]
    channels = {2: 3, 6: 4}[colour]
    raw, line, rows, before = zlib.decompress(packed), width * channels, [], bytearray(width * channels)
    for y in range(height):
        row = bytearray(raw[y * (line + 1) + 1:(y + 1) * (line + 1)])
        for i in range(line):
            left, up = row[i - channels] if i >= channels else 0, before[i]
            corner = before[i - channels] if i >= channels else 0
            guess = left + up - corner
            paeth = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            row[i] = (row[i] + (0, left, up, (left + up) // 2, paeth)[raw[y * (line + 1)]]) & 255
        rows.append(bytes(row))
        before = row
    return width, height, channels, rows


def colours_of(path):
    width, _, channels, rows = pixels_of(path)
    return {row[i * channels:i * channels + 3] for row in rows for i in range(width)}


def frames_of(path):
    text = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries", "stream=width,height,nb_read_frames,r_frame_rate",
                           "-of", "default=noprint_wrappers=1", path], capture_output=True, text=True, check=True).stdout
    return dict(line.split("=") for line in text.split())


def main():
    binary, examples = sys.argv[1:]
    if not (shutil.which("chromium") or shutil.which("chromium-browser")) or not shutil.which("ffmpeg"):
        print("skipped: no chromium or no ffmpeg")
        sys.exit(77)
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}

    def render(*words):
        return subprocess.run([binary, "render", *words], capture_output=True, text=True, timeout=300, check=False, env=environment)

    with tempfile.TemporaryDirectory() as folder:
        for name, (example, *options) in RUNS.items():
            out = os.path.join(folder, name)
            subprocess.run([binary, "run", os.path.join(examples, example, "scene.toml"), *options, "--out", out, "--quiet", "--no-report"], check=True)
            view = [] if name == "plane" else ["--view", "below", "--so-far"]
            end = next(option for option, before in zip(options[1:], options) if before == "--until")
            stills = []
            for t in ("0", end):
                still = os.path.join(folder, f"{name}_{t}.png")
                done = render(out, "--time", t, "-o", still, "--size", "400x300", *view)
                check(f"{name}: a still at {t} s", done.returncode == 0 and f"{still}: 400x300" in done.stdout)
                if done.returncode:
                    print(done.stdout, done.stderr)
                    continue
                width, height, _, rows = pixels_of(still)
                check(f"{name}: of the size asked for", (width, height) == (400, 300))
                check(f"{name}: of many colours", len(colours_of(still)) > 200)
                stills.append(rows)
            check(f"{name}: times look different", len(stills) == 2 and stills[0] != stills[1])
        out, film = os.path.join(folder, "space"), os.path.join(folder, "f.mp4")
        listed = open(os.path.join(out, "frames.pvd"), encoding="utf-8").read().count('name="fluid"')
        done = render(out, "--movie", film, "--fps", "8", "--size", "320x240")
        found = frames_of(film) if done.returncode == 0 else done.stderr
        check(f"a film of all {listed} frames: {found}", found == {"width": "320", "height": "240", "r_frame_rate": "8/1", "nb_read_frames": str(listed)})
        before = sorted(os.listdir(folder))
        other = os.path.join(folder, "interrupted.mp4")
        process = subprocess.Popen([binary, "render", out, "--movie", other, "--size", "1280x720", "--quiet"], env=environment, stderr=subprocess.PIPE, text=True)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[1]
        check(f"an interrupt ends it: {process.returncode}, {said!r}", process.returncode == 130 and "interrupted.mp4 is not written" in said)
        check("and leaves no part of the film", sorted(os.listdir(folder)) == before)
    print(f"{failures} failures")
    sys.exit(failures > 0)


main()
