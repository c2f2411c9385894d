#!/usr/bin/env python3
"""Reports of two runs, a study, a price and an ablation in headless Chromium.

    report_in_browser.py BINARY EXAMPLES

Of each, on wide and narrow screens, light and dark: usable within three seconds, nothing wider than the screen, text that stands out from
its ground, no complaint on the console, no request to the network. Of the runs: a curve's value under the mouse is that of the table,
cursor and replay follow each other, the CSV link has the curve, the replay plays, prints have pictures. Of the study: two runs that are picked
stand side by side. Exit code 77: there is no chromium.
Standard library only."""
import csv
import os
import subprocess
import sys
import tempfile
import time

from devtools import Browser, chromium

SECONDS = 3.0
RUNS = {
    "plane": ["run", "capsule_drop_2d/scene.toml", "--refine", "0.35", "--until", "0.1", "--set", "output.frames=0.01"],
    "space": ["run", "sphere_entry/scene.toml", "--refine", "0.35", "--until", "0.004", "--set", "output.frames=0.0005"],
    "price": ["price", "wedge_drop/scene.toml", "--set", "fluid.size.refine=0.3"],
    "ablation": ["ablate", "wedge_drop/scene.toml", "--set", "fluid.size.refine=0.3"],
}
STUDY = """scene = "{scene}"
title = "A map"
set = ["fluid.size.refine=0.3", "time.end=0.01"]
[[axis]]
name = "speed"
key = "body.wedge.velocity.1"
values = [-5, -6]
[[axis]]
name = "mass"
key = "body.wedge.mass"
values = [200, 300]
[[quantity]]
name = "peak"
quantity = "summary.bodies.wedge.peak_force.value"
unit = "N/m"
"""
READY = "document.readyState === 'complete' && (!document.querySelector('#charts-bytes') || document.documentElement.dataset.charts === 'ready') && " \
        "(!document.querySelector('#replay') || document.querySelector('#replay').dataset.ready === 'yes')"
# Relative luminance and contrast of WCAG 2.1; the lowest contrast of a text on the page with what it says.
CONTRAST = """(() => {
  const numbers = (c) => c.match(/[\\d.]+/g).map(Number).map((v) => (c.startsWith('color(') ? 255 * v : v));
  const light = (c) => numbers(c).slice(0, 3).map((v) => { v /= 255; return v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; }).reduce((s, v, k) => s + v * [0.2126, 0.7152, 0.0722][k], 0);
  const clear = (c) => c === 'rgba(0, 0, 0, 0)' || c === 'transparent';
  let worst = [99, ''];
  for (const e of document.querySelectorAll('h1,h2,p,td,th,figcaption,.tile span,.tile b,.readout span,.readout b,li,code')) {
    if (!e.textContent.trim() || !e.offsetParent) continue;
    let ground = e;
    while (ground && clear(getComputedStyle(ground).backgroundColor)) ground = ground.parentElement;
    const a = light(getComputedStyle(e).color), b = ground ? light(getComputedStyle(ground).backgroundColor) : 1;
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (contrast < worst[0]) worst = [contrast, e.tagName + ': ' + e.textContent.slice(0, 60)];
  }
  return worst;
})()"""
failures = []


def check(what, good, found=""):
    if not good:
        failures.append(what)
        print(f"{what}: {found}")


def check_page(browser, name, page, width, scheme):
    what = f"{name}, {width} px, {scheme}"
    browser.look(width, scheme)
    start = time.monotonic()
    browser.open(page)
    browser.wait_for(f"location.protocol === 'file:' && ({READY})", timeout=120)
    seconds = time.monotonic() - start
    others = max(1, os.getloadavg()[0] / os.cpu_count())  # who wait for the same cores
    check(f"{what}: usable within {SECONDS:g} s", seconds <= SECONDS * others, f"{seconds:.2f} s")
    check(f"{what}: fits", browser.ask("document.documentElement.scrollWidth <= window.innerWidth"), browser.ask("document.documentElement.scrollWidth"))
    contrast, text = browser.ask(CONTRAST)
    check(f"{what}: text stands out", contrast >= 4.5, f"{contrast:.2f}, {text}")
    check(f"{what}: no request", all(url.startswith(("file://" + os.path.abspath(page), "data:", "blob:")) for url in browser.requests), browser.requests)
    check(f"{what}: no complaint", not browser.complaints, browser.complaints)
    print(f"{what}: {seconds:.2f} s, of the main thread {browser.busy_seconds():.2f} s, contrast {contrast:.1f}, {os.path.getsize(page) / 1e6:.1f} MB")


