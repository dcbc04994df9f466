#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fits the five models to Treloar's three tests without tunica, and prints independent.csv: closed forms of the nominal
stress, plain Python, nothing but arithmetic.

With lambda the stretch, the nominal stress of each test is that of lambda1 = lambda, lambda2 = lambda**b and
lambda3 = 1/(lambda1 lambda2), b = -1/2 (uniaxial), 1 (equibiaxial, each direction), 0 (pure shear; lambda2 = 1).
Every model is linear in its moduli:

  neo_hooke      mu                 P = mu (l - l3^2/l)
  mooney_rivlin  c10, c01           P = 2 (l - l3^2/l) (c10 + c01 l2^2)
  yeoh           c10, c20, c30      P = 2 (l - l3^2/l) (c10 + 2 c20 x + 3 c30 x^2),   x = I1 - 3
  gent           mu; Jm             P = mu (l - l3^2/l) Jm/(Jm - x)
  ogden          mu_i; alpha_i      P = sum mu_i (l^(alpha_i - 1) - l3^alpha_i/l)

so that the first three are one linear least-squares problem (QR, exact), and for the others the moduli are eliminated
(Golub, Pereyra 1973): golden section over Jm, Levenberg-Marquardt from a grid of exponents. Residuals are divided by the
sigma that experiment.json states, sigma^2 = (0.02 MPa)^2 + (2 % of the stress)^2. Stresses in kPa.

    python3 independent.py > independent.csv      (a second)"""
import itertools
import math
import pathlib

TESTS = {"uniaxial": -0.5, "equibiaxial": 1.0, "pure_shear": 0.0}
ABSOLUTE, RELATIVE = 20.0, 0.02  # kPa, 1


def rows():
    """(lambda, lambda2, lambda3, stress, sigma) of every row of the three files."""
    found = []
    for test, b in TESTS.items():
        lines = (pathlib.Path(__file__).parent / f"{test}.csv").read_text(encoding="utf-8").splitlines()
        for line in [line for line in lines if line and not line.startswith("#")][1:]:
            l, stress = (float(cell) for cell in line.split(","))
            stress *= 1000
            found.append((l, l**b, l ** (-1 - b), stress, math.hypot(ABSOLUTE, RELATIVE * stress)))
    return found


ROWS = rows()


def neo(l, l3):
    return l - l3 * l3 / l


def neo_hooke(_):
    return [[neo(l, l3)] for l, l2, l3, _, _ in ROWS]


def mooney_rivlin(_):
    return [[2 * neo(l, l3), 2 * neo(l, l3) * l2 * l2] for l, l2, l3, _, _ in ROWS]


def yeoh(_):
    found = []
    for l, l2, l3, _, _ in ROWS:
        x = l * l + l2 * l2 + l3 * l3 - 3
        found.append([2 * neo(l, l3) * k * x ** (k - 1) for k in (1, 2, 3)])
    return found


def gent(nonlinear):
    found = []
    for l, l2, l3, _, _ in ROWS:
        x = l * l + l2 * l2 + l3 * l3 - 3
        found.append([neo(l, l3) * nonlinear[0] / (nonlinear[0] - x)])
    return found


def ogden(alphas):
    return [[l ** (a - 1) - l3**a / l for a in alphas] for l, l2, l3, _, _ in ROWS]


def least_squares(columns, target):
    """min |sum_j x_j columns_j - target|, by Gram-Schmidt done twice on columns of unit length. Returns x, residual."""
    count, scale = len(columns), [math.sqrt(sum(v * v for v in column)) for column in columns]
    q, r = [], [[0.0] * count for _ in range(count)]
    for j in range(count):
        v = [entry / scale[j] for entry in columns[j]]
        for _ in range(2):
            for i, basis in enumerate(q):
                part = sum(a * b for a, b in zip(basis, v))
                r[i][j] += part
                v = [a - part * b for a, b in zip(v, basis)]
        r[j][j] = math.sqrt(sum(a * a for a in v))
        q.append([a / r[j][j] for a in v])
    rest, projections = list(target), [0.0] * count
    for _ in range(2):
        for j, basis in enumerate(q):
            part = sum(a * b for a, b in zip(basis, rest))
            projections[j] += part
            rest = [a - part * b for a, b in zip(rest, basis)]
    x = [0.0] * count
    for j in reversed(range(count)):
        x[j] = (projections[j] - sum(r[j][k] * x[k] for k in range(j + 1, count))) / r[j][j]
    return [value / s for value, s in zip(x, scale)], rest


def weighted(matrix):
    return [[row[j] / of[4] for row, of in zip(matrix, ROWS)] for j in range(len(matrix[0]))]


TARGET = [row[3] / row[4] for row in ROWS]


def moduli(model, nonlinear=()):
    """Best moduli at given nonlinear parameters, and the objective sum(((y - f)/sigma)^2)."""
    x, rest = least_squares(weighted(model(nonlinear)), TARGET)
    return x, sum(v * v for v in rest)


def golden_section(function, low, high):
    ratio = (math.sqrt(5) - 1) / 2
    while high - low > 1e-9 * high:
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, b) if function(a) < function(b) else (a, high)
    return (low + high) / 2


def levenberg_marquardt(mu, alphas):
    """Ogden's six parameters together, from a start; derivatives by hand."""
    damping, best = 1e-3, None

    def residuals(mu, alphas):
        return [(sum(m * b for m, b in zip(mu, basis)) - row[3]) / row[4] for basis, row in zip(ogden(alphas), ROWS)]

    rest = residuals(mu, alphas)
    best = sum(v * v for v in rest)
    for _ in range(2000):
        slopes = [
            [m * (math.log(l) * l ** (a - 1) - math.log(l3) * l3**a / l) / s for l, _, l3, _, s in ROWS]
            for m, a in zip(mu, alphas)
        ]
        columns = weighted(ogden(alphas)) + slopes
        size = [math.sqrt(sum(v * v for v in column)) for column in columns]
        augmented = [
            column + [math.sqrt(damping) * s if k == j else 0.0 for k in range(len(columns))]
            for j, (column, s) in enumerate(zip(columns, size))
        ]
        step, _ = least_squares(augmented, [-v for v in rest] + [0.0] * len(columns))
        new_mu = [m + d for m, d in zip(mu, step)]
        new_alphas = [a + d for a, d in zip(alphas, step[len(mu):])]
        try:
            trial = residuals(new_mu, new_alphas)
            value = sum(v * v for v in trial)
        except OverflowError:
            value = math.inf
        if value < best:
            converged = best - value < 1e-13 * best
            mu, alphas, rest, best, damping = new_mu, new_alphas, trial, value, damping / 5
            if converged:
                break
        else:
            damping *= 3
            if damping > 1e12:
                break
    return best, mu, alphas


