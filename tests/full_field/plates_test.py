#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plates_test.py TUNICA SOURCES: the public plate of neo-Hooke's energy at low noise, to 1 % of what it was made with. Ends
with 77 where the data are not: their licence does not let them be copied."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent / "../../bench/fields"))
import plates

tunica, sources = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
data = pathlib.Path(os.environ.get("TUNICA_DATA_DIR", sources.parent / "shared/data")) / "full_field/neohookean_low"
if not data.is_dir():
    print(f"skipped: no {data}; TUNICA_DATA_DIR names the folder that has full_field")
    sys.exit(77)
with tempfile.TemporaryDirectory() as scratch:
    folder = pathlib.Path(scratch)
    plates.convert(data, folder)
    model, truth = plates.PLATES["neohookean"]
    (folder / "experiment.json").write_text(json.dumps(plates.experiment("1e-4 mm", model, "0.08 mm")), encoding="utf-8")
    subprocess.run([tunica, "run", "experiment.json", "-o", "out", "--quiet"], cwd=folder, check=True)
    best = json.loads((folder / "out/result.json").read_text(encoding="utf-8"))["runs"][0]["best"]
    page = (folder / "out/report.html").read_text(encoding="utf-8")
for name, value in truth.items():
    found = best["parameters"][name]
    low, high = found["ci95"]
    assert abs(found["value"] / value - 1) < 0.01, (name, found)
    assert low < value < high, (name, found)
    assert "mesh_bias" in found, found
assert "map_plate_ux_30_residuals" in page, "no map in the report"
print({name: best["parameters"][name]["value"] for name in truth})
