"""Scenes as dictionaries."""
from __future__ import annotations

import json
from collections.abc import Mapping


def toml_value(value) -> str:
    """As TOML writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(k)} = {toml_value(v)}" for k, v in value.items()) + "}"
    if hasattr(value, "tolist"):  # of NumPy
        return toml_value(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    if isinstance(value, (int, float)):
        return repr(value)
    raise TypeError(f"{value!r} of type {type(value).__name__}: a scene holds numbers, texts, lists and tables")


def _key(key: str) -> str:
    return key if key.replace("_", "").replace("-", "").isalnum() else json.dumps(key)


def scene_text(scene: Mapping) -> str:
    """A scene of nested dictionaries as TOML; lists of dictionaries are arrays of tables, such as bodies.

    >>> print(scene_text({"time": {"end": 0.1}, "body": [{"name": "a"}]}))
    time = {end = 0.1}
    body = [{name = "a"}]
    """
    return "\n".join(f"{_key(key)} = {toml_value(value)}" for key, value in scene.items())
