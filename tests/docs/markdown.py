"""Reads Markdown as far as the checks of documents need it: code, links, headings, anchors, sections."""
import os
import re

SKIPPED = {".git", "__pycache__", "out", ".ccache", ".cache"}  # folders of any depth; `build` at the top


def files(root, *endings):
    """Paths of the tree's files with one of these endings, relative to `root`, sorted."""
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(f for f in folders if f not in SKIPPED and not (f == "build" and folder == root))
        found += [os.path.relpath(os.path.join(folder, n), root) for n in names if n.endswith(endings)]
    return sorted(found)


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        return file.read()


class Document:
    """Lines of a document, each of a kind: text, table, heading, fence, math, code, blank."""

    def __init__(self, text):
        self.lines = text.split("\n")
        self.kinds = []
        fence = None
        for line in self.lines:
            mark = re.match(r" *(```|~~~) *(\w*)", line)
            if fence:
                self.kinds.append("fence" if mark and not mark.group(2) else fence)
                if self.kinds[-1] == "fence":
                    fence = None
            elif mark:
                fence = "math" if mark.group(2) == "math" else "code"
                self.kinds.append("fence")
            elif not line.strip():
                self.kinds.append("blank")
            elif re.match(r"#+ ", line):
                self.kinds.append("heading")
            elif line.startswith("    ") and self.kinds and self.kinds[-1] in ("blank", "code"):
                self.kinds.append("code" if not self._in_list() else "text")
            elif line.lstrip().startswith("|"):
                self.kinds.append("table")
            else:
                self.kinds.append("text")

    def _in_list(self):
        for line, kind in zip(reversed(self.lines[: len(self.kinds)]), reversed(self.kinds)):
            if kind == "text":
                if re.match(r"( *[-*+]|\d+\.) ", line):
                    return True
                if not line.startswith(" "):
                    return False
            elif kind == "heading":
                return False
        return False

    def of(self, *kinds):
        """(number, line) of these kinds, numbers from 1."""
        return [(n, line) for n, (line, kind) in enumerate(zip(self.lines, self.kinds), 1) if kind in kinds]

    def spans(self):
        """(number, text) of inline code, inline mathematics apart."""
        for n, line in self.of("text", "table", "heading"):
            for span in re.findall(r"(?<![`$])`([^`]+)`(?![`$])", line):
                yield n, span

    def headings(self):
        return [(n, line.lstrip("#").strip(), len(line) - len(line.lstrip("#"))) for n, line in self.of("heading")]

    def anchors(self):
        """What a link to this document may name: slugs of headings as GitHub makes them, and <a id>."""
        found, seen = set(), {}
        for _, title, _ in self.headings():
            slug = slug_of(title)
            found.add(slug if slug not in seen else f"{slug}-{seen[slug]}")
            seen[slug] = seen.get(slug, 0) + 1
        for _, line in self.of("text", "table", "heading"):
            found.update(re.findall(r'<a (?:id|name)="([^"]+)"', line))
        return found

    def links(self):
        """(number, target) of inline links and pictures."""
        for n, line in self.of("text", "table", "heading"):
            plain = re.sub(r"`[^`]*`", "", line)
            for target in re.findall(r"\]\(([^()\s]+(?:\([^()]*\))?)\)", plain):
                yield n, target


def slug_of(title):
    title = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title)
    return re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")


def plain(line):
    """A line without mark-up: links as their text, code and mathematics as one word."""
    line = re.sub(r"<[^>]+>", "", line)
    line = re.sub(r"\$`[^`]*`\$|\$[^$]+\$", "X", line)
    line = re.sub(r"`[^`]*`", "X", line)
    line = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", line)
    return re.sub(r"[*_]{1,2}(?=\S)|(?<=\S)[*_]{1,2}", "", line)