def rows_of(folder, body):
    with open(os.path.join(folder, "bodies.csv"), encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if row["body"] == body]


def interpolated(rows, column, time_at):
    for before, after in zip(rows, rows[1:]):
        t0, t1 = float(before["time"]), float(after["time"])
        if t0 <= time_at <= t1:
            share = (time_at - t0) / (t1 - t0) if t1 > t0 else 0
            return float(before[column]) + share * (float(after[column]) - float(before[column]))
    return float("nan")


def check_curve(browser, name, folder):
    """The value under the mouse, its time on all charts and in the replay, then back."""
    chart = browser.ask("[...document.querySelectorAll('figure.chart')].map((f) => f.dataset.chart).find((n) => n.endsWith('_velocity'))")
    body, figure = chart[len("body_"):-len("_velocity")], f"document.querySelector('figure[data-chart=\"{chart}\"]')"
    axis = "y" if name == "plane" else "z"
    browser.ask(f"{figure}.scrollIntoView({{block: 'center'}})")
    box = browser.ask(f"(({{left, top, width, height}}) => [left, top, width, height])({figure}.querySelector('.plot').getBoundingClientRect())")
    rows = rows_of(folder, body)
    values = [float(row["v" + axis]) for row in rows]
    for share in (0.4, 0.7):
        browser.mouse_to(box[0] + share * box[2], box[1] + 0.5 * box[3])
        browser.wait_for(f"/=/.test({figure}.querySelector('.readout').textContent)")
        seen = browser.ask(f"{figure}.querySelector('.readout').dataset.time")
        value = browser.ask(f"[...{figure}.querySelectorAll('.readout span')].find((s) => s.textContent.startsWith('v_{axis}')).querySelector('b').dataset.value")
        there = interpolated(rows, "v" + axis, float(seen))
        tolerance = (max(values) - min(values)) / 5000 * 1.3 + 1e-6 * max(map(abs, values))  # of what the page leaves out; of its seven digits
        check(f"{name}: the value under the mouse is that of bodies.csv", abs(float(value) - there) <= tolerance, f"{value} at {seen} s, table {there}")
    times = browser.ask("[...document.querySelectorAll('.readout')].map((r) => r.dataset.time).filter((t) => t)")
    check(f"{name}: all charts over time have its cursor", len(set(times)) == 1 and len(times) > 3, times)
    frames = browser.ask("JSON.parse(document.getElementById('replay-info').textContent).frames.map((f) => f.time)")
    at = int(browser.ask("document.getElementById('replay').dataset.frame"))
    check(f"{name}: the replay follows the mouse", abs(frames[at] - float(seen)) <= min(abs(t - float(seen)) for t in frames) + 1e-12, f"{frames[at]}, {seen}")
    browser.ask("(() => { const s = document.querySelector('#replay input[type=range]'); s.value = 1; s.dispatchEvent(new Event('input')); })()")
    now = float(browser.ask(f"{figure}.querySelector('.readout').dataset.time"))
    check(f"{name}: cursors follow the replay", abs(now - frames[1]) <= 1e-6 * frames[-1], f"{now}, {frames[1]}")
    browser.ask("document.querySelector('#replay button').click()")
    browser.wait_for("+document.getElementById('replay').dataset.frame > 2")
    browser.ask("document.querySelector('#replay button').click()")
    table = browser.ask(f"(async () => {{ const a = {figure}.querySelector('a.csv'); a.addEventListener('click', (e) => e.preventDefault()); a.click(); return (await fetch(a.href)).text(); }})()")
    lines = table.strip().split("\n")
    check(f"{name}: the CSV has the curve", f"v_{axis}" in lines[0] and len(lines) > 2, lines[:2])
    browser.look(1200, "light", "print")
    check(f"{name}: prints have the picture", browser.ask(f"getComputedStyle({figure}.querySelector('.still')).display") != "none")


