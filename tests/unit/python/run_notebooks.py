#!/usr/bin/env python3
"""Executes the code of notebooks, cell by cell, without Jupyter: run_notebooks.py NOTEBOOK..."""
import json
import sys
import traceback

import matplotlib

matplotlib.use("Agg")


def main():
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            cells = json.load(file)["cells"]
        names = {"__name__": "__main__"}
        for number, cell in enumerate(cells):
            if cell["cell_type"] != "code":
                continue
            if cell["outputs"]:
                sys.exit(f"{path}: cell {number} holds outputs: clear them before you commit")
            try:
                exec(compile("".join(cell["source"]), f"{path}, cell {number}", "exec"), names)
            except Exception:
                traceback.print_exc()
                sys.exit(f"{path}: cell {number} fails")
        matplotlib.pyplot.close("all")
        print(f"{path}: {len(cells)} cells")


main()
