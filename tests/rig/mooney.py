#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mooney.py TUNICA SOURCE FOLDER: three constants of Mooney and Rivlin on the uniaxial data of the Ansys technology
demonstration guide, example 15.1, are the linear least squares of numpy, as a named model and as a composed one."""
import json
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
import rig

program, _, scratch = sys.argv[1:]
folder = rig.fresh_folder(scratch)
ROWS = """0.0819139,0.82788577
0.166709,1.5437247
0.25396,2.1686152
0.343267,2.7201819
0.434257,3.2129833
0.526586,3.6589498
0.619941,4.0677999
0.714042,4.4474142
0.80864,4.8041608
0.903519,5.143172
0.998495,5.4685772
1.09341,5.7836943
"""
(folder / "uniax.csv").write_text("strain,stress [MPa]\n" + ROWS, encoding="utf-8")
COMPOSED = {"type": "composed", "terms": [{"name": "a", "invariant": "I1", "law": "linear"},
                                          {"name": "b", "invariant": "I2", "law": "linear"},
                                          {"name": "x", "invariant": "I1*I2", "law": "linear"}]}


def fit(name, model, noise):
    data = {"file": "uniax.csv", "columns": {"strain": "strain", "stress": "stress"},
            "stress_measure": "first_piola_kirchhoff", "units": {"strain": "1"}, **noise}
    (folder / f"{name}.json").write_text(json.dumps({
        "format": 1, "models": {"m": model}, "tests": {"t": {"type": "uniaxial", "direction": "axial", "data": data}},
        "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm"}},
        "runs": [{"model": "m", "optimizer": "lm"}]}), encoding="utf-8")
    rig.tunica(program, "run", folder / f"{name}.json", "-o", folder / name)
    return rig.best_parameters(folder / name)


# C10, C01, C11 in MPa, by numpy.linalg.lstsq.
RIGHT = {"relative": ({"noise": {"relative": "1 %"}}, (1.338856, 0.5236214, -0.01648364)),
         "absolute": ({}, (1.283033, 0.593477, -0.006902))}
for weights, (noise, right) in RIGHT.items():
    found = {"named": (fit(weights, {"type": "mooney_rivlin", "terms": 3}, noise), ("c10", "c01", "c11"), 1e-3),
             "composed": (fit(weights + "_composed", COMPOSED, noise), ("a_mu", "b_mu", "x_mu"), 0.5e-3)}
    for name, (best, names, factor) in found.items():
        for parameter, value in zip(names, right):
            assert abs(factor * best[parameter] - value) < 1e-6, (weights, name, parameter, best)
