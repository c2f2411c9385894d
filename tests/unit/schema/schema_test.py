"""The schemas that the program prints: they hold for every scene and study of the examples, they refuse what the readers refuse.

  schema_test.py PATH_OF_SPLASHDOWN FOLDER_OF_EXAMPLES
Skipped (exit code 77) without python3-jsonschema.
"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

try:
    import jsonschema
except ImportError:
    print("skipped: no Python module jsonschema (Debian: python3-jsonschema)")
    sys.exit(77)

program, examples = sys.argv[1], pathlib.Path(sys.argv[2])
failures = 0


def check(what, good):
    global failures
    if not good:
        failures += 1
        print("FAIL ", what)


def schema_of(what):
    text = subprocess.run([program, "schema", what], check=True, capture_output=True, text=True).stdout
    schema = json.loads(text)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def tables(node, path=()):
    """Every table of a file: its path and whether it is one of a list."""
    if isinstance(node, dict):
        yield path
        for key, value in node.items():
            yield from tables(value, path + (key,))
    elif isinstance(node, list) and node and isinstance(node[0], dict):
        for i, value in enumerate(node):
            yield from tables(value, path + (i,))


def values(node, path=()):
    if isinstance(node, dict):
        for key, value in node.items():
            yield from values(value, path + (key,))
    elif isinstance(node, list) and node and isinstance(node[0], dict):
        for i, value in enumerate(node):
            yield from values(value, path + (i,))
    else:
        yield path


def at(node, path):
    for step in path:
        node = node[step]
    return node


def changed(node, path, value):
    node = copy.deepcopy(node)
    at(node, path[:-1])[path[-1]] = value
    return node


names_of_users = {"constants", "reference"}  # tables whose keys are the user's


def damaged(content):
    """Files with one mistake each that any reader has to refuse."""
    for path in tables(content):
        if names_of_users.isdisjoint(map(str, path)):
            yield f"unknown key in {path}", changed(content, path + ("no_such_key",), 1.0)
    for path in values(content):
        value = at(content, path)
        if path[-1] in ("values", "exact") or not names_of_users.isdisjoint(map(str, path)):
            continue  # words and numbers both are good there
        if isinstance(value, str):
            yield f"number for the word {path}", changed(content, path, 1.5)
        else:
            yield f"word for {path} = {value}", changed(content, path, "word")
        yield f"boolean for {path}", changed(content, path, True)
        yield f"table for {path}", changed(content, path, {"no": 1})


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return repr(value)


def exit_code_of_check(content, folder):
    with tempfile.NamedTemporaryFile("w", suffix=".toml", dir=folder) as file:
        file.writelines(f"{json.dumps(key)} = {toml(value)}\n" for key, value in content.items())
        file.flush()
        return subprocess.run([program, "check", file.name], capture_output=True, timeout=60).returncode


schemas = {"scene": schema_of("scene"), "study": schema_of("study")}
count = 0
for file in sorted(examples.glob("*/*.toml")):
    kind = next((kind for kind in schemas if file.name.startswith(kind)), None)
    if not kind:
        continue
    content = tomllib.loads(file.read_text())
    for error in schemas[kind].iter_errors(content):
        check(f"{file} is refused: {error.message}", False)
    mistakes = list(damaged(content))
    for what, wrong in mistakes:
        check(f"{file}: {what} is not refused", not schemas[kind].is_valid(wrong))
    count += 1 + len(mistakes)
check("no examples", count > 100)

# What the schema refuses the reader refuses, and the reader takes what the examples say: on copies without hull files.
with tempfile.TemporaryDirectory() as folder:
    for example in ("floating_box", "hinged_plate"):
        content = tomllib.loads((examples / example / "scene.toml").read_text())
        check(f"{example} is good", exit_code_of_check(content, folder) == 0)
        for what, wrong in damaged(content):
            check(f"{example}: {what} passes the reader", exit_code_of_check(wrong, folder) == 2)
            count += 1

print(f"{count} files, {failures} failures")
sys.exit(failures > 0)
