#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""emcee_test.py TUNICA SOURCE: draws of three terms of Ogden on Treloar's rubber against another program's.

The posterior is written here once more, from the formulas of Ogden's model and the files of the example, and emcee, an
affine-invariant ensemble (D. Foreman-Mackey et al., PASP 125:306, 2013), draws from it. Quantiles agree to five standard
errors of their difference. These come from ten blocks each: 18 comparisons give a false alarm for about 0.5 % of the
seeds, which are fixed. Ends with 77 where emcee is missing (Debian: python3-emcee).
"""
import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import emcee
    import numpy
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-emcee)")
    sys.exit(77)

PROGRAM, SOURCE = (pathlib.Path(one).resolve() for one in sys.argv[1:3])
FOLDER = SOURCE / "examples/treloar"
# kPa; mu_2 is searched for by its logarithm
BOUNDS = {"mu_1": (0, 2000), "alpha_1": (0.5, 3.5), "mu_2": (1e-4, 100), "alpha_2": (3.5, 12), "mu_3": (-100, 0),
          "alpha_3": (-6, -0.5)}
TRANSVERSE = {"uniaxial": -0.5, "equibiaxial": -2, "pure_shear": -1}  # of the stretch's power, beside the pulled one
SHARES = (0.025, 0.5, 0.975)


def data(name):
    with open(FOLDER / f"{name}.csv", encoding="utf-8") as file:
        rows = [row for row in csv.reader(line for line in file if not line.startswith("#")) if row]
    head = [cell.split("[")[0].strip() for cell in rows[0]]
    scale = 1000 if "MPa" in rows[0][head.index("stress")] else 1
    stretch, stress = (numpy.array([float(row[head.index(column)]) for row in rows[1:]]) for column in ("stretch", "stress"))
    return stretch, scale * stress


TESTS = {name: data(name) for name in TRANSVERSE}


def squares(points):
    """Σ ((ŷ − y)/σ)² at points (count × 6)."""
    total = numpy.zeros(len(points))
    for name, (stretch, stress) in TESTS.items():
        predicted = numpy.zeros((len(points), len(stretch)))
        for mu, alpha in ((0, 1), (2, 3), (4, 5)):  # ∂/∂λ of mu/alpha (Σ λ_i^alpha − 3)
            a = points[:, alpha, None]
            predicted += points[:, mu, None] * (stretch ** (a - 1) - stretch ** (TRANSVERSE[name] * a - 1))
        total += (((predicted - stress) / numpy.hypot(20, 0.02 * stress)) ** 2).sum(axis=1)
    return total


LOW, HIGH = (numpy.array([bounds[k] for bounds in BOUNDS.values()], float) for k in (0, 1))
LOW[2], HIGH[2] = numpy.log(LOW[2]), numpy.log(HIGH[2])
ROWS = sum(len(stretch) for stretch, _ in TESTS.values())


def log_density(coordinates, known):
    inside = ((coordinates >= LOW) & (coordinates <= HIGH)).all(axis=1)
    points = numpy.clip(coordinates, LOW, HIGH)
    points[:, 2] = numpy.exp(points[:, 2])
    found = squares(points)
    return numpy.where(inside, -found / 2 if known else -ROWS / 2 * numpy.log(found), -numpy.inf)


def tunica(folder):
    """The run of Ogden's model alone."""
    shutil.copytree(FOLDER, folder.parent / "treloar")
    experiment = folder.parent / "treloar/experiment.json"
    text, others = re.subn(r'\n *\{"model": "(?!ogden)\w+", "optimizer": "lm"\},', "", experiment.read_text(encoding="utf-8"))
    assert others == 4, f"{others} other runs in {FOLDER}/experiment.json; expected 4"
    experiment.write_text(text, encoding="utf-8")
    subprocess.run([PROGRAM, "run", experiment, "-o", folder, "--posterior=40000", "--quiet", "--no-certificate"], check=True,
                   stdout=subprocess.DEVNULL)
    result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    run = next(run for run in result["runs"] if run["model"] == "ogden")
    draws = json.loads((folder / run["best"]["posterior"]["file"]).read_text(encoding="utf-8"))["posterior"]
    return run["best"], {name: numpy.array(draws[name]) for name in BOUNDS}


def error_of(values, share):
    """The standard error of a quantile, from its scatter over ten blocks of all walkers or chains (draws along axis 1)."""
    blocks = numpy.array_split(values, 10, axis=1)
    return numpy.std([numpy.quantile(block, share) for block in blocks], ddof=1) / numpy.sqrt(10)


with tempfile.TemporaryDirectory() as scratch:
    best, own = tunica(pathlib.Path(scratch) / "run")
posterior = best["posterior"]
print(f"R-hat {posterior['r_hat']:.4f}, effective size {posterior['ess']:.0f}, noise known: {posterior['noise_known']}")
numpy.random.seed(20240817)
centre = numpy.array([best["parameters"][name]["value"] for name in BOUNDS])
centre[2] = numpy.log(centre[2])
walkers = 64
start = numpy.clip(centre + 0.02 * numpy.abs(centre) * numpy.random.standard_normal((walkers, 6)), LOW + 1e-9, HIGH - 1e-9)
moves = [(emcee.moves.DEMove(), 0.5), (emcee.moves.StretchMove(), 0.3), (emcee.moves.DESnookerMove(), 0.2)]
sampler = emcee.EnsembleSampler(walkers, 6, log_density, args=(posterior["noise_known"],), vectorize=True, moves=moves)
sampler.run_mcmc(start, 20000)
other = sampler.get_chain(discard=4000, thin=4)  # steps × walkers × 6
wrong = 0
for k, name in enumerate(BOUNDS):
    theirs = other[:, :, k].T
    theirs = numpy.exp(theirs) if name == "mu_2" else theirs
    for share in SHARES:
        ours_at, theirs_at = numpy.quantile(own[name], share), numpy.quantile(theirs, share)
        error = numpy.hypot(error_of(own[name], share), error_of(theirs, share))
        off = abs(ours_at - theirs_at) / error
        wrong += off > 5
        print(f"{name:<8} {100 * share:5.1f} %  tunica {ours_at:11.5g}  emcee {theirs_at:11.5g}  {off:4.1f} standard errors")
print(f"autocorrelation time of emcee: {sampler.get_autocorr_time(discard=4000, quiet=True).max():.0f} steps")
sys.exit(1 if wrong or not posterior["converged"] else 0)
