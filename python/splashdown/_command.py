"""The command, called: each function is one of its words, and options have the command's names."""
from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path

from ._results import Result, StudyResult
from ._simulation import CannotGoOn, SceneError
from ._toml import scene_text, toml_value

_DONE, _BAD_INPUT, _CANNOT_GO_ON, _INTERRUPTED = 0, 2, 3, 130


class CommandError(RuntimeError):
    """The command ended in a way that it has no code for; its text."""


def _executable() -> str:
    beside = Path(__file__).with_name("splashdown")
    found = os.environ.get("SPLASHDOWN") or (str(beside) if beside.is_file() else shutil.which("splashdown"))
    if not found:
        raise CommandError("the command splashdown is neither in this package nor on the PATH; set SPLASHDOWN to where it is")
    return found


def _call(arguments: list[str]) -> str:
    """What the command prints; its errors as exceptions with its text. The interpreter's lock is free meanwhile."""
    done = subprocess.run([_executable(), *arguments], capture_output=True, text=True, check=False)
    text = "\n".join(line.removeprefix("error: ") for line in done.stderr.strip().splitlines())
    if done.returncode == _BAD_INPUT:
        raise SceneError(text)
    if done.returncode == _CANNOT_GO_ON:
        raise CannotGoOn(text)
    if done.returncode == -2:
        raise KeyboardInterrupt
    if done.returncode not in (_DONE, _INTERRUPTED):
        raise CommandError(text or f"exit code {done.returncode}")
    return done.stdout


def _options(set: Mapping | Iterable[str] | None, named: Mapping) -> list[str]:
    """--set KEY=VALUE and --NAME VALUE."""
    texts = [f"{key}={toml_value(value)}" for key, value in set.items()] if isinstance(set, Mapping) else list(set or [])
    out = [part for text in texts for part in ("--set", text)]
    for name, value in named.items():
        option = "--" + name.rstrip("_").replace("_", "-")
        if value is True:
            out.append(option)
        elif value is not None and value is not False:
            out += [option, str(value)]
    return out


def _folder(out: str | Path | None) -> Path:
    """Of a run; a new one without `out`, with room for a scene beside it."""
    return Path(out) if out is not None else Path(tempfile.mkdtemp(prefix="splashdown-")) / "run"


def _file(scene, folder: Path) -> Path:
    """Where the scene is: a file, or one that is written into the folder."""
    if isinstance(scene, Mapping):
        scene = scene_text(scene)
    elif isinstance(scene, os.PathLike) or "\n" not in str(scene):
        return Path(scene)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "scene.toml"
    path.write_text(scene)
    return path


def run(scene, out: str | Path | None = None, *, set: Mapping | Iterable[str] | None = None, report: bool = True, **options) -> Result:
    """Runs a scene: a file, a text of TOML, or nested dictionaries.

    out      folder of the run; default: a new temporary one
    set      keys to set: {"body.wedge.mass": 3} or texts KEY=VALUE
    report   whether report.html is drawn
    options  of the command, such as refine, until, accuracy, seconds, budget, threads, resume, restart, large

    Raises SceneError for a wrong scene and CannotGoOn for a run that finds no step, with the command's text.
    A run that spent its budget is returned, with status "interrupted".
    """
    folder = _folder(out)
    path = _file(scene, folder.parent if out is None else folder)
    _call(["run", str(path), "--out", str(folder), "--quiet", *([] if report else ["--no-report"]), *_options(set, options)])
    return Result(folder)


def check(scene, *, set: Mapping | Iterable[str] | None = None, **options) -> str:
    """What the scene means and what it will cost, as text. Raises SceneError."""
    with tempfile.TemporaryDirectory() as folder:
        return _call(["check", str(_file(scene, Path(folder))), *_options(set, options)])


def study(file: str | Path, out: str | Path | None = None, **options) -> StudyResult:
    """All runs of a study (docs/study.md). Raises SceneError for a wrong one."""
    folder = _folder(out)
    _call(["study", str(file), "--out", str(folder), *_options(None, options)])
    return StudyResult(folder)


def price(scene, out: str | Path | None = None, *, set: Mapping | Iterable[str] | None = None, **options) -> dict:
    """What accuracy costs (docs/price.md): price.json as dictionaries."""
    folder = _folder(out)
    _call(["price", str(_file(scene, folder.parent if out is None else folder)), "--out", str(folder), *_options(set, options)])
    return json.loads((folder / "price.json").read_text())


def version() -> str:
    """Of the program, its libraries and its compiler."""
    return _call(["--version"]).strip()
