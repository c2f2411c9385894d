#!/usr/bin/env python3
"""Makes docs/gallery.md and its pictures: runs each example's scene and keeps one picture of its report.

    docs/gallery.py build/release/splashdown            all cases; a run that is finished is not repeated
    docs/gallery.py build/release/splashdown wedge_drop these cases only
    docs/gallery.py --page                              the page alone, of the READMEs and the pictures that are there
    docs/gallery.py --print                             the same to the terminal
    docs/gallery.py --list                              what would be run, and its seconds

Questions and captions are those of the examples' READMEs. Runs go to out/gallery/. Tools: gnuplot, rsvg-convert, pngquant
(packages gnuplot-nox, librsvg2-bin, pngquant).
"""
import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True  # beside the tests
sys.path.insert(0, os.path.join(ROOT, "tests/docs"))
from readme import Readme  # noqa: E402

PICTURES = "docs/images/gallery"
WIDTH, COLOURS = 800, 64  # of a picture: pixels; entries of its palette


@dataclass
class Case:
    name: str  # of the example
    arguments: str  # behind "splashdown run examples/NAME/"
    picture: str  # "end", "peak": a field of the report; else the name of one of its curves, or lines of gnuplot
    seconds: int  # on one core of 2.5 GHz
    crop: tuple = None  # of a field: x from, x to, y from, y to [m]; not wider than the report's view


