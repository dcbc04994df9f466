# SPDX-License-Identifier: Apache-2.0
"""How often the cause of a misfit of a field is named.

A sheet with a hole is simulated by finite elements of its own (sheet.py), with one cause or none. Its amplitude is the one
whose effect, beside all that the base can fit, has the noncentrality Lambda: |r|² of the base's fit to the data without noise.
Then every case has its own noise, and `tunica diagnose --quick` says what it sees."""

import argparse
import collections
import concurrent.futures
import json
import random
import resource
import subprocess
from pathlib import Path

import numpy as np
import sheet
from noise import errors

PULLS = (2.0, 5.0, 8.0)  # mm, of 24
SPACING = 1.8  # mm, of the points
# Cause: a first amplitude, and the directions that are drawn from.
CAUSES = {"clamp_slip": (0.005, (0,)), "grip_tilt": (0.01, (0,)), "oblique_pull": (0.5, (0,)),
          "thickness_gradient": (0.1, (0, 30, 150)), "stiffer_half": (0.05, (0, 180))}
BOUNDARY = {"clamped": {"left": "fixed", "right": {"x": "uniform", "y": "fixed"}},
            "measured": {"left": "measured", "right": "measured"}}


class Bench:
    def __init__(self, tunica, out, sigma, mesh):
        self.tunica, self.out, self.sigma = tunica.resolve(), out, sigma
        out.mkdir(parents=True, exist_ok=True)
        self.mesh = (out / "triangles.msh").resolve()
        sheet.Sheet(*mesh).write_triangles(self.mesh)
        self.sheet = sheet.Sheet()
        self.points = self.sheet.seen(SPACING)
        self.known = {}

    def frames(self, cause, amplitude, direction):
        return self.sheet.frames(PULLS, cause, amplitude, direction)

    def write(self, folder, frames, boundary, seed=None, subset=0):
        """The files of a case; without a seed without noise. `subset`: width of what points share, mm."""
        folder.mkdir(parents=True, exist_ok=True)
        noise = random.Random(seed)
        sigma, share = (0, 0) if seed is None else (self.sigma, 0.005)
        field, load = ["step,x [mm],y [mm],ux [mm],uy [mm]"], ["step,load [mN]"]
        for step, (u, force) in enumerate(frames, 1):
            load.append(f"{step},{force * (1 + noise.gauss(0, share))!r}")
            places = self.sheet.nodes[self.points]
            moved = u[self.points] + np.transpose([errors(places, sigma, subset, noise) for _ in range(2)])
            field += [",".join(repr(float(value)) for value in (step, *place, *way)) for place, way in zip(places, moved)]
        (folder / "field.csv").write_text("\n".join(field) + "\n", encoding="utf-8")
        (folder / "load.csv").write_text("\n".join(load) + "\n", encoding="utf-8")
        test = {"type": "full_field", "thickness": f"{sheet.THICKNESS} mm", "mesh": {"file": str(self.mesh)},
                "boundary": BOUNDARY[boundary],
                "data": [{"file": "field.csv", "columns": {"step": "step", "x": "x", "y": "y", "ux": "ux", "uy": "uy"},
                          "noise": {"absolute": f"{self.sigma} mm"}},
                         {"file": "load.csv", "columns": {"step": "step", "force_right": "load"},
                          "noise": {"relative": 0.005}}]}
        model = {"type": "yeoh", "parameters": {"c10": {"min": "10 kPa", "max": "300 kPa"},
                                                "c20": {"min": 0, "max": "60 kPa"}, "c30": {"fixed": 0}}}
        experiment = {"format": 1, "seed": 1, "models": {"rubber": model}, "tests": {"plate": test},
                      "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm", "starts": 1}},
                      "stop": {"max_evaluations": 60}, "runs": [{"model": "rubber", "optimizer": "lm"}]}
        (folder / "experiment.json").write_text(json.dumps(experiment), encoding="utf-8")

    def call(self, folder, verb, *more):
        subprocess.run([self.tunica, verb, "experiment.json", "-o", "out", "-j", "1", "--quiet", *more], cwd=folder,
                       stdout=subprocess.DEVNULL, check=True)
        return json.loads((folder / "out/result.json").read_text(encoding="utf-8"))

    def noncentrality(self, name, frames, boundary):
        folder = self.out / f"clean_{name}"
        self.write(folder, frames, boundary)
        misfit = self.call(folder, "run")["runs"][0]["best"]["misfit"]
        return misfit["chi_square"]

    def amplitude(self, cause, direction, boundary, wanted):
        """Of the cause whose effect has this noncentrality."""
        key = (cause, direction, boundary)
        if key not in self.known:
            size = CAUSES[cause][0]
            for trial in range(2):
                found = self.noncentrality("_".join(map(str, (*key, trial))), self.frames(cause, size, direction), boundary)
                size *= (150 / found) ** 0.5
            self.known[key] = size
        return self.known[key] * (wanted / 150) ** 0.5

    def diagnose(self, name, cause, direction, boundary, wanted, seed):
        amplitude = self.amplitude(cause, direction, boundary, wanted) if cause else 0
        folder = self.out / name
        self.write(folder, self.frames(cause, amplitude, direction), boundary, seed)
        found = self.call(folder, "diagnose", "--quick")["diagnosis"]
        return amplitude, found


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("tunica", type=Path)
    arguments.add_argument("out", type=Path, help="a new folder")
    arguments.add_argument("--causes", nargs="*", default=[*CAUSES, "none"])
    arguments.add_argument("--boundaries", nargs="*", default=list(BOUNDARY))
    arguments.add_argument("--cases", type=int, default=10, help="of each cause and boundary")
    arguments.add_argument("--wanted", type=float, default=150, help="Lambda")
    arguments.add_argument("--sigma", type=float, default=0.02, help="noise of a displacement, mm")
    arguments.add_argument("--mesh", type=int, nargs=2, default=(8, 6), help="calibrated elements along a side and outwards")
    arguments.add_argument("--seed", type=int, default=501)
    arguments.add_argument("--jobs", type=int, default=1)
    given = arguments.parse_args()
    bench = Bench(given.tunica, given.out, given.sigma, given.mesh)
    print(f"{len(bench.points)} points, {len(PULLS)} frames", flush=True)
    for cause in given.causes:
        for boundary in given.boundaries:
            if boundary == "measured" and cause in ("clamp_slip", "grip_tilt", "oblique_pull"):
                continue
            hidden = None if cause == "none" else cause
            directions = CAUSES[cause][1] if hidden else (0,)
            for direction in directions if hidden else ():
                bench.amplitude(hidden, direction, boundary, given.wanted)
            with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
                cases = list(pool.map(lambda k: bench.diagnose(
                    f"{cause}_{boundary}_{k}", hidden, directions[k % len(directions)], boundary, given.wanted,
                    given.seed * 1000 + k), range(given.cases)))
            report(cause, boundary, cases)
    print(f"{resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime:.0f} s of processor", flush=True)


def report(cause, boundary, cases):
    verdicts = collections.Counter()
    for _, found in cases:
        named = "+".join(sorted(one["id"] for one in found.get("causes", [])))
        verdicts[f"{found['verdict']} {named}".strip()] += 1
    sizes = ", ".join(sorted({f"{amplitude:.3g}" for amplitude, _ in cases}))
    print(f"{cause:20} {boundary:9} amplitude {sizes}: " + "; ".join(f"{n} {what}" for what, n in verdicts.most_common()),
          flush=True)


if __name__ == "__main__":
    main()
