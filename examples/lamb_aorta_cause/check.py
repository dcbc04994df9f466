#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: lost transverse stability is what is wrong, dispersed fibres mend it at no cost; without
"admissibility" it is reported and changes nothing."""
import json
import os
import pathlib
import subprocess
import sys

tunica = os.environ["TUNICA"].split(";")
results = pathlib.Path(sys.argv[1])


def run(*words):
    """A call of tunica, and the result.json that it leaves in its last argument."""
    subprocess.run([*tunica, *map(str, words), "--quiet"], check=True)
    return json.loads((words[-1] / "result.json").read_text(encoding="utf-8"))


found = run("diagnose", results / "input.json", "-o", results / "diagnosis")["diagnosis"]
assert found["admissibility"]["stable"] is False and "transverse" in found["admissibility"]["where"], found["admissibility"]
assert found["verdict"] == "named" and found["ambiguity_set"] == ["fibre_dispersion"], (found["verdict"], found["ambiguity_set"])
assert found["admissibility"]["remedy"] == "fibre_dispersion"
assert found["p_value"] > 0.05, "the curves alone raise an alarm"
gain = found["gain"]
assert gain["after"] <= gain["before"] + 1e-6, gain
extended = run("run", results / "diagnosis" / "extended.json", "-o", results / "extended")
assert extended["runs"][0]["best"]["stable"] is True, "the extension is not stable"

plain = json.loads((results / "input.json").read_text(encoding="utf-8"))
plain["diagnosis"]["admissibility"] = False
(results / "plain.json").write_text(json.dumps(plain), encoding="utf-8")
without = run("diagnose", results / "plain.json", "-o", results / "plain")["diagnosis"]
assert without["verdict"] == "nothing_detected" and without["admissibility"]["stable"] is False, without["verdict"]
print(f"lamb aorta: {found['admissibility']['where']}; {found['causes'][0]['id']} = "
      f"{found['causes'][0]['amplitude']['value']:.3f} mends it, |r|² {gain['before']:.2f} -> {gain['after']:.2f}")