# Of the run's tables, where the report has no such curve: lines of gnuplot.
ADDED_MASS = r"""
set xlabel 'pitch / degrees'; set xrange [0:360]; set xtics 90; set yrange [0:900]
set ylabel 'added mass in body axes'
plot 'added_mass.csv' using ($1*90):3 with points ls 1 title 'm_xx / (kg/m)', \
  '' using ($1*90):6 with points ls 2 title 'm_yy / (kg/m)', \
  '' using ($1*90):8 with points ls 3 title 'm_rr / (kg m)', \
  125.66 with lines ls 4 title 'Lamb', 785.4 with lines ls 4 notitle, 17.318 with lines ls 4 notitle
"""
IMPULSE = r"""
set xlabel 'x / m'; set ylabel 'impulse / (Pa s)'; set yrange [0:300]; set samples 1001
stats 'fluid.csv' using 2 every ::0::0 nooutput
kick = STATS_min/2
plot 'surface_pressure.csv' using ($1 == 0 ? $3 : NaN):(($6 + $9)*kick) with points ls 1 title '(p + p_repair) times the kick', \
  [-0.5:0.5] 500*sqrt(0.25 - x**2) with lines ls 4 title 'theory'
"""
TENSION = r"""
set xlabel 'time / s'; set ylabel 'tension of the riser / (N/m)'; set yrange [0:700]
plot 'forces.csv' using 1:2 with points ls 1 notitle, 588.6 with lines ls 4 title 'weight'
"""
SPEED = r"""
set xlabel 'time / s'; set ylabel 'speed / (m/s)'
plot 'bodies.csv' using 1:(-$11) with lines ls 1 title 'with form drag', 1.13 with lines ls 4 title 'drag = weight in water'
"""
CYLINDER_DRAG = r"""
set xlabel 'U t / R'; set ylabel 'C_D'; set xrange [0.05:3]; set yrange [0:2]
plot 'bodies.csv' using 1:22 with lines ls 1 title '50 squares across', \
  '../../../examples/impulsive_cylinder/reference.csv' using 1:2 with points ls 4 pt 6 title 'Koumoutsakos & Leonard'
"""
CYLINDER_FORCE = r"""
set xlabel 't / T'; set ylabel 'F / (rho U_m^2 D)'; set xrange [0:1]; set yrange [-2.2:2.2]
plot 'bodies.csv' using ($1/5 - 3):22 with lines ls 1 title '16 squares across', \
  '../../../examples/oscillating_cylinder/reference.csv' using 1:2 with points ls 4 pt 6 title 'Duetsch et al.'
"""
WAKE_LOADS = r"""
set xlabel 't U / D'; set ylabel 'C_D, C_L'; set xrange [0:80]; set yrange [-0.6:2]
plot 'bodies.csv' using 1:(2*$22) with lines ls 1 title 'C_D', '' using 1:(2*$23) with lines ls 2 title 'C_L', \
  1.325 with lines ls 4 title 'C_D of others'
"""
FOIL_LOADS = r"""
set xlabel 't f'; set ylabel 'C_Y, C_X'; set xrange [2:3]; set yrange [-4:6]
plot 'bodies.csv' using ($1*0.14):(2*$23) with lines ls 1 title 'C_Y', '' using ($1*0.14):(2*$22) with lines ls 2 title 'C_X', \
  'fluid.csv' using (column("time")*0.14):(2*column("control_fy_foil")) every 20 with points ls 4 pt 6 title 'C_Y by a control volume'
"""
SINKING = r"""
set xlabel 'time / s'; set ylabel 'speed / (m/s)'
plot 'bodies.csv' using 1:(-$11) with lines ls 1 title '16 squares across', \
  '../../../examples/sedimenting_cylinder/reference.csv' using 1:2 with points ls 4 pt 6 title 'finite elements'
"""
FLIGHT = r"""
set xlabel 'x / m'; set ylabel 'y / m'
plot 'bodies.csv' using 3:4 with lines ls 1 title 'centre of the plate'
"""
RISING = r"""
set xlabel 'time / s'; set ylabel 'force / (N/m)'; set yrange [0:16]
plot 'bodies.csv' using 1:22 with lines ls 1 title 'drag', '' using 1:(10*$23) with lines ls 2 title 'lift times 10', \
  14.29 with lines ls 4 title 'reference', 11.19 with lines ls 4 notitle
"""
SWING = r"""
set xlabel 'time / s'; set ylabel 'displacement of the tip / mm'; set xrange [0:2]; set yrange [-145:5]
plot "< grep ',A.uy,' probes.csv" using 1:(1000*$3) with lines ls 1 title 'u_y', "< grep ',A.ux,' probes.csv" using 1:(1000*$3) with lines ls 2 title 'u_x', \
  -66.10 with lines ls 4 title 'u_y at rest (CSM1)'
"""
GATE = r"""
set xlabel 'time / s'; set ylabel 'displacement of the end / mm'; set xrange [0:0.4]; set yrange [0:50]
plot "< grep ',end.ux,' probes.csv" using 1:(1000*$3) with lines ls 1 title 'downstream', \
  "< grep ',end.uy,' probes.csv" using 1:(1000*$3) with lines ls 2 title 'upwards', \
  "< grep '^x,' ../../../examples/elastic_gate/reference.csv" using 2:(1000*$3) with points ls 4 title 'measured', \
  "< grep '^y,' ../../../examples/elastic_gate/reference.csv" using 2:(1000*$3) with points ls 4 notitle
"""
DEFLECTED = r"""
set xlabel 'time / ms'; set ylabel 'deflection of the middle / mm'; set xrange [0:2.2]; set yrange [0:12]
plot "< grep ',right.uy,' probes.csv" using (1000*$1):(1000*($3+30*$1)/0.984808) with lines ls 1 title 'computed', \
  "< grep '^scolan_analytical,wB' ../../../examples/elastic_wedge/reference.csv" using (1000*$3):(1000*$4) with lines ls 4 title 'Scolan', \
  "< grep '^fourey2010_sph_fem,wB' ../../../examples/elastic_wedge/reference.csv" using (1000*$3):(1000*$4) with points ls 2 title 'Fourey', \
  "< grep '^li2015_sph_fem,wB' ../../../examples/elastic_wedge/reference.csv" using (1000*$3):(1000*$4) with points ls 3 title 'Li'
"""
STRUCK = r"""
set xlabel 'time / ms'; set ylabel 'deflection of the middle / mm'; set xrange [0:4]; set yrange [0:2.5]
plot "< grep ',middle.uy,' probes.csv" using (1000*$1):(1000*($3+$1)) with lines ls 1 title 'computed', \
  '../../../examples/elastic_plate/reference.csv' using (1000*$1):(1000*$2) with lines ls 4 title 'linear theory'
"""
LIFTED = r"""
set xlabel 'time / s'; set ylabel 'displacement of the tip / mm'; set xrange [0:8]; set yrange [-0.4:1]
plot "< grep ',A.uy,' probes.csv" using 1:(1000*$3) with lines ls 1 title 'u_y', 0.8208773 with lines ls 4 title 'at rest, Featflow'
"""
PACKET = r"""
set xlabel 'time / microseconds'; set ylabel 'velocity / (micrometres/s)'; set xrange [0:80]
plot "< grep ',near.vy,' probes.csv" using (1e6*$1):(1e6*$3) with lines ls 1 title '30 mm from the end', \
  "< grep ',far.vy,' probes.csv" using (1e6*$1):(1e6*$3) with lines ls 2 title '80 mm'
"""
PIEZO = r"""
set xlabel 'time / microseconds'; set ylabel 'deflection / micrometres'; set xrange [0:560]
plot "< grep ',top_05.uy,' probes.csv" using (1e6*$1):(1e6*$3) with lines ls 1 title '45 mm from the piezos', \
  "< grep ',top_20.uy,' probes.csv" using (1e6*$1):(1e6*$3) with lines ls 2 title '137 mm', \
  "< grep ',top_35.uy,' probes.csv" using (1e6*$1):(1e6*$3) with lines ls 3 title '229 mm'
"""
STYLE = r"""
set datafile separator ','; set datafile columnheaders; set output 'picture.svg'
set terminal svg size 640,340 noenhanced font 'Helvetica,15'
set border 3 lc rgb '#8796a5'; set tics nomirror; set grid lt 1 lc rgb '#e3e8ed'; set key outside top center horizontal
set style line 1 pt 7 ps 0.4 lc rgb '#0f2f4f'
set style line 2 pt 7 ps 0.4 lc rgb '#2f7fc1'
set style line 3 pt 7 ps 0.4 lc rgb '#7b5ea7'
set style line 4 lt 1 lw 1.5 lc rgb '#d98e04'
"""

