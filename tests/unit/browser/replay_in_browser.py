#!/usr/bin/env python3
"""Opens the reports of runs in headless Chromium: the replay is there, steps to another frame, and asks for nothing from outside.

    replay_in_browser.py BINARY EXAMPLES

Exit code 77: there is no chromium. Standard library only."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

RUNS = {
    "plane": ["capsule_drop_2d", "--refine", "0.35", "--until", "0.1", "--set", "output.frames=0.01"],
    "bent": ["elastic_gate", "--set", "fluid.size.refine=0.4", "--until", "0.05", "--set", "output.frames=0.01"],
    "space": ["sphere_entry", "--refine", "0.35", "--until", "0.004", "--set", "output.frames=0.0005"],
}
# Appended to the page: what a reader does, and what the page has asked for.
PROBE = """<script>
window.addEventListener('error', (e) => { document.title = 'error: ' + e.message; });
const wait = setInterval(() => {
  const holder = document.getElementById('replay');
  if (holder.dataset.ready !== 'yes') return;
  clearInterval(wait);
  const slider = holder.querySelector('input[type=range]');
  slider.value = 1;
  slider.dispatchEvent(new Event('input'));
  holder.querySelector('.mesh').click();
  const pixels = holder.querySelector('canvas').getContext('webgl') || holder.querySelector('canvas').getContext('webgl2');
  holder.dataset.asked = performance.getEntriesByType('resource').length;
  holder.dataset.wide = document.documentElement.scrollWidth <= window.innerWidth ? 'fits' : 'too wide';
  holder.dataset.drawn = pixels ? 'yes' : 'no';
}, 50);
</script>"""


def main():
    binary, examples = sys.argv[1:]
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if not chromium:
        print("skipped: no chromium")
        sys.exit(77)
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, (example, *options) in RUNS.items():
            out = os.path.join(folder, name)
            subprocess.run([binary, "run", os.path.join(examples, example, "scene.toml"), *options, "--out", out, "--quiet"], check=True)
            page = os.path.join(out, "report.html")
            with open(page, "a", encoding="utf-8") as file:
                file.write(PROBE)
            for width in (1200, 390):
                done = subprocess.run([chromium, "--headless", "--no-sandbox", "--use-gl=swiftshader", "--enable-unsafe-swiftshader", "--virtual-time-budget=15000",
                                       f"--window-size={width},1400", f"--user-data-dir={folder}/profile", "--dump-dom", "file://" + page],
                                      capture_output=True, text=True, timeout=120, check=False)
                figure = re.search(r'<figure id="replay"[^>]*>', done.stdout)
                found = dict(re.findall(r'data-([a-z]+)="([^"]*)"', figure.group(0))) if figure else {}
                wanted = {"ready": "yes", "frame": "1", "asked": "0", "drawn": "yes", "wide": "fits"}
                wrong = {key: found.get(key) for key, value in wanted.items() if found.get(key) != value}
                title = re.search(r"<title>(.*?)</title>", done.stdout)
                if wrong or not title or title.group(1).startswith("error"):
                    failures += 1
                    print(f"{name}, {width} px: {wrong}, title {title and title.group(1)}")
    print(f"{failures} failures")
    sys.exit(failures > 0)


main()
