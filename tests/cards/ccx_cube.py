# SPDX-License-Identifier: Apache-2.0
"""One cube of one element in CalculiX: the nominal stress of a material card over prescribed stretches."""
import os
import pathlib
import re
import subprocess

CUBE = """*NODE, NSET=NALL
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
*ELEMENT, TYPE=C3D8, ELSET=EALL
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=X0
1, 4, 5, 8
*NSET, NSET=X1
2, 3, 6, 7
*NSET, NSET=Y0
1, 2, 5, 6
*NSET, NSET=Y1
3, 4, 7, 8
*NSET, NSET=Z0
1, 2, 3, 4
*NSET, NSET=Z1
5, 6, 7, 8
"""
# What the face y = 1 does where the face x = 1 moves by {u}. The third direction is free.
FACES = {"uniaxial": "", "equibiaxial": "Y1, 2, 2, {u}\n", "pure_shear": "Y1, 2, 2, 0\n"}


def first_steps(protocol, stretches):
    """One step a stretch, so that no interpolation is needed."""
    for stretch in stretches:
        u = f"{stretch - 1:.12g}"
        yield ("*STEP, NLGEOM, INC=1000\n*STATIC\n0.5, 1, 1e-6\n*BOUNDARY\n" + f"X1, 1, 1, {u}\n" +
               FACES[protocol].format(u=u) + "*NODE PRINT, NSET=X1, TOTALS=ONLY, FREQUENCY=1000\nRF\n*END STEP\n")


def solve(folder, text):
    """What CalculiX prints into its table of results; an AssertionError with its last lines where it fails."""
    folder = pathlib.Path(folder)
    (folder / "cube.inp").write_text(text, encoding="ascii")
    (folder / "cube.dat").unlink(missing_ok=True)
    ended = subprocess.run(["ccx", "cube"], cwd=folder, capture_output=True, text=True, check=False, timeout=120,
                           env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert ended.returncode == 0 and "Job finished" in ended.stdout, ended.stdout[-1500:]
    return (folder / "cube.dat").read_text(encoding="ascii")


def material_of(card):
    return re.search(r"^\*MATERIAL, NAME=(\S+)$", card, re.M)[1]


def nominal_stress(folder, card, protocol, stretches):
    """The force on the face x = 1 of the unit cube, in the units of the card, at every stretch."""
    text = (CUBE + card + f"*SOLID SECTION, ELSET=EALL, MATERIAL={material_of(card)}\n" +
            "*BOUNDARY\nX0, 1, 1\nY0, 2, 2\nZ0, 3, 3\n" + "".join(first_steps(protocol, stretches)))
    table = solve(folder, text).split("\n")
    forces = [float(table[line + 2].split()[0]) for line, words in enumerate(table) if "total force" in words]
    assert len(forces) == len(stretches), f"{len(forces)} results for {len(stretches)} stretches"
    return forces


def sheet_stress(folder, card, stretches):
    """Nominal stresses along x and along y of a sheet with both stretches prescribed and free faces."""
    steps = ""
    for along, across in stretches:
        steps += ("*STEP, NLGEOM, INC=1000\n*STATIC\n0.5, 1, 1e-6\n*BOUNDARY\n" +
                  f"X1, 1, 1, {along - 1:.12g}\nY1, 2, 2, {across - 1:.12g}\n" +
                  "".join(f"*NODE PRINT, NSET={face}, TOTALS=ONLY, FREQUENCY=1000\nRF\n" for face in ("X1", "Y1")) +
                  "*END STEP\n")
    table = solve(folder, CUBE + card + f"*SOLID SECTION, ELSET=EALL, MATERIAL={material_of(card)}\n" +
                  "*BOUNDARY\nX0, 1, 1\nY0, 2, 2\nZ0, 3, 3\n" + steps).split("\n")
    forces = {"X1": [], "Y1": []}
    for line, words in enumerate(table):
        face = re.search(r"total force .*set (\S+) and", words)
        if face:
            forces[face[1]].append(float(table[line + 2].split()[face[1] == "Y1"]))
    assert [len(one) for one in forces.values()] == [len(stretches)] * 2, table[:20]
    return forces["X1"], forces["Y1"]


def bulk_modulus(folder, card, shrink=1e-4):
    """From the pressure on a cube all of whose edges are shortened a little: p = K (1 - J)."""
    faces = "".join(f"{axis}1, {k}, {k}, {-shrink:.12g}\n" for k, axis in enumerate("XYZ", 1))
    table = solve(folder, CUBE + card + f"*SOLID SECTION, ELSET=EALL, MATERIAL={material_of(card)}\n" +
                  "*BOUNDARY\nX0, 1, 1\nY0, 2, 2\nZ0, 3, 3\n*STEP, NLGEOM\n*STATIC\n1, 1\n*BOUNDARY\n" + faces +
                  "*NODE PRINT, NSET=X1, TOTALS=ONLY\nRF\n*END STEP\n").split("\n")
    line = next(line for line, words in enumerate(table) if "total force" in words)
    edge = 1 - shrink
    return -float(table[line + 2].split()[0]) / edge**2 / (1 - edge**3)
