#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a collection of VTK files with a reader that is not ours, and prints as JSON what stands in each grid: time, number
of points and cells, names of the fields, outer radius at mid-length, smallest and largest value of each field of cells."""
import json
import pathlib
import sys
import xml.etree.ElementTree

try:
    import meshio
except ImportError:
    sys.exit(77)

collection = pathlib.Path(sys.argv[1])
found = []
for entry in xml.etree.ElementTree.parse(collection).getroot().iter("DataSet"):
    grid = meshio.read(collection.parent / entry.get("file"))
    assert [block.type for block in grid.cells] == ["quad"], grid.cells
    middle = [point for point in grid.points if abs(point[1]) < 1e-9]
    found.append({"time": float(entry.get("timestep")), "points": len(grid.points), "cells": len(grid.cells[0].data), "outer": max(point[0] for point in middle),
                  "of_points": sorted(grid.point_data), "of_cells": {name: [float(values[0].min()), float(values[0].max())] for name, values in grid.cell_data.items()}})
print(json.dumps(found))
