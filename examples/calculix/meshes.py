#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""meshes.py: writes strip_mesh.inp and tube_mesh.inp, hexahedra of 20 nodes in CalculiX's order, mm.

strip: an eighth of a strip of 40 x 10 x 1 mm, symmetric about x = 0, y = 0, z = 0; GRIP is the clamped end x = 20.
tube: a quarter of a ring of 0.5 mm, radii 1.0 and 1.5 mm; INSIDE are the faces under pressure, node set PROBE lies on
the outer radius at y = 0."""
import math
import pathlib

# Nodes of a hexahedron on the grid of half steps: corners, mid-edges of the bottom, of the top, of the sides.
local = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2),
         (1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
         (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]


def grid(counts, place, sets):
    """Elements over a box of counts; place maps fractions in [0, 1] to x, y, z; sets maps a name to a test of them."""
    nodes, elements = {}, []
    for i in range(counts[0]):
        for j in range(counts[1]):
            for k in range(counts[2]):
                corner = (2 * i, 2 * j, 2 * k)
                keys = [tuple(a + b for a, b in zip(corner, step)) for step in local]
                elements.append([nodes.setdefault(key, len(nodes) + 1) for key in keys])
    fraction = {key: tuple(a / (2 * n) for a, n in zip(key, counts)) for key in nodes}
    text = "*NODE, NSET=ALL\n"
    for key, number in nodes.items():
        text += "%d, %.12g, %.12g, %.12g\n" % (number, *(round(v, 12) for v in place(*fraction[key])))
    text += "*ELEMENT, TYPE=C3D20R, ELSET=SOLID\n"
    for number, element in enumerate(elements, 1):
        text += "%d, %s,\n%s\n" % (number, ", ".join(map(str, element[:15])), ", ".join(map(str, element[15:])))
    for name, inside in sets.items():
        members = [number for key, number in nodes.items() if inside(*fraction[key])]
        text += "*NSET, NSET=%s\n" % name + "".join("%d,\n" % number for number in members)
    return text, len(elements)


def strip():
    text, _ = grid((4, 2, 1), lambda u, v, w: (20 * u, 5 * v, 0.5 * w),
                   {"MIDDLE": lambda u, v, w: u == 0, "PLANE": lambda u, v, w: v == 0,
                    "FACE": lambda u, v, w: w == 0, "GRIP": lambda u, v, w: u == 1})
    return text


def tube():
    angular, radial = 4, 3

    def place(u, v, w):
        radius, angle = 1 + 0.5 * u, math.pi / 2 * v
        return radius * math.cos(angle), radius * math.sin(angle), 0.5 * w
    text, count = grid((radial, angular, 1), place,
                       {"PLANEX": lambda u, v, w: v == 0, "PLANEY": lambda u, v, w: v == 1,
                        "ENDS": lambda u, v, w: w in (0, 1), "PROBE": lambda u, v, w: u == 1 and v == 0 and w == 0})
    # Elements are counted with the angle second: those on the inside are the first `angular`. Their face at the inner
    # radius has the nodes 1, 5, 8, 4 of the corners, which CalculiX calls face 6.
    return text + "*ELSET, ELSET=INSIDE\n" + "".join("%d,\n" % number for number in range(1, angular + 1))


folder = pathlib.Path(__file__).parent
(folder / "strip_mesh.inp").write_text(strip())
(folder / "tube_mesh.inp").write_text(tube())