def best_ogden():
    found = None
    for alphas in itertools.product((0.8, 1.6), (4.0, 8.0, 12.0), (-1.0, -3.0)):
        mu, _ = moduli(ogden, alphas)
        candidate = levenberg_marquardt(mu, list(alphas))
        if found is None or candidate[0] < found[0]:
            found = candidate
    return found


def fit_all():
    """Per model the parameters by name [kPa, 1], and "objective"."""
    result = {}

    def add(model, names, values, objective):
        result[model] = {**dict(zip(names, values)), "objective": objective}

    for model, names in ((neo_hooke, ["mu"]), (mooney_rivlin, ["c10", "c01"]), (yeoh, ["c10", "c20", "c30"])):
        add(model.__name__, names, *moduli(model))
    limit = golden_section(lambda jm: moduli(gent, [jm])[1], 56.0, 500.0)
    mu, objective = moduli(gent, [limit])
    add("gent", ["mu", "Jm"], [*mu, limit], objective)
    objective, mu, alphas = best_ogden()
    add("ogden", ["mu_1", "alpha_1", "mu_2", "alpha_2", "mu_3", "alpha_3"],
        [v for pair in zip(mu, alphas) for v in pair], objective)
    # Ogden's own figures for Treloar's rubber (1972): 6.3, 0.012, -0.1 kgf/cm2.
    published, alphas = [630.0, 1.2, -10.0], [1.3, 5.0, -2.0]
    rest = [(sum(m * b for m, b in zip(published, basis)) - row[3]) / row[4] for basis, row in zip(ogden(alphas), ROWS)]
    add("ogden_1972", ["mu_1", "alpha_1", "mu_2", "alpha_2", "mu_3", "alpha_3"],
        [v for pair in zip(published, alphas) for v in pair], sum(v * v for v in rest))
    return result


if __name__ == "__main__":
    print("# Written by independent.py, which says how; moduli in kPa. ogden_1972 is not fitted.")
    print("model,quantity,value")
    for model, quantities in fit_all().items():
        for quantity, value in quantities.items():
            print(f"{model},{quantity},{value:.12g}")
