#!/usr/bin/env python3
"""Docstrings of headers: what has none, by Doxygen (tests/lint/Doxyfile), and the share of comment lines.

    tests/lint/docstrings.py --installed     the headers that the package installs: any warning of Doxygen is an error
    tests/lint/docstrings.py [FOLDER...]     all headers (core coupling elastic fluid rigid): functions and types without a docstring
    --build FOLDER                           where Doxygen writes its XML; build/doxygen
"""
import argparse
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = ["core", "coupling", "elastic", "fluid", "rigid"]
LONGEST_HEAD = 15  # lines of a header's head comment
WIDEST = 130  # columns
UNDOCUMENTED = re.compile(r"(Compound|Member .*\((function|typedef|enumeration)\)) .*is not documented")


def installed():
    """Headers in install(FILES ...) of the rooms, or in the foreach(header ...) around it."""
    for room in ROOMS:
        text = (ROOT / room / "CMakeLists.txt").read_text()
        for call in re.findall(r"(?:install\(FILES|foreach\(header)([^)]*)\)", text):
            yield from (f"{room}/{name}" for name in call.split() if name.endswith(".hpp"))


def headers(folders):
    for folder in folders:
        path = ROOT / folder
        found = [path] if path.is_file() else sorted(path.rglob("*.hpp"))
        yield from (str(header.relative_to(ROOT)) for header in found)


def doxygen(inputs, build):
    """Warnings of Doxygen over these headers, with paths from the root."""
    pathlib.Path(build).mkdir(parents=True, exist_ok=True)
    settings = (ROOT / "tests/lint/Doxyfile").read_text()
    settings += f"\nINPUT = {' '.join(inputs)}\nOUTPUT_DIRECTORY = {build}\nFULL_PATH_NAMES = NO\nWARN_AS_ERROR = NO\n"
    run = subprocess.run(["doxygen", "-"], cwd=ROOT, input=settings, capture_output=True, text=True, check=True)
    return list(dict.fromkeys(run.stderr.replace(f"{ROOT}/", "").splitlines()))


def comment_lines(path):
    """Lines that are comments or end with one, and all lines that are not empty."""
    lines = [line for line in (ROOT / path).read_text().splitlines() if line.strip()]
    return sum("//" in re.sub(r'"[^"]*"', "", line) for line in lines), len(lines)


def rule_breaks(path):
    lines = (ROOT / path).read_text().splitlines()
    head = next((i for i, line in enumerate(lines) if not line.startswith("//")), len(lines))
    if head > LONGEST_HEAD:
        yield f"{path}:1: the head comment has {head} lines; at most {LONGEST_HEAD}"
    for number, line in enumerate(lines, 1):
        if len(line) > WIDEST:
            yield f"{path}:{number}: {len(line)} columns; at most {WIDEST}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--installed", action="store_true")
    parser.add_argument("--build", default=str(ROOT / "build/doxygen"))
    parser.add_argument("folders", nargs="*", default=ROOMS)
    options = parser.parse_args()
    inputs = list(installed()) if options.installed else list(headers(options.folders))
    faults = [w for w in doxygen(inputs, options.build) if options.installed or UNDOCUMENTED.search(w)]
    faults += [fault for path in inputs for fault in rule_breaks(path)]
    print("\n".join(faults))
    counts = [comment_lines(path) for path in inputs]
    comments, lines = (sum(column) for column in zip(*counts))
    print(f"{len(inputs)} headers, {comments} of {lines} lines with a comment: {100 * comments / lines:.0f} %; {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
