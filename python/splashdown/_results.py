"""What a run or a study left in its folder."""
from __future__ import annotations

import csv
import json
from pathlib import Path


class Result:
    """A run's folder: summary, verdict and tables.

    folder   where the files are (docs/files.md)
    summary  summary.json as dictionaries
    """

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)
        path = self.folder / "summary.json"
        if not path.is_file():
            raise FileNotFoundError(f"{path}: there is no run in this folder, or it did not get far enough to be summed up")
        self.summary: dict = json.loads(path.read_text())

    def __repr__(self) -> str:
        return f"<Result {self.folder}: {self.status} at {self.summary.get('simulated_time')} s, {self.grade}>"

    @property
    def status(self) -> str:
        """done, interrupted or failed."""
        return self.summary["status"]

    @property
    def grade(self) -> str:
        """resolved, doubtful, unresolved or unphysical: the worst of the run's headline numbers."""
        return self.summary["verdict"]["grade"]

    @property
    def reasons(self) -> list[str]:
        """Why the grade is not better."""
        return self.summary["verdict"]["reasons"]

    @property
    def tables(self) -> list[str]:
        """Names for `table`."""
        return sorted(path.stem for path in self.folder.glob("*.csv"))

    def table(self, name: str, **only) -> dict:
        """The columns of NAME.csv as NumPy arrays by name; `only`: values of columns to keep, such as body="wedge".

        Columns and their units: docs/files.md.
        """
        import numpy

        path = self.folder / f"{name}.csv"
        if not path.is_file():
            raise FileNotFoundError(f"{path}: this run has no such table; it has {', '.join(self.tables) or 'none'}")
        with path.open(newline="") as lines:
            rows = csv.reader(lines)
            names = next(rows)
            columns = list(zip(*rows)) or [()] * len(names)
        unknown = [column for column in only if column not in names]
        if unknown:
            raise KeyError(f"{name}.csv has no column {unknown[0]}; it has {', '.join(names)}")
        out = {}
        for column, values in zip(names, columns):
            array = numpy.array(values)
            try:
                out[column] = array.astype(float)
            except ValueError:
                out[column] = array
        keep = numpy.ones(len(columns[0]), dtype=bool)
        for column, value in only.items():
            keep &= out[column] == value
        return {column: array[keep] for column, array in out.items()} if only else out

    def frame(self, name: str, **only):
        """The same as a pandas DataFrame."""
        import pandas

        return pandas.DataFrame(self.table(name, **only))


class StudyResult:
    """A study's folder: a row a run.

    rows  study.csv as dictionaries; numbers are numbers
    """

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)
        path = self.folder / "study.csv"
        if not path.is_file():
            raise FileNotFoundError(f"{path}: there is no study in this folder")
        with path.open(newline="") as lines:
            self.rows = [{key: _number(value) for key, value in row.items()} for row in csv.DictReader(lines)]

    def __repr__(self) -> str:
        return f"<StudyResult {self.folder}: {len(self.rows)} runs>"

    def frame(self):
        """The rows as a pandas DataFrame."""
        import pandas

        return pandas.DataFrame(self.rows)


def _number(text: str):
    try:
        return float(text)
    except (TypeError, ValueError):
        return text