CASES = [
    Case("wedge_drop", "scene.toml", "peak", 4),
    Case("wedge_drop_yettou", "scene.toml --until 0.015", "end", 3, (-1.3, 1.3, -0.9, 0.4)),
    Case("light_wedge", "scene.toml --until 0.0042", "end", 3, (-0.3, 0.3, -0.2, 0.3)),
    Case("wedge_entry", "scene.toml --set body.wedge.shape.breadth=2.4", "end", 4),
    Case("cone_entry", "scene_45.toml --refine 0.5 --set body.cone.shape.radius=1", "end", 15, (-2, 2, -1.6, 0.9)),
    Case("circle_entry", "scene.toml", "end", 13),
    Case("sphere_entry", "scene.toml --refine draft", "end", 100, (-1.8, 1.8, -1.4, 1.2)),
    Case("flat_plate_impact", "scene.toml", IMPULSE, 5),
    Case("jet_on_plate", "scene.toml --set body.plate.shape.width=1 --until 0.045", "end", 5, (-0.8, 0.8, -0.12, 0.5)),
    Case("jet_impact", "scene.toml --refine 0.7 --set body.plate.shape.width=0.3 --until 0.012", "end", 10, (-0.15, 0.15, -0.024, 0.15)),
    Case("bird_on_plate", "scene.toml --refine 0.7 --set body.plate.shape.width=0.8 --until 0.001", "end", 5, (-0.3, 0.3, -0.06, 0.12)),
    Case("leading_edge", "scene_bird.toml --until 0.002", "end", 3),
    Case("viscous_jet", "scene.toml", "end", 20, (-0.08, 0.08, -0.01, 0.12)),
    Case("capsule_drop_2d", "scene.toml --until 0.02", "peak", 3),
    Case("capsule_water_landing", "scene_attitude.toml", "end", 20, (-0.75, 0.85, -0.45, 0.8)),
    Case("uav_landing", "scene.toml --until 0.16", "end", 30, (-0.4, 3.6, -0.9, 0.9)),
    Case("floating_box", "scene_displaced.toml --until 5", "body_box_displacement", 5),
    Case("float_stability", "scene.toml --until 5", "body_capsule_attitude", 60),
    Case("sphere_heave", "scene.toml", "body_sphere_displacement", 60),
    Case("two_boxes", "scene.toml --until 0.5", "end", 5, (-0.65, 0.65, -0.36, 0.26)),
    Case("moored_float", "scene.toml --until 0.5", "end", 4, (-1.9, 1.9, -1.1, 0.5)),
    Case("parachute_landing", "scene.toml", TENSION, 4),
    Case("hinged_plate", "scene.toml", "body_plate_attitude", 5),
    Case("hydrostatic", "scene.toml --until 0.1", "end", 2),
    Case("added_mass", "scene_turning.toml", ADDED_MASS, 7),
    Case("release_under_water", "scene.toml --refine 0.35", "end", 3),
    Case("release_under_water_3d", "scene.toml --refine 0.35", "end", 5),
    Case("dam_break", "scene.toml --until 0.17", "end", 2),
    Case("elliptic_drop", "scene.toml", "end", 3),
    Case("sloshing", "scene.toml", "probe_0", 5),
    Case("regular_waves", "scene.toml", "probe_0", 5),
    Case("wave_flume", "scene.toml", "probe_1", 4),
    Case("box_in_waves", "scene.toml", "body_box_displacement", 40),
    Case("wave_landing", "scene.toml --until 0.33", "end", 3, (-0.6, 1.15, -0.4, 0.7)),
    Case("terminal_speed", "scene.toml", SPEED, 20),
    Case("planing_plate", "scene.toml", "end", 20, (9.2, 12.2, -0.8, 1.0)),
    Case("impulsive_cylinder", "scene.toml", CYLINDER_DRAG, 2),
    Case("oscillating_cylinder", "scene.toml", CYLINDER_FORCE, 2),
    Case("cylinder_wake", "scene.toml", WAKE_LOADS, 4),
    Case("flapping_foil", "scene.toml", FOIL_LOADS, 4),
    Case("sedimenting_cylinder", "scene.toml", SINKING, 12),
    Case("plate_trajectories", "scene.toml", FLIGHT, 40),
    Case("turek_hron_cfd", "scene.toml", RISING, 15),
    Case("turek_hron_fsi", "scene.toml", LIFTED, 15),
    Case("double_wedge", "scene_rigid.toml", "end", 5, (0.0, 1.0, 0.0, 0.41)),
    Case("elastic_gate", "scene.toml", GATE, 40),
    Case("elastic_wedge", "scene.toml", DEFLECTED, 10),
    Case("elastic_plate", "scene.toml", STRUCK, 3),
    Case("turek_hron_csm", "scene.toml --set body.flag.elastic.scheme=midpoint --set body.flag.elastic.size=0.01 "
         "--set time.end=2 --set time.dt_max=0.005", SWING, 8),
    Case("lamb_waves", "scene.toml", PACKET, 6),
    Case("sensor_placement", "scene.toml", PIEZO, 6),
    Case("glider_ditching", "scene.toml", "body_glider_attitude", 5),
]


