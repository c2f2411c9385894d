"""Types and functions that libraries declare at namespace scope: one meaning a name. Headers' file names likewise.

A name that two headers of core/, coupling/, elastic/, fluid/, rigid/ declare must be an overload of one meaning, which the list below says why.
"""
import os
import re

from markdown import files, read

LIBRARIES = ("core/", "coupling/", "elastic/", "fluid/", "rigid/")

# One meaning in several places; or two meanings that wait for another name.
SHARED = {
    "Participant": "the same role, a participant of the coupling, of the fluid and of the bodies",
    "Gravity": "the same force, on the fluid and on bodies",
    "Kernel": "CGAL's",
    "Nodes": "the same nodes: what all rooms see, and with it what the fluid keeps of them",
    "box": "overload: outline in 2D, solid in 3D",
    "check": "overload: a body, a joint",
}

TYPE = re.compile(r"^(?:struct|class|enum class) (\w+)(?: final)?(?: :[^{;]*)?\s*\{|^using (\w+) = (?!.*::\2;)", re.M)
FUNCTION = re.compile(r"^(?:\[\[nodiscard\]\] |inline |constexpr )*(?!return|using|extern|template|struct|class|namespace|static|typedef)"
                      r"[A-Za-z_][\w:<>,&\* ]*[ &\*](\w+)\((?![^)]*\) *$)[^;{]*[;{]", re.M)


def declared(root):
    """Name to the headers that declare it."""
    where = {}
    for path in files(root, ".hpp"):
        if not path.startswith(LIBRARIES):
            continue
        text = re.sub(r"//[^\n]*", "", read(root, path))
        names = {a or b for a, b in TYPE.findall(text)} | set(FUNCTION.findall(text))
        for name in names - {"operator"}:
            where.setdefault(name, []).append(path)
    return where


def faults(root):
    for name, paths in sorted(declared(root).items()):
        rooms = {os.path.dirname(p) for p in paths}
        if len(paths) > 1 and name not in SHARED:
            yield f"{paths[1]}: {name} is declared in {paths[0]}, too: {len(rooms)} rooms; find another word, or say in names.py why it is one"
