# SPDX-License-Identifier: Apache-2.0
"""How often the 95 % intervals of a fit to a field hold the truth.

The field is that of plane_specimen: a clamped plate with a hole, nine-node quadrilaterals on a finer mesh than that of the
fit. Points lie on a grid of the middle part, every draw has its own noise, and full_field fits it with triangles between
measured sides. With the interval right, of 200 draws 93 to 97 % hold the truth (two standard deviations: 92 to 98 %).

With `--subset` points err together, as those of image correlation do whose subsets overlap. The fit takes them as independent,
so that its intervals are too narrow; what counts is how often a warning says so. With a coarse `--mesh` the same holds of the
bias by the mesh."""

import argparse
import concurrent.futures
import json
import random
import subprocess
from pathlib import Path

import meshio

from noise import errors

LENGTH, WIDTH, HOLE, THICKNESS, SEEN = 40.0, 20.0, 4.0, 1.5, 12.0  # mm
TRUTHS = {
    "neo_hooke": ({"type": "neo_hooke"}, {"mu": 120}),
    "yeoh": ({"type": "yeoh", "parameters": {"c30": {"fixed": 0}}}, {"c10": 60, "c20": 8}),
    "gho": ({"type": "gho"},
            {"mu": 20, "kappa": 0.1, "k1": 30, "k2": 1.2, "theta": 40}),
}