def command_of(case):
    return f"splashdown run examples/{case.name}/{case.arguments} --out out/gallery/{case.name}"


def run(program, case, budget):
    """The run's folder; None: it takes longer than the budget. A finished run of this command is not repeated."""
    folder = f"out/gallery/{case.name}"
    done = folder + ".command"
    command = command_of(case)
    if os.path.exists(done):
        with open(done, encoding="utf-8") as file:
            if file.read().strip() == command:
                print(f"{case.name}: is there")
                return folder
    print(f"{case.name}: {command}  (about {case.seconds} s)", flush=True)
    words = [program] + shlex.split(command)[1:] + ["--force", "--quiet", "--budget", str(budget)]
    code = subprocess.run(words).returncode
    if code == 130:
        print(f"{case.name}: more than {budget} s; left out")
        return None
    if code:
        sys.exit(f"{case.name}: exit code {code}")
    with open(done, "w", encoding="utf-8") as file:
        file.write(command + "\n")
    return folder


def drawing(folder, case):
    """The picture's SVG."""
    report = os.path.join(folder, "report")
    if "\n" in case.picture:
        subprocess.run(["gnuplot"], cwd=folder, input=STYLE + case.picture, text=True, check=True)
        return os.path.join(folder, "picture.svg")
    fields = sorted((n for n in os.listdir(report) if re.fullmatch(r"field_\d+\.svg", n)), key=lambda n: int(n[6:-4]))
    if case.picture == "end":
        return os.path.join(report, fields[-1])
    if case.picture == "peak":
        with open(os.path.join(folder, "report.html"), encoding="utf-8") as file:
            titles = re.findall(r"<figcaption><b>(.*?)</b>", file.read())
        return os.path.join(report, fields[[("largest load" in t.lower()) for t in titles].index(True)])
    return os.path.join(report, case.picture + ".svg")


