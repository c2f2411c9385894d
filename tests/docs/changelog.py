"""CHANGELOG.md: releases in order, three headings each, short entries, what breaks marked."""
import re

from markdown import plain, read

HEADINGS = ["Added", "Changed", "Fixed"]
MOST_WORDS = 25


def entries(lines):
    """(number, text) of each bullet with the lines that go on with it."""
    found = []
    for number, line in lines:
        if line.startswith("- "):
            found.append([number, line[2:]])
        elif found and line.startswith("  "):
            found[-1][1] += " " + line.strip()
    return [tuple(entry) for entry in found]


def version_of(text):
    return tuple(int(part) for part in text.split("."))


def faults(root):
    name = "CHANGELOG.md"
    lines = list(enumerate(read(root, name).split("\n"), 1))
    releases, headings, release, last = [], [], None, None
    body = []
    for number, line in lines:
        if line.startswith("## "):
            match = re.fullmatch(r"## (\d+\.\d+\.\d+)( \((?:unreleased|\d{4}-\d\d-\d\d)\))?", line)
            if not match:
                yield f"{name}:{number}: a release is \"## X.Y.Z\", with (unreleased) or (YYYY-MM-DD) behind it"
                continue
            release, headings, last = version_of(match.group(1)), [], None
            if releases and release >= releases[-1]:
                yield f"{name}:{number}: releases stand newest first"
            releases.append(release)
        elif line.startswith("#") and release:
            title = line.lstrip("# ")
            if title not in HEADINGS or not line.startswith("### "):
                yield f"{name}:{number}: headings of a release are ### {', ### '.join(HEADINGS)}; not {line}"
            elif title in headings or (last and HEADINGS.index(title) < HEADINGS.index(last)):
                yield f"{name}:{number}: each heading stands once, in the order {', '.join(HEADINGS)}"
            headings.append(title)
            last = title
        elif release and line.strip():
            if not re.match(r"- |  \S", line):
                yield f"{name}:{number}: a release has entries (\"- \") alone"
            elif not last:
                yield f"{name}:{number}: an entry stands below a heading"
            body.append((number, line))
    for number, text in entries(body):
        words = len(plain(text).split())
        if words > MOST_WORDS:
            yield f"{name}:{number}: an entry has {words} words; {MOST_WORDS} at most"
        if "breaking" in text.lower() and not text.startswith("**breaking** "):
            yield f"{name}:{number}: an entry that breaks begins with **breaking**"
    project = re.search(r"project\(\w+ VERSION ([\d.]+)", read(root, "CMakeLists.txt"))
    if not releases:
        yield f"{name}: no release"
    elif project and version_of(project.group(1)) != releases[0]:
        yield f"{name}: the newest release is not the version of CMakeLists.txt, {project.group(1)}"
