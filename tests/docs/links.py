"""Links between documents, their anchors, and documents that comments name: all lead somewhere."""
import os
import re

from markdown import Document, files, read

SOURCES = (".cpp", ".hpp", ".py", ".cmake", "CMakeLists.txt", ".toml", ".sh")


def faults(root):
    documents = {path: Document(read(root, path)) for path in files(root, ".md")}
    for path, document in documents.items():
        for number, target in document.links():
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            there = os.path.normpath(os.path.join(os.path.dirname(path), name)) if name else path
            if not os.path.exists(os.path.join(root, there)):
                yield f"{path}:{number}: the link {target} leads to no file"
            elif anchor and there in documents and anchor not in documents[there].anchors():
                yield f"{path}:{number}: {there} has no anchor #{anchor}; a heading's is its text in lower case with hyphens"
    for path in files(root, *SOURCES):
        for number, line in enumerate(read(root, path).split("\n"), 1):
            for name in re.findall(r"(?<![\w/.-])docs/(?:[\w/-]+\.md|design-notes)(?:#[\w-]+)?", line):
                there, _, anchor = name.partition("#")
                if not os.path.exists(os.path.join(root, there)):
                    yield f"{path}:{number}: {there} is named and does not exist"
                elif anchor and anchor not in documents[there].anchors():
                    yield f"{path}:{number}: {there} has no anchor #{anchor}"
