"""docs/theory.md and docs/glossary.md: length, equations that name their code, symbols and words with one meaning."""
import os
import re

import identifiers
from markdown import Document, files, read

MOST_LINES = 450
PAIR = re.compile(r"`([\w./]+\.(?:cpp|hpp))`: ((?:`\w+`(?:, )?)+)")


def sections(document):
    """Ranges of line numbers between headings."""
    starts = [n for n, _, _ in document.headings()] + [len(document.lines) + 1]
    return list(zip(starts, starts[1:]))


def unbalanced(text):
    text = re.sub(r"\\[{}]", "", text)
    depth = 0
    for c in text:
        depth += (c == "{") - (c == "}")
        if depth < 0:
            return True
    return depth != 0


def formula_faults(text):
    if unbalanced(text):
        yield "braces are not balanced"
    if re.findall(r"\\begin\{(\w+)\}", text) != re.findall(r"\\end\{(\w+)\}", text):
        yield "\\begin and \\end do not match"
    if len(re.findall(r"\\left(?![a-z])", text)) != len(re.findall(r"\\right(?![a-z])", text)):
        yield "\\left and \\right do not match"
    if re.search(r"(?<![\\a-zA-Z])(abla|nabla|frac|mathbf|mathsf|oint|cdot)\b", text):
        yield "a command has lost its backslash"
    if re.search(r"\\(operatorname|def|newcommand|require)\b", text):
        yield "GitHub does not render this command"


def mathematics_faults(root):
    """Of formulas in all documents."""
    for name in files(root, ".md"):
        document = Document(read(root, name))
        for n, line in document.of("text", "table"):
            bare = re.sub(r"(?<!\$)`[^`]*`(?!\$)", "", line)
            for formula in re.findall(r"\$`([^`]*)`\$", bare) + re.findall(r"\$([^$`]+)\$", re.sub(r"\$`[^`]*`\$", "", bare)):
                if document.kinds[n - 1] == "table" and "|" in formula.replace("\\|", ""):
                    yield f"{name}:{n}: a bar in a table's formula ends the cell; write \\lvert, \\rvert"
                for fault in formula_faults(formula):
                    yield f"{name}:{n}: {fault}: {formula}"
            if re.match(r"abla\b", line):
                yield f"{name}:{n}: \\nabla has lost its beginning"
        block = []
        for n, line in document.of("math", "fence"):
            if document.kinds[n - 1] == "math":
                block.append(line)
            elif block:
                for fault in formula_faults("\n".join(block)):
                    yield f"{name}:{n - 1}: {fault}"
                block = []


def pairs(document, first, last):
    """(number, file, function) of all places that name code between these lines; a line may go on in the next one."""
    text, numbers = "", []
    for n in range(first, last):
        if document.kinds[n - 1] in ("text", "table"):
            text += document.lines[n - 1].strip() + " "
            numbers += [n] * (len(document.lines[n - 1].strip()) + 1)
    for match in PAIR.finditer(text):
        for function in re.findall(r"`(\w+)`", match.group(2)):
            yield numbers[match.start()], match.group(1), function


def faults(root, name="docs/theory.md"):
    document = Document(read(root, name))
    count = len(read(root, name).splitlines())
    if count > MOST_LINES:
        yield f"{name}: {count} lines; {MOST_LINES} at most"
    for n, line in document.of("text", "table"):
        rest = line
        for formula in re.findall(r"\$`([^`]*)`\$", line):
            if document.kinds[n - 1] == "table" and "|" in formula:
                yield f"{name}:{n}: a bar in a table's formula ends the cell; write \\lvert, \\rvert"
            for fault in formula_faults(formula):
                yield f"{name}:{n}: {fault}: {formula}"
        rest = re.sub(r"\$`[^`]*`\$|`[^`]*`", "", line)
        if "$" in rest:
            yield f"{name}:{n}: inline mathematics is $`…`$, within one line, so that Markdown leaves it alone"
    tags = []
    for first, last in sections(document):
        named = list(pairs(document, first, last))
        block = []
        for n in range(first, last):
            if document.kinds[n - 1] == "math":
                block.append(document.lines[n - 1])
            elif block:
                text = "\n".join(block)
                for fault in formula_faults(text):
                    yield f"{name}:{n - 1}: {fault}"
                tags += [int(t) for t in re.findall(r"\\tag\{(\d+)\}", text)]
                if not any(at >= n for at, _, _ in named):
                    yield f"{name}:{n - 1}: no code is named behind this equation in its section: `file`: `function`"
                block = []
        for n, file, function in named:
            if not os.path.exists(os.path.join(root, file)):
                yield f"{name}:{n}: {file} does not exist"
            elif not re.search(rf"\b{function}\b", read(root, file)):
                yield f"{name}:{n}: {file} has no {function}"
    if tags != list(range(1, len(tags) + 1)):
        yield f"{name}: equations are not numbered 1, 2, 3 …: {tags}"
    for n, line in document.of("text", "table"):
        for number in re.findall(r"[Ee]quations? \((\d+)\)", line):
            if int(number) not in tags:
                yield f"{name}:{n}: there is no equation ({number})"
    yield from symbol_faults(root, name)


def rows(root, name, header):
    """(number, cells) of the table whose first cell is `header`."""
    document, within = Document(read(root, name)), False
    for n, line in document.of("table"):
        cells = [c.strip() for c in line.strip().strip("|").split("|")]
        if cells[0] == header:
            within = True
        elif within and not set(line) <= set("|-: "):
            if document.kinds[n - 2] != "table":
                return
            yield n, cells


def symbol_faults(root, name):
    text = read(root, name)
    body, seen = text.split("\n## Symbols")[0], {}
    for n, cells in rows(root, name, "symbol"):
        for symbol in re.findall(r"\$`([^`]*)`\$", cells[0]):
            if symbol in seen:
                yield f"{name}:{n}: the symbol {symbol} has a meaning already, in line {seen[symbol]}"
            seen[symbol] = n
            if symbol not in body:
                yield f"{name}:{n}: the symbol {symbol} is not used"


def glossary_faults(root, name="docs/glossary.md"):
    seen, tree = {}, identifiers.Tree(root)
    for n, cells in rows(root, name, "word"):
        for word in re.findall(r"`(\w+)`", " ".join(cells)):
            if word not in tree.words:
                yield f"{name}:{n}: the sources have no {word}"
        for word in cells[0].split(", "):
            if word in seen:
                yield f"{name}:{n}: {word} has a meaning already, in line {seen[word]}"
            seen[word] = n
    if not seen:
        yield f"{name}: no table of words"
