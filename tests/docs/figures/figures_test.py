"""Figures that the examples' READMEs promise come out, and errors that documents quote are told.

  figures_test.py PATH_OF_SPLASHDOWN SOURCE_FOLDER VALIDATION_CSV

A figure of three digits or more under "What you should see" has to be

  measured   what a check of the example measured, to the digits quoted;
  expected   what a passed check expects, within the check's tolerance of what it measured;
  given      a number of the example's scenes or checks, rounded; or
  other      an entry of others.toml, a formula or a reason.

Measurements are those of VALIDATION_CSV, which the runs of this build have left, and of docs/validation.md where it has none. Errors are
those of the program: each quoted one is provoked by its key and value in the scene named in errors.toml.
"""

import csv
import math
import pathlib
import re
import subprocess
import sys
import tomllib

program, root, fresh = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
here = root / "tests/docs/figures"
number = r"-?\d+\.?\d*(?:e[-+]?\d+)?"
units = (1, 1e3, 1e-3, 100)  # prefixes and per cent
least_digits = 3
failures = 0


def fail(text):
    global failures
    failures += 1
    print("FAIL ", text)


class Row:
    """A check: what it measured, what it expects, and what it allows, relative or absolute."""

    def __init__(self, name, measured, expected, allowed, passed):
        self.name, self.measured, self.passed = name, float(measured), passed
        self.expected = float(expected) if re.fullmatch(number, expected) else None
        value = re.match(number, allowed)
        self.allowed = float(value[0]) if value else 0
        if allowed.endswith("%"):
            self.allowed *= 0.01 * abs(self.expected or 0)

    def gives(self, figure, unit_of_last_place):
        """Whether the figure is this check's."""
        slack = 0.5001 * unit_of_last_place
        near = lambda value, k, width: abs(abs(value) * k - figure) <= width
        if any(near(self.measured, k, slack) for k in units):
            return True
        return (self.expected is not None and self.passed and abs(self.measured - self.expected) <= self.allowed
                and any(near(self.expected, k, slack) for k in units))


def rows():
    """Of all examples, by example: those of the page, and in their place those of this build's runs."""
    found = {}
    page = r"\| \[(\w+)\]\([^)]*\) \| (\w+) \| (\S+) \| ([^|]*) \| ([^|]*) \| [^|]* \| (\w+) \|"
    for example, *cells in re.findall(page, (root / "docs/validation.md").read_text()):
        name, measured, expected, allowed, verdict = (cell.strip() for cell in cells)
        if re.fullmatch(number, measured):
            found.setdefault(example, {})[name] = Row(name, measured, expected, allowed, verdict == "pass")
    if fresh.exists():
        for row in csv.reader(fresh.open()):
            example, name, _, measured, expected, allowed, _, verdict = row[:8]
            if re.fullmatch(number, measured):
                found.setdefault(example, {})[name] = Row(name, measured, expected, allowed, verdict == "pass")
    return found


def promised(readme, with_tables):
    """Figures of the section: text, place."""
    section = re.search(r"^## What you should see$(.*?)(?=^## |\Z)", readme, re.S | re.M)
    if not section:
        return
    text = section[1] if with_tables else re.sub(r"^\|.*$", "", section[1], flags=re.M)
    text = re.sub(r"`[^`]*`", "", re.sub(r"\]\([^)]*\)", "]", text))
    for match in re.finditer(r"(?<![\w.])\d+(?:\.\d+)?(?!\w)", text):
        if len(match[0].replace(".", "").lstrip("0")) >= least_digits:
            yield match[0], text[max(0, match.start() - 40):match.end() + 20].replace("\n", " ")


def figures():
    known, others, used, count = rows(), tomllib.loads((here / "others.toml").read_text()), set(), 0
    for file in sorted(root.glob("examples/*/README.md")):
        example = file.parent.name
        given = {abs(float(n)) for toml in file.parent.glob("*.toml") for n in re.findall(number, toml.read_text())}
        for text, place in promised(file.read_text(), "tables" not in others.get(example, {})):
            count += 1
            figure, last = float(text), 10.0 ** -len(text.partition(".")[2])
            why = others.get(example, {}).get(text)
            checked = any(row.gives(figure, last) for row in known.get(example, {}).values())
            if not checked or why and why.startswith("= "):  # a formula stays true where the check is of another preset
                used.add((example, text))
            if checked or any(abs(g - figure) <= 0.5001 * last for g in given):
                continue
            if why is None:
                fail(f"examples/{example}/README.md promises {text} ({place}): no check has it. Write what comes out, or say in "
                     "tests/docs/figures/others.toml what it is")
            elif why.startswith("= ") and abs(eval(why[2:], vars(math).copy()) - figure) > 0.5001 * last:
                fail(f"examples/{example}/README.md: {text} is not {why[2:]}")
    for example, entries in others.items():
        for text in entries:
            if text != "tables" and (example, text) not in used:
                fail(f"tests/docs/figures/others.toml: {example} does not promise {text} any more, or a check has it")
    print(f"{count} figures")


def told(arguments):
    result = subprocess.run([program, *arguments], capture_output=True, text=True, cwd=root)
    return result.stderr


def without_place(message):
    """"error: FILE:LINE: KEY = ...": from the key on."""
    return re.sub(r"^error: \S*?(?::\d+)?: ", "", message)


def errors():
    scenes, count = tomllib.loads((here / "errors.toml").read_text()), 0
    for document in [root / "README.md", *sorted((root / "docs").glob("*.md")), *sorted(root.glob("examples/*/README.md"))]:
        for quoted in re.findall(r"^ +(error: .*)$", document.read_text(), re.M):
            said = without_place(quoted).removesuffix("…").rstrip()
            scene = next((s for s in scenes["scene"] if said.startswith(s["key"])), None)
            if scene is None:
                fail(f"{document.name}: no scene in tests/docs/figures/errors.toml for: {said}")
                continue
            if "skipped" in scene:
                continue
            count += 1
            command = scene.get("command") or ["check", scene["file"], *(w for s in scene["set"] for w in ("--set", s))]
            messages = told(command)
            if said not in messages:
                fail(f"{document.name} quotes '{said}', the program says: {messages.strip()}")
    print(f"{count} errors")


figures()
errors()
sys.exit(failures > 0)
