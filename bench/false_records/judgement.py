# SPDX-License-Identifier: Apache-2.0
"""What tunica says of a file, and whether it is right."""
import json
import os
import pathlib
import subprocess
import typing

from .mistakes import Mistake

BUILT = pathlib.Path(__file__).resolve().parents[2] / "build/release/bin/tunica"
PROGRAM = os.environ.get("TUNICA", str(BUILT))  # another program: TUNICA=/path/to/tunica
# Causes in the rig with the same effect as a mistake with an amplitude.
LOOK_ALIKES = {
    "displacement_offset": {"reference_length_error", "zeroed_at_preload", "force_offset"},
    "zeroed_at_preload": {"reference_length_error", "displacement_offset", "force_offset"},
    "machine_compliance": {"reference_length_error", "force_scale_error"},
    "sheet_prestretch": {"sheet_force_scale_error"}, "sheet_force_offset": {"outliers"},
    "sheet_force_scale_error": {"sheet_prestretch"}, "force_scale_error": {"reference_length_error"},
    "reference_length_error": {"force_scale_error", "displacement_offset"}}


def diagnosed(folder: pathlib.Path, full: bool = False) -> typing.Tuple[typing.Dict[str, typing.Any], float]:
    """The diagnosis of a folder, and CPU seconds."""
    out = folder / "out"
    if not (out / "result.json").exists():
        told = subprocess.run(
            ["/usr/bin/time", "-f", "%U", PROGRAM, "diagnose", *([] if full else ["--quick"]), "--quiet", str(folder / "experiment.json"), "-o",
             str(out)], capture_output=True, text=True, check=False)
        if told.returncode in (126, 127):
            raise SystemExit(f"{PROGRAM} cannot be run; build it, or set TUNICA")
        (folder / "said.txt").write_text(told.stdout + told.stderr)
    if not (out / "result.json").exists():
        return {}, 0
    seconds = float((folder / "said.txt").read_text().strip().splitlines()[-1])
    return json.loads((out / "result.json").read_text())["diagnosis"], seconds


def judged(d: typing.Dict[str, typing.Any], mistake: Mistake, tests: typing.List[str], everything: typing.List[str]) -> str:
    """What the diagnosis makes of a file with this mistake. A mistake in some tests is the reverse one in all others."""
    if not d:
        return "refused"
    file = d.get("file", {"standing": "not_looked_for", "causes": []})
    if mistake.kind == "inspection" and file.get("suspect"):
        return "named"
    if d["verdict"] == "nothing_detected":
        return "silent"
    mirror = sorted(set(everything) - set(tests))
    if file["standing"] in ("near", "ahead"):
        alike = {mistake.mechanism, *LOOK_ALIKES.get(mistake.mechanism, ())}
        for cause in file["causes"]:
            if cause["near"] and cause["kind"] == mistake.kind and cause.get("mechanism", "") in alike and (
                    sorted(cause["tests"]) in (sorted(tests), mirror) or mistake.kind == "angle"):
                return "named" if file["standing"] == "ahead" else "tied"
        if any(cause["near"] for cause in file["causes"]):
            return "other mistake"
    targets = [(cause["id"], cause["target"] or {}) for cause in d.get("causes", [])]
    claimed = {name for name, at in targets if sorted(at.get("tests", [at.get("test", "")])) in (sorted(tests), mirror)}
    # A gain of a strip is also the area that its force was divided by.
    alike = {"force_scale_error"} if mistake.kind == "unit" else LOOK_ALIKES.get(mistake.mechanism, set())
    if claimed & alike:
        return "look-alike"
    return "false science" if d["verdict"] in ("named", "discovered", "indistinguishable", "leading") else d["verdict"]
