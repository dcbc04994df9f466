# SPDX-License-Identifier: Apache-2.0
"""peers.py SOURCE: what numpy and scipy need for two strips of the lamb aorta (gho), as one JSON object. The lateral
equilibrium is solved for all points at once by six Newton steps; derivatives are scipy's differences."""
import json
import pathlib
import statistics
import sys
import time

import numpy as np
import scipy.optimize

source = pathlib.Path(sys.argv[1])
LOWER, UPPER = np.zeros(5), np.array([100, 1 / 3, 100, 3, 90.0])  # mu, kappa, k1, k2, theta


def table(name):
    lines = [line for line in (source / "examples/lamb_aorta" / name).read_text().splitlines() if line[:1].isdigit()]
    return np.array([[float(word) for word in line.split(",")[:2]] for line in lines])[0:240:6]


strips = [(table("circumferential.csv"), 0), (table("axial.csv"), 1)]


def residuals(p):
    mu, kappa, k1, k2, theta = p
    s = np.sin(np.radians(theta)) ** 2
    weight = kappa + (1 - 3 * kappa) * np.array([s, 1 - s])
    parts = []
    for data, axis in strips:
        c1, e1, e2 = data[:, 0] ** 2, weight[axis], weight[1 - axis]
        c2 = 1 / data[:, 0]
        for _ in range(6):
            cr = 1 / (c1 * c2)
            q = cr / c2
            E = np.maximum(e1 * c1 + e2 * c2 + kappa * cr - 1, 0)
            d = 2 * k1 * np.exp(k2 * E * E)
            f, slope, de = E * d, d * (1 + 2 * k2 * E * E), e2 - kappa * q
            w1, w2, wr = mu / 2 + f * e1, mu / 2 + f * e2, mu / 2 + f * kappa
            c2 = c2 - (c2 * w2 - cr * wr) / (w2 + c2 * e2 * slope * de + q * wr - cr * kappa * slope * de)
        parts.append(2 * (c1 * w1 - cr * wr) - data[:, 1])
    return np.concatenate(parts)


def objective(p):
    r = residuals(p)
    value = np.linalg.norm(r[:40]) + np.linalg.norm(r[40:])
    return value if np.isfinite(value) else 1e9


def median(work, count):
    times = []
    for _ in range(count):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


np.seterr(all="ignore")
optimum = np.array([22.386, 0.20334, 15.097, 0.036, 57.17])
quick = "--quick" in sys.argv
found = {"objective_s": median(lambda: objective(optimum), 20 if quick else 500)}
found["jacobian_s"] = median(lambda: scipy.optimize.approx_fprime(optimum, residuals), 5 if quick else 100)
generator = np.random.default_rng(7)


def least_squares():
    best = np.inf
    for _ in range(1 if quick else 20):
        start = LOWER + (UPPER - LOWER) * generator.uniform(0.01, 0.99, 5)
        try:
            ended = scipy.optimize.least_squares(residuals, start, bounds=(LOWER, UPPER), x_scale=UPPER - LOWER, max_nfev=100)
            best = min(best, objective(ended.x))
        except ValueError:  # residuals that are not finite at the start
            pass
    found["least_squares_objective"] = best


def evolution():
    generations = 2 if quick else 250  # 120 points each: 30 000 evaluations
    ended = scipy.optimize.differential_evolution(objective, list(zip(LOWER, UPPER)), popsize=24, maxiter=generations - 1, tol=0,
                                                  polish=False, seed=7)
    found["differential_evolution_objective"] = ended.fun
    found["differential_evolution_evaluations"] = ended.nfev


found["least_squares_s"] = median(least_squares, 1)
found["differential_evolution_s"] = median(evolution, 1)
print(json.dumps(found))
