#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the data and experiments of this folder: stresses in closed form, with noise drawn once from seed 7.

    rubbers/     a cohort of four Mooney-Rivlin rubbers of a term in I2 that differs, measured twice each
    replicates/  one of them, six times; neighbouring rows share their errors with a correlation of 0.6
    wrong_row/   neo-Hookean rubber whose noise nobody states; one row is read 25 kPa too high"""
import json
import pathlib
import random

HERE = pathlib.Path(__file__).resolve().parent
STRETCHES = [round(1.1 + 0.05 * i, 2) for i in range(25)]
PROTOCOLS = {"uniaxial": {"type": "uniaxial", "direction": "axial"},
             "equibiaxial": {"type": "biaxial", "protocol": "equibiaxial"}}
COLUMNS = {"stretch": "stretch", "stress": "stress"}


def stress(protocol, stretch, first, second):
    """Cauchy stress in kPa of (first/2)(I1 - 3) + (second/2)(I2 - 3), incompressible."""
    if protocol == "uniaxial":
        return first * (stretch**2 - 1 / stretch) + second * (stretch - stretch**-2)
    return first * (stretch**2 - stretch**-4) + second * (stretch**4 - stretch**-2)


def write_curve(file, protocol, first, second, noise):
    file.parent.mkdir(parents=True, exist_ok=True)
    rows = [f"{stretch:.2f},{stress(protocol, stretch, first, second) + noise():.6g}" for stretch in STRETCHES]
    file.write_text("\n".join(["stretch [1],stress [kPa]", *rows]) + "\n", encoding="utf-8")


def experiment(name, data):
    return {"format": 1, "name": name,
            "models": {"rubber": {"type": "neo_hooke", "parameters": {"mu": {"initial": "200 kPa"}}}},
            "tests": {protocol: {**test, "data": {**data(protocol), "columns": COLUMNS}} for protocol, test in PROTOCOLS.items()},
            "optimizers": {"lm": {"type": "ceres_lm"}}, "runs": [{"model": "rubber", "optimizer": "lm"}]}


def write_json(file, content):
    file.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")


def correlated(draw, sd, correlation):
    """Noise of standard deviation sd, each number with a share of the one before."""
    last = draw.gauss(0, sd)
    while True:
        yield last
        last = correlation * last + draw.gauss(0, sd * (1 - correlation**2) ** 0.5)


def rubbers(draw):
    folder, moduli = HERE / "rubbers", {"a": 20.0, "b": 35.0, "c": 50.0, "d": 65.0}
    for k, (specimen, second) in enumerate(moduli.items()):
        for protocol in PROTOCOLS:
            write_curve(folder / f"data/{specimen}_{protocol}.csv", protocol, 200 + 30 * k, second, lambda: draw.gauss(0, 1))
    write_json(folder / "experiment.json",
               experiment("rubber", lambda protocol: {"file": f"data/a_{protocol}.csv", "noise": {"absolute": "1 kPa"}}))
    write_json(folder / "cohort.json", {
        "format": 1, "name": "rubbers", "experiment": "experiment.json", "specimens": "specimens.csv",
        "bind": {f"/tests/{protocol}/data/file": f"data/{{specimen}}_{protocol}.csv" for protocol in PROTOCOLS}})
    (folder / "specimens.csv").write_text("specimen\n" + "\n".join(moduli) + "\n", encoding="utf-8")


def replicates(draw):
    folder, count = HERE / "replicates", 6
    for protocol in PROTOCOLS:
        for k in range(count):
            noise = correlated(draw, 1.0, 0.6)
            write_curve(folder / f"data/{protocol}_{k}.csv", protocol, 200, 20, lambda: next(noise))
    write_json(folder / "experiment.json", experiment(
        "replicates", lambda protocol: {"files": [f"data/{protocol}_{k}.csv" for k in range(count)]}))


def wrong_row(draw):
    folder, row = HERE / "wrong_row", 12
    for protocol in PROTOCOLS:
        rows = iter(range(len(STRETCHES)))
        wrong = protocol == "uniaxial"
        write_curve(folder / f"data/{protocol}.csv", protocol, 200, 0,
                    lambda: draw.gauss(0, 1) + (25 if wrong and next(rows) == row else 0))
    write_json(folder / "experiment.json", experiment("wrong_row", lambda protocol: {"file": f"data/{protocol}.csv"}))


if __name__ == "__main__":
    rubbers(random.Random(7))
    replicates(random.Random(7))
    wrong_row(random.Random(7))
