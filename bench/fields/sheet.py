# SPDX-License-Identifier: Apache-2.0
"""A sheet with a hole between clamps, by finite elements of its own: what a camera would see of it.

Nine-node quadrilaterals around the hole, in plane stress, of an incompressible Yeoh rubber. The calibrated test has triangles
of another size and another program, so that a truth made here is nobody's own."""

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as solver

WIDTH, HEIGHT, RADIUS, THICKNESS = 24.0, 20.0, 4.0, 1.5  # mm; pulled along x
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(3)
CAUSES = ("clamp_slip", "grip_tilt", "oblique_pull", "thickness_gradient", "stiffer_half")


def lagrange(t):
    """Functions of three nodes at −1, 0, 1, and their slopes."""
    return (np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2]), np.array([t - 0.5, -2 * t, t + 0.5]))


class Sheet:
    def __init__(self, around=12, outwards=6):
        """`around`: elements along each of the four sides; `outwards`: from the hole to the side."""
        rows, columns = 2 * outwards + 1, 8 * around
        turn = np.arange(columns) / columns * 4  # side and place along it
        side, s = turn.astype(int), np.sin(np.pi * (turn % 1 - 0.5))  # closer to the corners, where stress is singular
        a, b = WIDTH / 2, HEIGHT / 2
        outer = np.choose(side[:, None], [np.c_[a + 0 * s, b * s], np.c_[-a * s, b + 0 * s], np.c_[-a + 0 * s, -b * s],
                                          np.c_[a * s, -b + 0 * s]])
        angle = (turn - 0.5) * np.pi / 2
        inner = RADIUS * np.c_[np.cos(angle), np.sin(angle)]
        share = 0.5 - 0.5 * np.cos(np.pi * np.arange(rows) / (rows - 1))
        self.nodes = (inner[None] + share[:, None, None] * (outer - inner)[None]).reshape(-1, 2)
        self.elements = np.array([[(2 * r + i) * columns + (2 * c + j) % columns for i in range(3) for j in range(3)]
                                  for r in range(outwards) for c in range(columns // 2)])
        at = self.nodes[self.elements]
        slopes, weights, places, values = [], [], [], []
        for x, wx in zip(POINTS, WEIGHTS):
            for y, wy in zip(POINTS, WEIGHTS):
                (nx, dx), (ny, dy) = lagrange(x), lagrange(y)
                N, local = np.outer(nx, ny).ravel(), np.array([np.outer(dx, ny).ravel(), np.outer(nx, dy).ravel()])
                J = np.einsum("da,eai->edi", local, at)
                slopes.append(np.einsum("edi,ia->eda", np.linalg.inv(J), local))
                weights.append(np.abs(np.linalg.det(J)) * wx * wy)
                places.append(np.einsum("a,eai->ei", N, at))
                values.append(N)
        self.slopes, self.weights, self.places = np.stack(slopes, 1), np.stack(weights, 1), np.stack(places, 1)
        self.dofs = (2 * self.elements[:, :, None] + np.arange(2)).reshape(len(self.elements), 18)
        near = 1e-9
        self.left = np.flatnonzero(self.nodes[:, 0] < -a + near)
        self.right = np.flatnonzero(self.nodes[:, 0] > a - near)

    def equilibrium(self, pull, cause=None, size=0.0, direction=0.0, c10=60.0, c20=8.0, start=None):
        """Displacements of the nodes (n × 2, mm) and the force on the right side (mN) where it has moved by `pull`, mm.

        `size` is the amplitude of the cause, as the mechanism of its name has it; `direction` in degrees."""
        turned = np.array([np.cos(np.radians(direction)), np.sin(np.radians(direction))])
        along = self.places @ turned / np.hypot(turned[0] * WIDTH, turned[1] * HEIGHT)
        h = np.ones_like(along)
        if cause == "thickness_gradient":
            h = 1 + size * along
        if cause == "stiffer_half":
            h = 1 + size * np.sign(along)
        a = WIDTH / 2
        u = np.c_[pull * (self.nodes[:, 0] + a) / (2 * a), 0 * self.nodes[:, 1]] if start is None else start.copy()
        u[self.left] = [size * pull if cause == "clamp_slip" else 0, 0]
        s = self.nodes[self.right, 1] / (HEIGHT / 2)
        u[self.right] = np.c_[pull * (1 + (size * s if cause == "grip_tilt" else 0 * s)),
                              (pull * np.tan(np.radians(size)) if cause == "oblique_pull" else 0) + 0 * s]
        held = np.zeros(u.size, bool)
        for edge in (self.left, self.right):
            held[2 * edge] = held[2 * edge + 1] = True
        free = np.flatnonzero(~held)
        for _ in range(15):
            f, K = self.assemble(u, h, c10, c20)
            step = solver.spsolve(K[free][:, free], f[free])
            u.reshape(-1)[free] -= step
            if np.abs(step).max() < 1e-10:
                f, _ = self.assemble(u, h, c10, c20)
                return u, f[2 * self.right].sum() * THICKNESS
        raise RuntimeError("no equilibrium was found")

    def frames(self, pulls, cause=None, size=0.0, direction=0.0):
        """[(displacements, force)] of rising pulls, each begun from the one before, drawn out."""
        found, u, before = [], None, None
        for pull in pulls:
            u, force = self.equilibrium(pull, cause, size, direction, start=None if u is None else u * pull / before)
            found.append((u, force))
            before = pull
        return found

    def assemble(self, u, h, c10, c20):
        """Nodal forces per thickness (kPa·mm) and the stiffness: P = 2 W′ (F − J⁻² F⁻ᵀ), W = c10 (I1 − 3) + c20 (I1 − 3)²."""
        F = np.einsum("eai,eqda->eqid", u[self.elements], self.slopes) + np.eye(2)
        J = np.linalg.det(F)
        inverse = np.linalg.inv(F)  # [d, i]
        T = np.swapaxes(inverse, -1, -2)
        third = (J**-2)[..., None, None]
        excess = (F**2).sum((-1, -2)) + J**-2 - 3
        A = F - third * T
        w1 = (c10 + 2 * c20 * excess)[..., None, None]
        P = 2 * w1 * A
        # ∂P_iJ/∂F_kL
        eye = np.einsum("ik,jl->ijkl", np.eye(2), np.eye(2))
        third4, w4 = third[..., None, None], w1[..., None, None]
        D = 2 * w4 * (eye + 2 * third4 * np.einsum("eqij,eqkl->eqijkl", T, T) + third4 * np.einsum("eqil,eqkj->eqijkl", T, T))
        D += 8 * c20 * np.einsum("eqij,eqkl->eqijkl", A, A)
        weight = self.weights * h
        f = np.einsum("eq,eqij,eqja->eai", weight, P, self.slopes).reshape(len(self.elements), 18)
        k = np.einsum("eq,eqijkl,eqja,eqlb->eaibk", weight, D, self.slopes, self.slopes, optimize=True)
        k = k.reshape(len(self.elements), 18, 18)
        forces = np.bincount(self.dofs.ravel(), f.ravel(), u.size)
        rows = np.repeat(self.dofs, 18, 1).ravel()
        columns = np.tile(self.dofs, (1, 18)).ravel()
        return forces, sparse.csr_matrix((k.ravel(), (rows, columns)), (u.size, u.size))

    def write_triangles(self, path):
        """Its quadrilaterals as two triangles of six nodes each, for Gmsh and what reads it."""
        halves = [(0, 6, 2, 3, 4, 1), (8, 2, 6, 5, 4, 7)]  # of the nodes 3 i + j: corners, then middles of edges
        triangles = [[element[k] + 1 for k in half] for element in self.elements for half in halves]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(self.nodes))]
        lines += [f"{k} {float(x)!r} {float(y)!r} 0" for k, (x, y) in enumerate(self.nodes, 1)]
        lines += ["$EndNodes", "$Elements", str(len(triangles))]
        lines += [f"{k} 9 2 1 1 " + " ".join(map(str, nodes)) for k, nodes in enumerate(triangles, 1)]
        path.write_text("\n".join([*lines, "$EndElements"]) + "\n", encoding="utf-8")

    def seen(self, spacing, margin=1.0):
        """Nodes that a camera follows: a spacing apart, and off the edges where subsets do not reach."""
        kept = []
        for k, (x, y) in enumerate(self.nodes):
            inside = max(abs(x) - WIDTH / 2, abs(y) - HEIGHT / 2, RADIUS - np.hypot(x, y)) < -margin
            if inside and all(np.hypot(*(self.nodes[k] - self.nodes[j])) >= spacing for j in kept):
                kept.append(k)
        return kept
