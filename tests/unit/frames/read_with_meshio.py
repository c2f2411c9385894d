"""Frames read by meshio.   read_with_meshio.py WRITE_FRAMES"""
import subprocess
import sys
import tempfile

import meshio

import expected_frames


def read(path):
    mesh = meshio.read(path)
    numbers = {"vertex": 1, "line": 3, "triangle": 5, "tetra": 10}
    return mesh.points, [(numbers[block.type], block.data) for block in mesh.cells], mesh.point_data, mesh.field_data


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], folder], check=True)
    expected_frames.check_pieces(read, folder)
