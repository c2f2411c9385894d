"""Examples' READMEs follow one pattern: a question, then the same headings in the same order.

    # Title
    One sentence or two that ask, the first paragraph.
    ## Set-up, ## Run, ## What you should see, ## Agreement, ## Cost, then what there is more to learn, ## Reference at the end.

Run holds a command. What you should see holds one picture, where the example has a scene or a study. Agreement holds a table,
where it has a check; percentages in its column (or row) `bar` are those of check.toml.
"""
import os
import re
import subprocess
import sys
import tomllib

from markdown import Document, read

REQUIRED = ["Set-up", "Run", "What you should see", "Agreement", "Cost"]
OPTIONAL = ["What it teaches", "Variations", "Limits", "Reference"]


class Readme:
    def __init__(self, text):
        self.document = Document(text)
        self.parts = {"": []}
        self.titles = []
        for line, kind in zip(self.document.lines, self.document.kinds):
            if kind == "heading" and line.startswith("# "):
                self.titles.append(line[2:].strip())
            elif kind == "heading" and line.startswith("## "):
                self.parts[line[3:].strip()] = []
            else:
                list(self.parts.values())[-1].append((line, kind))

    @staticmethod
    def of(root, path):
        return Readme(read(root, path))

    def title(self):
        return self.titles[0]

    def question(self):
        """The paragraph under the title."""
        lines = []
        for line, kind in self.parts[""]:
            if kind == "text":
                lines.append(line.strip())
            elif lines:
                break
        return " ".join(lines)

    def pictures(self, part="What you should see"):
        return [found for line, _ in self.parts.get(part, []) for found in re.findall(r"!\[([^\]]*)\]\(([^)]*)\)", line)]

    def picture(self):
        """(caption, target) of the picture of what you should see."""
        return self.pictures()[0]

    def has(self, part, kind):
        return any(k == kind for _, k in self.parts[part])


    def bars(self):
        """Percentages in the columns, or rows, `bar` of the tables of Agreement."""
        column = None
        for line, kind in self.parts["Agreement"]:
            cells = [cell.strip() for cell in line.replace("\\|", "").strip().strip("|").split("|")]
            if kind != "table":
                column = None
            elif column is None:
                column = cells.index("bar") if "bar" in cells else len(cells)
            else:
                of_bar = cells[1:] if cells[0].startswith("bar") else cells[column:column + 1]
                yield from re.findall(r"(\d+(?:\.\d+)?) %", " ".join(of_bar))


def bars_of(check):
    """Tolerances and limits of a check.toml, in per cent with two digits."""
    keys = ("tolerance", "tolerance_absolute", "at_most", "at_least")
    found = [each.get(key) for each in tomllib.loads(check).get("check", []) for key in keys]
    return {f"{100*abs(value):.2g}" for value in found if isinstance(value, (int, float))}


def faults_of(path, readme, files):
    if len(readme.titles) != 1:
        yield f"{path}: one title, not {len(readme.titles)}"
    if not readme.question().endswith("?"):
        yield f"{path}: the paragraph under the title asks a question: it ends with a question mark"
    headings = list(readme.parts)[1:]
    wanted = REQUIRED + [h for h in OPTIONAL if h in headings]
    if headings != wanted:
        yield f"{path}: headings are {', '.join(headings)}; the pattern is {', '.join(wanted)} (optional: {', '.join(OPTIONAL)})"
        return
    if not readme.has("Run", "code"):
        yield f"{path}: Run holds no command"
    if any(f.startswith(("scene", "study")) for f in files) and len(readme.pictures()) != 1:
        yield f"{path}: What you should see holds {len(readme.pictures())} pictures, not one"
    if "check.toml" in files and not readme.has("Agreement", "table"):
        yield f"{path}: Agreement holds no table of what the check asks for"
    if not re.search(r"\d", "".join(line for line, _ in readme.parts["Cost"])):
        yield f"{path}: Cost names no seconds"


def faults(root):
    for example in sorted(os.listdir(os.path.join(root, "examples"))):
        folder = os.path.join(root, "examples", example)
        if not os.path.isdir(folder):
            continue
        path = f"examples/{example}/README.md"
        if not os.path.exists(os.path.join(root, path)):
            yield f"{path} is missing"
            continue
        readme = Readme.of(root, path)
        yield from faults_of(path, readme, os.listdir(folder))
        if "check.toml" in os.listdir(folder):
            allowed = bars_of(read(root, f"examples/{example}/check.toml"))
            for bar in readme.bars():
                if f"{float(bar):.2g}" not in allowed:
                    yield f"{path}: a bar of {bar} %, which check.toml does not have"


MOST_BYTES, MOST_BYTES_IN_ALL = 100_000, 3_000_000  # of the gallery's pictures


def gallery_faults(root):
    """docs/gallery.md is what docs/gallery.py makes of the READMEs; its pictures are there, small, and all of them are used."""
    made = subprocess.run([sys.executable, os.path.join(root, "docs/gallery.py"), "--print"], capture_output=True, text=True)
    if made.returncode:
        yield f"docs/gallery.py --print: {made.stderr.strip()}"
        return
    if made.stdout != read(root, "docs/gallery.md"):
        yield "docs/gallery.md is not of these READMEs: docs/gallery.py --page writes it"
    folder = os.path.join(root, "docs/images/gallery")
    pictures = sorted(os.listdir(folder))
    sizes = {name: os.path.getsize(os.path.join(folder, name)) for name in pictures}
    for name, size in sizes.items():
        if f"images/gallery/{name}" not in made.stdout:
            yield f"docs/images/gallery/{name} is shown nowhere"
        if size > MOST_BYTES:
            yield f"docs/images/gallery/{name} has {size} bytes, more than {MOST_BYTES}"
    if sum(sizes.values()) > MOST_BYTES_IN_ALL:
        yield f"docs/images/gallery has {sum(sizes.values())} bytes, more than {MOST_BYTES_IN_ALL}"
