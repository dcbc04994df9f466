# SPDX-License-Identifier: Apache-2.0
"""components_test.py TUNICA: several components of a displacement, and a strain, of a program outside, each in a unit of
its own. Stiffness 40 kPa is found from what the program makes of it by hand."""
import json
import pathlib
import subprocess
import sys
import tempfile

PROGRAM = """import sys
mu = float(sys.argv[1])
loads = [float(line) for line in open('rows.txt')]
with open('out.csv', 'w') as out:
    out.write('ux,uy,exx\\n')
    for load in loads:
        out.write(f'{1000 * load / mu},{-0.3 * load / mu},{2 * load / mu}\\n')
"""


def main():
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "points.py").write_text(PROGRAM)
        (folder / "rows.in").write_text("{{rows}}")
        rows = "\n".join(f"{load},{load / 40 / 10},{-300 * load / 40},{200 * load / 40}" for load in (1, 2, 4, 7))
        (folder / "points.csv").write_text(f"F [mN],ux [cm],uy [um],exx [%]\n{rows}\n")
        (folder / "experiment.json").write_text(json.dumps({
            "format": 1, "models": {"rubber": {"type": "neo_hooke"}},
            "tests": {"points": {
                "type": "external", "command": [sys.executable, str(folder / "points.py"), "{{mu}}"],
                "templates": {"rows.txt": "rows.in"},
                "results": {"displacement_x": {"file": "out.csv", "column": "ux", "unit": "um"},
                            "displacement_y": {"file": "out.csv", "column": "uy", "unit": "mm"},
                            "strain_xx": {"file": "out.csv", "column": "exx"}},
                "data": {"file": "points.csv", "columns": {"load": "F", "displacement_x": "ux", "displacement_y": "uy",
                                                           "strain_xx": "exx"}}}},
            "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm", "starts": 1}},
            "runs": [{"model": "rubber", "optimizer": "lm"}]}))
        done = subprocess.run([sys.argv[1], "run", "experiment.json", "-o", "out", "--no-certificate"], cwd=folder,
                              capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        best = json.loads((folder / "out" / "result.json").read_text())["runs"][0]["best"]
        assert abs(best["parameters"]["mu"]["value"] - 40) < 0.01, best["parameters"]
        channels = {channel["channel"]: channel["unit"] for channel in best["channel_noise"]}
        assert channels == {"displacement_x": "mm", "displacement_y": "mm", "strain_xx": "1"}, channels
        numbers_without_a_unit(folder)


def numbers_without_a_unit(folder):
    """A number that has no name of its own has the unit of its column, which somebody has to state."""
    experiment = json.loads((folder / "experiment.json").read_text())
    test = experiment["tests"]["points"]
    test["results"] = {"value": {"file": "out.csv", "column": "ux"}}
    test["data"] = {"file": "points.csv", "columns": {"load": "F", "value": "ux"}}

    def check(header, units, code):
        (folder / "points.csv").write_text(f"F [mN],{header}\n1,25\n2,50\n4,100\n7,175\n")
        test["data"]["units"] = units
        (folder / "experiment.json").write_text(json.dumps(experiment))
        done = subprocess.run([sys.argv[1], "check", "experiment.json"], cwd=folder, capture_output=True, text=True,
                              check=False)
        assert done.returncode == code, done.stdout + done.stderr
        return " ".join((done.stdout + done.stderr).split())

    assert "'value' is a plain number, and the column has no unit" in check("ux", {}, 0)
    assert "is a plain number" not in check("ux", {"ux": "1"}, 0)
    assert "is a plain number" not in check("ux [um]", {"ux": "1"}, 0)
    assert "let the prediction be in um" in check("ux [um]", {}, 2)


if __name__ == "__main__":
    main()