def cropped(drawn, crop):
    """The same field in a smaller view: gnuplot draws axes anew, the picture between them is enlarged."""
    report, name = os.path.split(drawn)
    with open(os.path.join(report, "fields.gp"), encoding="utf-8") as file:
        script = next(part for part in file.read().split("reset\n") if f"set output '{name}'" in part)
    (left, right), (_, top) = [map(float, re.search(rf"set {axis}range \[(.*?):(.*?)\]", script).groups()) for axis in "xy"]
    with open(drawn, encoding="utf-8") as file:
        content = re.search(r'<svg x="(\d+)" y="(\d+)" width="(\d+)" height="\d+"[^>]*>(.*?)</svg>', file.read(), re.S)
    x, y, width = map(int, content.groups()[:3])
    height, below = round(width*(crop[3] - crop[2])/(crop[1] - crop[0])), 85
    canvas = y + height + below
    for old, new in ((r"size (\d+),\d+", rf"size \1,{canvas}"), (r"tmargin screen \S+", f"tmargin screen {1 - y/canvas}"),
                     (r"bmargin screen \S+", f"bmargin screen {below/canvas}"), (r"set output .*", "set output 'axes.svg'"),
                     (r"origin ([\d.]+),\S+ size ([\d.]+),\S+", rf"origin \1,{below/canvas} size \2,{height/canvas}"),
                     (r"xrange .*", f"xrange [{crop[0]}:{crop[1]}]"), (r"yrange .*", f"yrange [{crop[2]}:{crop[3]}]")):
        script = re.sub(old, new, script, count=1)
    subprocess.run(["gnuplot"], cwd=report, input=script, text=True, check=True, stderr=subprocess.DEVNULL)
    scale = width/(right - left)
    view = [(crop[0] - left)*scale, (top - crop[3])*scale, (crop[1] - crop[0])*scale, (crop[3] - crop[2])*scale]
    inside = (f'<svg x="{x}" y="{y}" width="{width}" height="{height}" viewBox="{" ".join(map(str, view))}" '
              f'preserveAspectRatio="none" stroke-linejoin="round">{content.group(4)}</svg>')
    with open(os.path.join(report, "axes.svg"), encoding="utf-8") as file:
        axes = file.read()
    with open(os.path.join(report, "cropped.svg"), "w", encoding="utf-8") as file:
        file.write(axes.replace('<g id="gnuplot_canvas">', inside + '<g id="gnuplot_canvas">', 1))
    return file.name


