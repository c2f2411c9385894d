from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any

from numpy import ndarray

class SceneError(ValueError): ...
class CannotGoOn(RuntimeError): ...

class Body:
    name: str
    position: ndarray
    rotation: ndarray
    velocity: ndarray
    spin: ndarray
    acceleration: ndarray
    angular_acceleration: ndarray
    force: ndarray
    moment: ndarray
    wetted: float

Force = Callable[[float, Body], tuple[Sequence[float], Sequence[float]]]
Path = Callable[[float], tuple[Sequence[float], Sequence[Sequence[float]]]]

class Simulation:
    @staticmethod
    def open(scene: str | PathLike[str], set: Sequence[str] = ..., forces: Mapping[str, Force] = ..., paths: Mapping[str, Path] = ...) -> Simulation: ...
    @staticmethod
    def of_text(toml: str, folder: str | PathLike[str] = ..., set: Sequence[str] = ..., forces: Mapping[str, Force] = ..., paths: Mapping[str, Path] = ...) -> Simulation: ...
    def advance(self) -> bool: ...
    def advance_to(self, time: float) -> bool: ...
    def __iter__(self) -> Iterator[Simulation]: ...
    def __next__(self) -> Simulation: ...
    @property
    def dimension(self) -> int: ...
    @property
    def title(self) -> str: ...
    @property
    def resolved(self) -> str: ...
    @property
    def time(self) -> float: ...
    @property
    def end(self) -> float: ...
    @property
    def dt(self) -> float: ...
    @property
    def steps(self) -> int: ...
    @property
    def passes(self) -> int: ...
    @property
    def body_names(self) -> list[str]: ...
    @property
    def bodies(self) -> dict[str, Body]: ...
    @property
    def water(self) -> dict[str, Any] | None: ...
    def pressure_at(self, point: Sequence[float]) -> float | None: ...
    def save(self, folder: str | PathLike[str]) -> None: ...
    def restore(self, folder: str | PathLike[str]) -> None: ...

class Afloat:
    volume: float
    mass: float
    centre_of_mass: ndarray
    floats: bool
    displacement: float
    draft: float
    heel: float
    trim: float
    waterplane: float
    gm_roll: float
    gm_pitch: float
    freeboard: float
    position: ndarray
    rotation: ndarray
    heels: ndarray
    levers: ndarray
    trims: ndarray

def hydrostatics(
    hull: str | PathLike[str],
    mass: float,
    centre_of_mass: Sequence[float] | None = ...,
    *,
    scale: float = ...,
    density: float = ...,
    heels: Sequence[float] = ...,
) -> Afloat: ...
