# SPDX-License-Identifier: Apache-2.0
"""A quarter of a thin specimen in CalculiX: one layer of twenty-node bricks of half the thickness, its mid-plane held."""
import math
import os
import pathlib
import subprocess

THICKNESS = 0.02  # of the half, mm; beside it the specimen is a membrane


class Quarter:
    """`columns` × `rows` bricks over map(s, t) → (x, y), s and t from 0 to 1."""

    def __init__(self, columns, rows, place):
        self.nodes, self.elements, self.at = {}, [], {}
        for k in range(3):
            for j in range(2 * rows + 1):
                for i in range(2 * columns + 1):
                    if (i % 2) + (j % 2) + (k % 2) > 1:
                        continue
                    self.at[i, j, k] = len(self.at) + 1
                    x, y = place(i / (2 * columns), j / (2 * rows))
                    self.nodes[self.at[i, j, k]] = (x, y, k * THICKNESS / 2)
        turn = self.turns(place)
        for j in range(0, 2 * rows, 2):
            for i in range(0, 2 * columns, 2):
                ring = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
                if turn < 0:
                    ring.reverse()
                middle = [((a[0] + b[0]) // 2, (a[1] + b[1]) // 2) for a, b in zip(ring, ring[1:] + ring[:1])]
                corners = [(*one, k) for k in (0, 2) for one in ring]
                edges = [(*one, k) for k in (0, 2) for one in middle] + [(*one, 1) for one in ring]
                self.elements.append([self.at[one] for one in corners + edges])

    @staticmethod
    def turns(place):
        (x0, y0), (x1, y1), (x2, y2) = place(0.5, 0.5), place(0.51, 0.5), place(0.5, 0.51)
        return (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)

    def where(self, test):
        return [number for number, node in self.nodes.items() if test(*node)]

    def node_at(self, x, y):
        return min(self.nodes, key=lambda n: math.dist(self.nodes[n], (x, y, 0)))


def strip(length, width):
    return lambda s, t: (s * length / 2, t * width / 2)


def dog_bone(length, width, section, narrow, fillet):
    def half(x):
        beyond = x - section / 2
        if beyond <= 0:
            return narrow / 2
        return width / 2 if beyond >= fillet else min(width / 2, narrow / 2 + fillet - math.sqrt(fillet**2 - beyond**2))
    rise = (width - narrow) / 2
    ends = [0, section / 2, section / 2 + math.sqrt(rise * (2 * fillet - rise)), length / 2]

    def place(s, t):  # a third of the columns in every part
        part = min(2, int(3 * s + 1e-12))
        x = ends[part] + (3 * s - part) * (ends[part + 1] - ends[part])
        return x, t * half(x)
    return place


def plate_with_hole(length, width, radius):
    l, w = length / 2, width / 2

    def place(s, t):
        x, y = (l, 2 * s * w) if s <= 0.5 else (2 * (1 - s) * l, w)
        angle = math.atan2(y, x)
        out = t**1.5
        return (radius * math.cos(angle) * (1 - out) + out * x, radius * math.sin(angle) * (1 - out) + out * y)
    return place


def solve(folder, mesh, length, card, stretches, marks, first=0.5):
    """Force on the grip as run() has it, and the distance of marks over that unloaded, at every stretch of the grips.
    `marks`: (x, y) of nodes on an axis."""
    nodes = [mesh.node_at(*mark) for mark in marks]
    forces, moved = run(folder, mesh, length, card, stretches, nodes, first)
    return forces, [[1 + max(found[n][0] / x if x else 0, -9) if x else 1 + found[n][1] / y for n, (x, y) in zip(nodes, marks)]
                    for found in moved]


def run(folder, mesh, length, card, stretches, nodes, first=0.5):
    """Force on the grip per mm of thickness, in the units of the card times mm, and {node: displacement} of these nodes,
    at every stretch of the grips. `first`: the first part of a step that is tried."""
    near = 1e-9 * length
    sets = {"GRIP": mesh.where(lambda x, y, z: abs(x - length / 2) < near), "X0": mesh.where(lambda x, y, z: abs(x) < near),
            "Y0": mesh.where(lambda x, y, z: abs(y) < near), "Z0": mesh.where(lambda x, y, z: abs(z) < near),
            "MARKS": nodes}
    text = "*NODE, NSET=NALL\n" + "".join(f"{n}, {x:.12g}, {y:.12g}, {z:.12g}\n" for n, (x, y, z) in mesh.nodes.items())
    text += "*ELEMENT, TYPE=C3D20R, ELSET=EALL\n"
    for number, element in enumerate(mesh.elements, 1):
        text += f"{number}, " + ", ".join(map(str, element[:10])) + ",\n" + ", ".join(map(str, element[10:])) + "\n"
    for name, nodes in sets.items():
        text += f"*NSET, NSET={name}\n" + "".join(f"{n},\n" for n in nodes)
    material = [line for line in card.splitlines() if line.startswith("*MATERIAL")][0].split("NAME=")[1]
    text += card + f"*SOLID SECTION, ELSET=EALL, MATERIAL={material}\n"
    text += "*BOUNDARY\nX0, 1, 1\nY0, 2, 2\nZ0, 3, 3\nGRIP, 2, 2, 0\n"
    for stretch in stretches:
        text += (f"*STEP, NLGEOM, INC=1000\n*STATIC\n{first}, 1, 1e-6\n*BOUNDARY\n"
                 f"GRIP, 1, 1, {(stretch - 1) * length / 2:.12g}\n*NODE PRINT, NSET=GRIP, TOTALS=ONLY, FREQUENCY=1000\nRF\n"
                 "*NODE PRINT, NSET=MARKS, FREQUENCY=1000\nU\n*END STEP\n")
    folder = pathlib.Path(folder)
    (folder / "plate.inp").write_text(text, encoding="ascii")
    (folder / "plate.dat").unlink(missing_ok=True)
    ended = subprocess.run(["ccx", "plate"], cwd=folder, capture_output=True, text=True, check=False, timeout=300,
                           env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert ended.returncode == 0 and "Job finished" in ended.stdout, ended.stdout[-1500:]
    forces, moved = [], []
    lines = (folder / "plate.dat").read_text(encoding="ascii").split("\n")
    for at, line in enumerate(lines):
        if "total force" in line:
            forces.append(2 * float(lines[at + 2].split()[0]) / (2 * THICKNESS) * 2)
        elif "displacements" in line:
            found = {}
            for row in lines[at + 2:at + 2 + len(set(sets["MARKS"]))]:
                words = row.split()
                found[int(words[0])] = [float(word) for word in words[1:4]]
            moved.append(found)
    return forces, moved
