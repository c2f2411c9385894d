#!/usr/bin/env python3
"""Lists sentences above 30 words: sentences.py FILES… [--words N] [--at-most N]

Code and mathematics count as one word, cells of tables and entries of lists as sentences of their own. Exit code 1 with --at-most: more
sentences than that are long.
"""
import argparse
import re
import sys

from markdown import Document, plain

# A stop behind these ends no sentence.
ABBREVIATIONS = r"\b(?:e\.g|i\.e|cf|Fig|No|vs|al|approx|Proc|J|Int|Comput|Mech|Numer|Math|Eng|Methods|Appl|Fluid|Phys)\.$"


def pieces(document):
    """(number of the first line, text) of paragraphs, entries of lists and cells of tables."""
    text, first = [], 0
    for n, (line, kind) in enumerate(zip(document.lines + [""], document.kinds + ["blank"]), 1):
        starts_entry = re.match(r"\s*([-*+]|\d+\.) ", line)
        if text and (kind != "text" or starts_entry):
            yield first, " ".join(text)
            text = []
        if kind == "text":
            if not text:
                first = n
            text.append(re.sub(r"^\s*([-*+]|\d+\.) ", "", line).strip())
        elif kind == "table" and not set(line) <= set("|-: "):
            for cell in re.sub(r"`[^`]*`", "X", line).strip().strip("|").split("|"):
                yield n, cell.strip()


def sentences(text):
    found, current = [], ""
    for part in re.split(r"(?<=[.!?])[\"')*_]*\s+(?=[A-Z0-9*`$(\[\"‘“X])", text):
        current = f"{current} {part}".strip()
        if not re.search(ABBREVIATIONS, current):
            found.append(current)
            current = ""
    return found + ([current] if current else [])


def long_sentences(text, most):
    """(line, words, sentence) of all above `most` words."""
    for number, piece in pieces(Document(text)):
        for sentence in sentences(plain(piece)):
            words = [w for w in sentence.split() if re.search(r"\w", w)]
            if len(words) > most:
                yield number, len(words), sentence


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--words", type=int, default=30)
    parser.add_argument("--at-most", type=int)
    options = parser.parse_args()
    total = 0
    for name in options.files:
        with open(name, encoding="utf-8") as file:
            found = list(long_sentences(file.read(), options.words))
        for number, words, sentence in found:
            print(f"{name}:{number}: {words} words: {sentence}")
        print(f"{name}: {len(found)} sentences above {options.words} words")
        total += len(found)
    print(f"{total} remain")
    sys.exit(options.at_most is not None and total > options.at_most)
