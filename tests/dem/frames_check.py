#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the frames of a run as ParaView and OVITO users do, with VTK and ASE.

Usage: frames_check.py DIR    after `tangency-dem run ... --out DIR`

ParaView: every file that frames.pvd lists is opened by VTK's reader, and its filter Tensor Glyph
draws a sphere of diameter 1 by the tensor `axes`; each glyph's bounds must be those of the
ellipsoid with the row's `semi_axes` and `orientation`, about the row's point.
OVITO: frames.xyz is opened by ASE's reader of extended XYZ; positions, cell, periodicity,
`orientation` (x y z w) and `aspherical_shape` (semi-axes) must be those of the VTK files.
Exit status: 0, or 1 with the first difference. Packages: .ci/setup frames
"""
import io
import os
import sys
import xml.etree.ElementTree as xml

import ase.io
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from checks import require  # noqa: E402


def rotation(q):
    """R of a quaternion x, y, z, w."""
    x, y, z, w = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def read_frame(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def glyphs_of(frame, resolution, extract_eigenvalues):
    """Points of each particle's glyph."""
    sphere = vtk.vtkSphereSource()
    sphere.SetRadius(0.5)
    sphere.SetThetaResolution(resolution)
    sphere.SetPhiResolution(resolution)
    glyph = vtk.vtkTensorGlyph()
    glyph.SetInputData(frame)
    glyph.SetSourceConnection(sphere.GetOutputPort())
    glyph.SetExtractEigenvalues(extract_eigenvalues)
    glyph.ColorGlyphsOff()
    glyph.Update()
    points = vtk_to_numpy(glyph.GetOutput().GetPoints().GetData())
    return points.reshape(frame.GetNumberOfPoints(), -1, 3)


def with_symbols(text):
    """ASE takes a species for a chemical symbol: X, that of none, for the types' names."""
    left, lines = 0, []
    for line in text.splitlines():
        if left == 0:
            left = int(line) + 1
        else:
            left -= 1
            if "Properties=" not in line:
                line = "X " + line.split(maxsplit=1)[1]
        lines.append(line)
    return "\n".join(lines) + "\n"


RESOLUTION = 64  # parts of the sphere's circles: it lies up to 1 - cos(pi / 64) inside of a true one


def check_glyphs(path, points, data, glyphs):
    for i, glyph in enumerate(glyphs):
        turn, axes = rotation(data["orientation"][i]), data["semi_axes"][i]
        extent = np.sqrt((turn**2) @ axes**2)
        for side, found in ((-1, glyph.min(axis=0)), (1, glyph.max(axis=0))):
            require(np.all(np.abs(found - (points[i] + side * extent)) < 3e-3 * axes.max()),
                    f"{path}: particle {i} spans {found}, not {points[i] + side * extent}")


def check_vtk(path):
    frame = read_frame(path)
    count = frame.GetNumberOfPoints()
    require(count > 0, f"{path}: no point")
    data = {name: vtk_to_numpy(frame.GetPointData().GetArray(name))
            for name in ("axes", "orientation", "semi_axes", "velocity", "type", "contacts")}
    points = vtk_to_numpy(frame.GetPoints().GetData())
    for extract_eigenvalues in (False, True):  # the tensor is symmetric: alike
        check_glyphs(path, points, data, glyphs_of(frame, RESOLUTION, extract_eigenvalues))
    return points, data, vtk_to_numpy(frame.GetFieldData().GetArray("cell")).reshape(3, 3)


def main(directory):
    index = xml.parse(os.path.join(directory, "frames.pvd")).getroot().iter("DataSet")
    files = [entry.get("file") for entry in index]
    require(files, "frames.pvd lists no frame")
    with open(os.path.join(directory, "frames.xyz"), encoding="ascii") as file:
        frames = ase.io.read(io.StringIO(with_symbols(file.read())), index=":", format="extxyz")
    require(len(frames) == len(files), f"{len(files)} frames of VTK, {len(frames)} of extended XYZ")
    for file, atoms in zip(files, frames):
        points, data, cell = check_vtk(os.path.join(directory, file))
        size = np.abs(cell).max()
        for name, here, there in (("positions", points, atoms.positions),
                                  ("cell", cell, atoms.cell.array),
                                  ("orientation", data["orientation"], atoms.arrays["orientation"]),
                                  ("aspherical_shape", data["semi_axes"],
                                   atoms.arrays["aspherical_shape"])):
            require(here.shape == there.shape and np.allclose(here, there, rtol=1e-6, atol=1e-6 * size),
                    f"{file}: {name} of the two kinds of frame differ")
        inside = np.linalg.solve(cell.T, points.T).T[:, atoms.pbc]
        require(np.all((inside > -1e-6) & (inside < 1 + 1e-6)), f"{file}: a point outside of the cell")
    print(f"{len(files)} frames of {len(points)} particles: as they should be")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