def output_of(command, text=None):
    return subprocess.run(command, input=text, check=True, capture_output=True).stdout


def keep_picture(folder, case):
    """A PNG of few colours, small enough for the repository."""
    target = f"{PICTURES}/{case.name}.png"
    drawn = cropped(drawing(folder, case), case.crop) if case.crop else drawing(folder, case)
    pixels = output_of(["rsvg-convert", "-w", str(WIDTH), "-b", "white", drawn])
    small = output_of(["pngquant", "--speed", "1", "--strip", str(COLOURS), "-"], pixels)
    with open(target, "wb") as file:
        file.write(small)
    print(f"{case.name}: {target}, {len(small) / 1000:.0f} kB")


INTRODUCTION = """# Gallery

One picture an example, with its question and the command that makes it. Most meshes are those of the examples; some are
coarser, so that a picture takes seconds. Figures and agreement are in the examples' READMEs. This page and its
pictures are made by

    docs/gallery.py build/release/splashdown

A run that is finished is not repeated, and a case takes its name as an argument. Times are of one core of 2.5 GHz.
"""


def section(name, command, cost):
    """Heading, question, picture and command of an example."""
    readme = Readme.of(ROOT, f"examples/{name}/README.md")
    caption, target = readme.picture()
    target = os.path.relpath(os.path.normpath(f"examples/{name}/{target}"), "docs")
    question = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", readme.question())
    return "\n".join([f"## [{readme.title()}](../examples/{name}/README.md)", "", question, "", f"![{caption}]({target})", "",
                      f"*{caption.rstrip('.')}.* {cost}", "", f"    {command}", ""])


def page():
    """The text of docs/gallery.md."""
    parts = [section(case.name, command_of(case), f"About {case.seconds} s:")
             for case in CASES if os.path.exists(f"{PICTURES}/{case.name}.png")]
    study = "splashdown study examples/coupling_schemes/study_capsule.toml --jobs 2"
    parts.append(section("coupling_schemes", study, "120 runs of about a second, not made by this page's command:"))
    return "\n".join([INTRODUCTION] + parts)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", help="splashdown")
    parser.add_argument("cases", nargs="*")
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--print", action="store_true", help="the page, to the terminal")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--budget", type=int, default=300, help="wall seconds; a run that needs more is left out")
    options = parser.parse_args()
    program = shutil.which(options.program) if options.program else None
    if options.program and not program:
        parser.error(f"no program {options.program}; build it: cmake --build --preset release")
    program = program and os.path.abspath(program)
    os.chdir(ROOT)
    chosen = [case for case in CASES if not options.cases or case.name in options.cases]
    if unknown := set(options.cases) - {case.name for case in CASES}:
        sys.exit(f"no case {', '.join(sorted(unknown))}; cases: {', '.join(case.name for case in CASES)}")
    if options.print:
        sys.stdout.write(page())
        sys.exit()
    if options.list or not (options.program or options.page):
        print("\n".join(f"{case.seconds:4} s  {command_of(case)}" for case in chosen))
        print(f"{sum(case.seconds for case in chosen):4} s in all on one core of 2.5 GHz; finished runs are not repeated")
        sys.exit()
    if program:
        if missing := [tool for tool in ("gnuplot", "rsvg-convert", "pngquant") if not shutil.which(tool)]:
            sys.exit(f"not installed: {', '.join(missing)}; apt-get install gnuplot-nox librsvg2-bin pngquant")
        os.makedirs("out/gallery", exist_ok=True)
        os.makedirs(PICTURES, exist_ok=True)
        for case in chosen:
            if folder := run(program, case, options.budget):
                keep_picture(folder, case)
    with open("docs/gallery.md", "w", encoding="utf-8") as file:
        file.write(page())
