"""What write_frames has written, by the same formulas, held against what somebody else's reader finds, number by number.

A reader gives (points, [(type, cells), ...] with VTK's numbers of types, {name: point data}, {name: field data}) of a file.
"""
import pathlib

import numpy as np

VERTEX, LINE, TRIANGLE, TETRAHEDRON = 1, 3, 5, 10


def place(nodes, d):
    i = np.arange(nodes)
    x = np.zeros((nodes, 3))
    for k in range(d):
        x[:, k] = ((i * (k + 1)) % 1000) / 8.0 - k
    return x


def simplices(nodes, corners):
    return np.arange(max(nodes - corners, 0))[:, None] + np.arange(corners)[None, :]


def equal(found, expected, what):
    found = np.asarray(found)
    assert found.size == expected.size, f"{what}: {found.size} numbers instead of {expected.size}"
    assert np.array_equal(found.reshape(expected.shape), expected, equal_nan=expected.dtype.kind == "f"), what
    if expected.dtype.kind == "f":
        assert found.dtype == np.float64, f"{what} is {found.dtype}"


def check_fluid(read, path, d, nodes):
    points, cells, data, field = read(path)
    i = np.arange(nodes)
    equal(points, place(nodes, d), f"{path}: points")
    meshed = [(kind, c) for kind, c in cells if kind != VERTEX]
    whole = simplices(nodes, d + 1)
    equal(np.concatenate([c for _, c in meshed]) if meshed else np.zeros((0, d + 1), int), whole, f"{path}: cells")
    assert all(kind == (TRIANGLE if d == 2 else TETRAHEDRON) for kind, _ in meshed), path
    single = np.concatenate([np.ravel(c) for kind, c in cells if kind == VERTEX])
    equal(single, i[-1:], f"{path}: drops")
    assert sorted(data) == ["drop_diameter", "kind", "p", "v", "wall"], sorted(data)
    equal(data["v"], -place(nodes, d), f"{path}: v")
    equal(data["p"], 1000.0 * i + 0.125, f"{path}: p")
    equal(data["drop_diameter"], np.where(i % 3 == 0, i / 64.0, 0.0), f"{path}: drop_diameter")
    equal(data["kind"], np.where(i == nodes - 1, 5, i % 5), f"{path}: kind")
    equal(data["wall"], i % 5 - 1, f"{path}: wall")
    equal(field["TimeValue"], np.array([0.25]), f"{path}: time")


def check_hull(read, path, d):
    points, cells, data, field = read(path)
    equal(points, place(d + 2, d), f"{path}: points")
    assert len(cells) == 1 and cells[0][0] == (LINE if d == 2 else TRIANGLE), path
    equal(cells[0][1], np.arange(2)[:, None] + np.arange(d)[None, :], f"{path}: facets")
    p = 1000.0 * np.arange(d + 2) + 0.125
    p[0] = np.nan
    equal(data["p"], p, f"{path}: p")
    equal(data["v"], -place(d + 2, d), f"{path}: v")
    equal(field["forward"], np.array([0.0, 1.0, 0.0]), f"{path}: forward")


def check_pieces(read, folder):
    for d in 2, 3:
        for nodes in 1, 7, 8192, 8193, 30000:
            stem = pathlib.Path(folder) / "pieces" / f"{d}d_{nodes}"
            check_fluid(read, f"{stem}.vtu", d, nodes)
            check_hull(read, f"{stem}_a_hull___more.vtu", d)
    print("all pieces have the numbers that were written")