def check_pairs(browser, name, folder):
    """Two boxes ticked in the table of runs: their numbers, the change between them, their links and their curves."""
    browser.wait_for("document.querySelector('#pairs').dataset.pair")
    names = browser.ask("[...document.querySelectorAll('.pick input')].map((b) => b.dataset.run)")
    first, second = names[1], names[2]
    for run in (first, second):
        browser.ask(f"(() => {{ const b = document.querySelector('.pick input[data-run=\"{run}\"]'); if (!b.checked) b.click(); }})()")
    browser.wait_for(f"document.querySelector('#pairs').dataset.pair === '{first} {second}' || document.querySelector('#pairs').dataset.pair === '{second} {first}'")
    check(f"{name}: two boxes are ticked", browser.ask("document.querySelectorAll('.pick input:checked').length") == 2)
    cells = browser.ask("[...[...document.querySelectorAll('#pairs tbody tr')].find((r) => r.cells[0].textContent.startsWith('peak')).cells].map((c) => c.textContent)")
    with open(os.path.join(folder, "study.csv"), encoding="utf-8") as file:
        table = {row["run"]: float(row["peak"]) for row in csv.DictReader(file)}
    order = browser.ask("document.querySelector('#pairs').dataset.pair").split(" ")
    for k, run in enumerate(order):
        check(f"{name}: numbers of a pair are those of study.csv", abs(float(cells[k + 1]) - table[run]) <= 1e-3 * abs(table[run]), f"{cells[k + 1]}, {table[run]}")
    change = 100 * (table[order[1]] - table[order[0]]) / table[order[0]]
    check(f"{name}: the change is that between them", abs(float(cells[3].replace("−", "-").replace(" %", "")) - change) <= 0.01 * abs(change) + 1e-2, f"{cells[3]}, {change}")
    links = browser.ask("[...document.querySelectorAll('#pairs thead a')].map((a) => a.getAttribute('href'))")
    check(f"{name}: a pair leads to its runs", links == [f"./{run}/report.html" for run in order], links)
    check(f"{name}: curves lie over each other", browser.ask("document.querySelectorAll('#pairs .plot canvas').length") > 4)


def make(binary, examples, folder):
    for name, (command, scene, *options) in RUNS.items():
        extra = ["--quiet"] if command == "run" else []
        subprocess.run([binary, command, os.path.join(examples, scene), *options, "--out", os.path.join(folder, name), *extra], check=True, stdout=subprocess.DEVNULL)
    study = os.path.join(folder, "study.toml")
    with open(study, "w", encoding="utf-8") as file:
        file.write(STUDY.format(scene=os.path.join(examples, "wedge_drop", "scene.toml")))
    subprocess.run([binary, "study", study, "--out", os.path.join(folder, "study"), "--quiet"], check=True)


def main():
    binary, examples = sys.argv[1:]
    if not chromium():
        print("skipped: no chromium")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        make(binary, examples, folder)
        with Browser() as browser:
            for name in [*RUNS, "study"]:
                page = os.path.join(folder, name, "report.html")
                for width, scheme in ((1200, "light"), (1200, "dark"), (390, "light"), (390, "dark")):
                    check_page(browser, name, page, width, scheme)
                if name in ("plane", "space"):
                    browser.look(1200, "light")
                    check_curve(browser, name, os.path.join(folder, name))
                if name == "study":
                    browser.look(1200, "light")
                    check_pairs(browser, name, os.path.join(folder, name))
    print(f"{len(failures)} failures")
    sys.exit(len(failures) > 0)


main()
