"""Frames read by ParaView, with pvpython.   read_with_paraview.py WRITE_FRAMES | DIR

The program's frames number by number; of a run's folder DIR the index: as many instants as it lists, and water in all of them.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paraview import servermanager
from paraview.simple import Delete, OpenDataFile, PVDReader, UpdatePipeline
from vtkmodules.util.numpy_support import vtk_to_numpy

import expected_frames


def arrays(attributes):
    return {attributes.GetArrayName(k): vtk_to_numpy(attributes.GetArray(k)) for k in range(attributes.GetNumberOfArrays())}


def read(path):
    source = OpenDataFile(str(path))
    UpdatePipeline(proxy=source)
    grid = servermanager.Fetch(source)
    cells = {}
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        cells.setdefault(cell.GetCellType(), []).append([cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())])
    result = vtk_to_numpy(grid.GetPoints().GetData()).copy(), list(cells.items()), arrays(grid.GetPointData()), arrays(grid.GetFieldData())
    Delete(source)
    return result


def check_index(folder):
    """frames.pvd: its instants, and its pieces at each of them."""
    index = pathlib.Path(folder) / "frames.pvd"
    listed = sorted({float(time) for time in re.findall(r'timestep="([^"]+)"', index.read_text())})
    series = PVDReader(FileName=str(index))
    assert list(series.TimestepValues) == listed, (series.TimestepValues, listed)
    for time in listed:
        UpdatePipeline(time=time, proxy=series)
        pieces = servermanager.Fetch(series)
        assert pieces.GetNumberOfBlocks() >= 1 and pieces.GetNumberOfPoints() > 0, time
    print(f"{index}: {len(listed)} instants")


if os.path.isdir(sys.argv[1]):
    check_index(sys.argv[1])
else:
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([sys.argv[1], scratch], check=True)
        expected_frames.check_pieces(read, scratch)
        for dimension in "2d", "3d":
            check_index(os.path.join(scratch, dimension))