def simulate(tunica, model, values, stretches, folder):
    """(frame → [(x, y, u, v)] at the nodes, force in mN) of the specimen that is the truth."""
    folder.mkdir(parents=True)
    (folder / "rows.csv").write_text("stretch,stress [kPa]\n" + "".join(f"{s},0\n" for s in stretches), encoding="utf-8")
    test = {"type": "plane_specimen", "shape": "plate_with_hole", "length": f"{LENGTH} mm", "width": f"{WIDTH} mm",
            "hole_radius": f"{HOLE} mm", "elements": [24, 16],
            "data": {"file": "rows.csv", "columns": {"stretch": "stretch", "stress": "stress"},
                     "stress_measure": "first_piola_kirchhoff"}}
    experiment = {"format": 1, "models": {"m": model}, "tests": {"plate": test}, "optimizers": {"lm": {"type": "ceres_lm"}},
                  "runs": [{"model": "m", "optimizer": "lm"}]}
    (folder / "experiment.json").write_text(json.dumps(experiment), encoding="utf-8")
    (folder / "values.json").write_text(json.dumps(values), encoding="utf-8")
    rows = ",".join(str(k + 1) for k in range(len(stretches)))
    subprocess.run([tunica, "simulate", "experiment.json", "--parameters", "values.json", "--fields", f"plate:{rows}", "-o",
                    "out"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    stress = [float(line.split(",")[1]) for line in (folder / "out/plate.csv").read_text().splitlines()[1:]]
    frames = []
    for k, value in enumerate(stress):
        grid = meshio.read(folder / f"out/plate_{k + 1}.vtu")
        moved = grid.point_data["displacement [mm]"] if "displacement [mm]" in grid.point_data else grid.point_data["displacement"]
        frames.append(([(p[0] - u[0], p[1] - u[1], u[0], u[1]) for p, u in zip(grid.points, moved)],
                       value * WIDTH * THICKNESS))
    return frames


def seen(points, spacing):
    """Which nodes the camera follows: a spacing apart and off the edges."""
    kept = []
    for k, (x, y, _, _) in enumerate(points):
        inside = abs(x) <= SEEN and abs(y) <= WIDTH / 2 - 0.4 and (x * x + y * y) ** 0.5 >= HOLE + 0.4
        if inside and all((x - points[j][0]) ** 2 + (y - points[j][1]) ** 2 >= spacing**2 for j in kept):
            kept.append(k)
    return kept


def fit(tunica, model, frames, chosen, sigma, subset, mesh, seed, folder):
    noise = random.Random(seed)
    folder.mkdir(parents=True)
    lines, loads = ["step,x [mm],y [mm],ux [mm],uy [mm]"], ["step,load [mN]"]
    for step, (points, force) in enumerate(frames, 1):
        loads.append(f"{step},{force * (1 + noise.gauss(0, 0.005))!r}")
        wrong = [errors([points[k][:2] for k in chosen], sigma, subset, noise) for _ in range(2)]
        for k, du, dv in zip(chosen, *wrong):
            x, y, u, v = map(float, points[k])
            lines.append(f"{step},{x!r},{y!r},{float(u + du)!r},{float(v + dv)!r}")
    (folder / "field.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    (folder / "load.csv").write_text("\n".join(loads) + "\n", encoding="utf-8")
    test = {"type": "full_field", "thickness": f"{THICKNESS} mm", "material_angle": "90 deg", "mesh": {"size": f"{mesh} mm"},
            "shape": {"rectangle": [f"{2 * SEEN} mm", f"{WIDTH} mm"], "corner": [f"{-SEEN} mm", f"{-WIDTH / 2} mm"],
                      "holes": [{"centre": [0, 0], "radius": f"{HOLE} mm"}]},
            "boundary": {"left": "measured", "right": "measured"},
            "data": [{"file": "field.csv", "columns": {"step": "step", "x": "x", "y": "y", "ux": "ux", "uy": "uy"},
                      "noise": {"absolute": f"{sigma} mm"}},
                     {"file": "load.csv", "columns": {"step": "step", "force_right": "load"}, "noise": {"relative": 0.005}}]}
    experiment = {"format": 1, "models": {"m": model}, "tests": {"plate": test}, "objective": "least_squares",
                  "optimizers": {"lm": {"type": "ceres_lm", "starts": 1}}, "stop": {"max_evaluations": 60},
                  "runs": [{"model": "m", "optimizer": "lm"}]}
    (folder / "experiment.json").write_text(json.dumps(experiment), encoding="utf-8")
    subprocess.run([tunica, "run", "experiment.json", "-o", "out", "--quiet", "-j", "1"], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)
    result = json.loads((folder / "out/result.json").read_text(encoding="utf-8"))
    best = result["runs"][0]["best"]
    warned = any("err together" in warning for warning in result["warnings"])
    coarse = any("a finer mesh would move" in warning for warning in result["warnings"])
    return best["parameters"], best["misfit"]["reduced_chi_square"], warned, coarse


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("tunica", type=Path)
    arguments.add_argument("out", type=Path, help="a new folder")
    arguments.add_argument("--models", nargs="*", default=list(TRUTHS))
    arguments.add_argument("--draws", type=int, default=200)
    arguments.add_argument("--seed", type=int, default=501)
    arguments.add_argument("--sigma", type=float, default=0.005, help="noise of a displacement, mm")
    arguments.add_argument("--subset", type=float, default=0, help="width of the subsets, mm; 0 = points err by themselves")
    arguments.add_argument("--mesh", type=float, default=1.3, help="size of the triangles, mm")
    arguments.add_argument("--spacing", type=float, default=0.9, help="of the points, mm")
    arguments.add_argument("--stretches", type=float, nargs="*", default=[1.08, 1.2, 1.35], help="one a frame")
    arguments.add_argument("--jobs", type=int, default=2)
    given = arguments.parse_args()
    tunica = given.tunica.resolve()
    for name in given.models:
        model, truth = TRUTHS[name]
        frames = simulate(tunica, model, truth, given.stretches, given.out / f"{name}_truth")
        chosen = seen(frames[0][0], given.spacing)
        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
            found = list(pool.map(
                lambda k: fit(tunica, model, frames, chosen, given.sigma, given.subset, given.mesh, given.seed * 1000 + k, given.out / f"{name}_{k}"),
                range(given.draws)))
        chi = sum(one[1] for one in found) / len(found)
        print(f"{name}: {len(chosen)} points, {len(frames)} frames, {given.draws} draws, chi2/nu {chi:.3f}, "
              f"{sum(one[2] for one in found)} warned that points err together, {sum(one[3] for one in found)} of the mesh")
        for parameter, value in truth.items():
            inside = sum(low <= value <= high for low, high in (one[0][parameter]["ci95"] for one in found))
            mean = sum(one[0][parameter]["value"] for one in found) / len(found)
            biases = [abs(one[0][parameter].get("mesh_bias", 0)) for one in found]
            print(f"  {parameter:8} {value:8.4g}  mean {mean:.5g}  inside {inside} of {given.draws} "
                  f"({100 * inside / given.draws:.1f} %)  mesh bias {sum(biases) / len(biases):.2g}", flush=True)


if __name__ == "__main__":
    main()
