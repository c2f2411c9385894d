"""What documents name in code font exists in the tree. By form:

    path with /             examples/…, fluid/pfem/mesh/*.hpp; the end of a path is enough; folders of results are not looked for
    name of a source        recognise.cpp, volume_books.*; not of data, which programs write
    A::b                    words of one source that is no test
    name(…)                 a word of the sources
    CamelCase, snake_case   words of sources, scripts, scenes: identifiers, keys, columns, names of tests
    fluid.size.corner       key: each word
    --option                literally in a source or script

Words without underscore, capital or bracket cannot be distinguished from plain words. NAME in capitals stands for any name. What a
document invents, or other programs own, it lists itself: <!-- not in the tree: drag Drag -->. The diary names what is gone.
"""
import fnmatch
import os
import re

from markdown import Document, files, read

DIARY = {"docs/design-notes/history.md"}
SOURCES = (".cpp", ".hpp", ".py", ".sh", ".cmake", "CMakeLists.txt", "CMakePresets.json", ".toml", ".in", "run", ".cff",
           "packages.txt", ".csv")
MADE = {"out", "build", "…", "report", "checkpoint", "frames"}  # first folders of what programs write
RESULTS = r"\.(csv|json|html|vtu|vtm|pvd|xml|svg|png|stl|obj|gp|bin|rescued|lock)$"
ENDINGS = r"(cpp|hpp|py|sh|toml|cmake|md|supp|in)"


class Tree:
    def __init__(self, root):
        self.paths = files(root, "")
        self.folders = {os.path.dirname(p) for p in self.paths}
        for folder in list(self.folders):
            while folder:
                self.folders.add(folder)
                folder = os.path.dirname(folder)
        self.top = {p.split("/")[0] for p in self.folders if p}
        self.names = {os.path.basename(p) for p in self.paths}
        text = "\n".join(read(root, p) for p in self.paths if p.endswith(SOURCES) and not p.startswith("tests/docs/"))
        self.words = set(re.findall(r"[A-Za-z_][A-Za-z0-9_]*", text)) | set(re.split(r"[/.]", "/".join(self.paths)))
        self.words_of_file = [set(re.findall(r"[A-Za-z_]\w*", read(root, p))) for p in self.paths
                              if p.endswith((".hpp", ".cpp")) and not p.startswith("tests/")]
        self.text = text
        self.options = set(re.findall(r"--[a-z][a-z-]*[a-z]", text))

    def has_path(self, path):
        path = path.rstrip("/")
        ends = [path, "*/" + path]
        if re.search(r"\.\w+$|\*$", path) is None:
            ends += [path + ".*", "*/" + path + ".*"]
        return any(path == f or f.endswith("/" + path) for f in self.folders) or any(
            fnmatch.fnmatch(p, end) for end in ends for p in self.paths)

    def has_name(self, name):
        if name in self.text:  # a file that programs write
            return True
        return any(fnmatch.fnmatch(n, name) for n in self.names) if "*" in name else name in self.names


def fault_of(span, tree):
    """What is wrong with this piece of inline code, or None."""
    span = span.strip()
    if re.search(RESULTS, span) and "/" not in span:
        return None
    if " " in span or "=" in span:
        return fault_of_command(span, tree)
    if re.fullmatch(r"--[a-z][a-z-]*", span):
        return None if span in tree.options else f"no program has the option {span}"
    if re.fullmatch(rf"[\w.-]+\.({ENDINGS}|\*)", span) and not span[0].isupper() and "_NAME" not in span:
        if not re.fullmatch(rf"[a-z_]+\.\*", span) or tree.has_name(span):
            return None if tree.has_name(span) else f"no file {span}"
    if "/" in span and re.fullmatch(r"[\w./*-]+", span) and not span.startswith(("/", "~", "http", "./")):
        first = span.split("/")[0]
        if first in MADE or re.search(r"[A-Z]{3}", span) or not (first in tree.top or re.search(rf"\.{ENDINGS}$|\.\*$", span)):
            return None
        return None if tree.has_path(span) else f"no file or folder {span}"
    if "::" in span:
        words = re.findall(r"[A-Za-z_]\w*", span.split("(")[0])
        if words[0] == "std" or any(set(words) <= of_file for of_file in tree.words_of_file):
            return None
        return f"no source has {' and '.join(words)} in one file"
    call = re.fullmatch(r"([A-Za-z_]\w+)\((.*)\)", span)
    if call:
        return None if call.group(1) in tree.words else f"the sources have no {call.group(1)}"
    if re.fullmatch(r"[A-Za-z_]\w*(\.[\w*]+)*", span):
        words = [w for w in re.findall(r"[A-Za-z_]\w*", span)]
        odd = [w for w in words if w not in tree.words and not w.isupper() and not re.search(r"[A-Z]{3}|_N$|\bN\b", w)
               and ("_" in w.strip("_") or re.search(r"[a-z][A-Z]", w) or "." in span)]
        return f"nothing is called {odd[0]}" if odd else None
    return None


def fault_of_command(line, tree):
    """Paths and options of a command line; keys of its --set."""
    mine = re.search(r"(^|[\s/])(splashdown|stability_ensemble|tests/|scripts/|examples/)", line)
    for word in line.replace('"', " ").replace("'", " ").split():
        word = word.rstrip(".,;:)")
        first = word.split("/")[0]
        is_path = "/" in word and first in tree.top and re.fullmatch(r"[\w./*-]+", word)
        if is_path and not re.search(r"[A-Z]{3}", word) and not tree.has_path(word):
            return f"no file or folder {word}"
        option = re.match(r"--[a-z][a-z-]*[a-z](?==|$)", word)
        if option and mine and option.group(0) not in tree.options:
            return f"no program has the option {option.group(0)}"
    for key in re.findall(r"--set ['\"]?([a-z_][\w.]*)=", line):
        for part in key.split("."):
            if re.fullmatch(r"[a-z_]+", part) and part not in tree.words:
                return f"no key {key}: nothing is called {part}"
    return None


def faults(root):
    tree = Tree(root)
    for path in files(root, ".md"):
        if path in DIARY or path == "CHANGELOG.md":
            continue
        text = read(root, path)
        document = Document(text)
        absent = [word for listed in re.findall(r"<!-- not in the tree: (.*?) -->", text) for word in listed.split()]
        for number, span in document.spans():
            if any(word in span for word in absent):
                continue
            if fault := fault_of(span, tree):
                yield f"{path}:{number}: `{span}`: {fault}"
        for number, line in document.of("code"):
            if fault := fault_of_command(line, tree):
                yield f"{path}:{number}: {fault}"
