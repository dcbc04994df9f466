#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""record.py TUNICA SOURCES FOLDER: what contradicts an experiment, its data or physics is asked about by `check`: the
size of an unloaded tube, a noise of 200 %, angles in radians, a stiffness that no such tissue has, keys that do nothing.
What is in order raises nothing."""
import json
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
import rig

program, _, scratch = sys.argv[1:]
folder = rig.fresh_folder(scratch)

# A tube of outer radius 0.35 mm and wall 0.08 mm, held at an axial stretch of 1.2; incompressible, so that without
# pressure the radii are those of the unloaded tube over the root of the stretch.
(folder / "tube.csv").write_text("pressure [kPa],outer_diameter [mm]\n" + "".join(
    f"{0.5 * k},{0.7 / 1.2 ** 0.5 + 0.2 * (k / 9) ** 0.7:.5f}\n" for k in range(8)))
(folder / "strip.csv").write_text("stretch,stress [kPa]\n" + "".join(
    f"{1 + 0.01 * k},{k + 0.1 * k * k + 0.01 * (k * k % 7)}\n" for k in range(31)))
STRIP = {"type": "uniaxial", "direction": "circumferential", "data": {
    "file": "strip.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "stress_measure": "cauchy"}}
TUBE = {"type": "thick_wall_pressurisation", "outer_radius": "0.35 mm", "thickness": "0.08 mm", "axial_stretch": 1.2,
        "data": {"file": "tube.csv", "columns": {"pressure": "pressure", "outer_diameter": "outer_diameter"}}}
NEO_HOOKE = {"type": "neo_hooke"}


def write(test, model=None, **more):
    file = folder / "e.json"
    file.write_text(json.dumps({"format": 1, "models": {"m": model or NEO_HOOKE}, "tests": {"t": test},
                                "objective": "least_squares", "optimizers": {"lm": {"type": "ceres_lm"}},
                                "runs": [{"model": "m", "optimizer": "lm"}], **more}))
    return file


def found(test, model=None, **more):
    """(kind, sentence) of each warning of check."""
    printed, _ = rig.tunica(program, "check", write(test, model, **more), "--json")
    return [(one["kind"], one["sentence"]) for one in json.loads(printed)["warning_details"]]


def only(kind, words, test, model=None, **more):
    warnings = found(test, model, **more)
    assert [one for one, _ in warnings] == [kind] and words in warnings[0][1], (kind, words, warnings)


def with_data(**data):
    return {**STRIP, "data": {**STRIP["data"], **data}}


for honest in (STRIP, TUBE, with_data(noise={"relative": "2 %", "absolute": "0.1 kPa"}), with_data(noise={"absolute": "1 kPa"})):
    assert found(honest) == [], found(honest)

# The size of the unloaded tube: a diameter that was given as a radius, and a radius in another unit.
only("record_size", "Are the sizes those of this tube, and radii rather than diameters?", {**TUBE, "outer_radius": "0.7 mm"})
only("record_size", "line 2: without pressure 'outer_diameter'", {**TUBE, "outer_radius": "0.45 mm"})
assert found({**TUBE, "outer_radius": "0.36 mm"}) == [], "3 % off is how well a tube is measured"

# Sizes that no specimen has.
(folder / "force.csv").write_text((folder / "strip.csv").read_text().replace("stress [kPa]", "force [mN]"))
FORCE = {"file": "force.csv", "columns": {"stretch": "stretch", "force": "force"}}
only("record_size", "the thickness of test 't' is 1200 mm. Hardly a specimen is so large",
     with_data(**FORCE, specimen={"thickness": "1.2 m", "width": "10 mm"}))
assert found(with_data(**FORCE, specimen={"thickness": "1.2 mm", "width": "10 mm"})) == []
only("record_size", "the width of test 't' is 1e-07 mm. Hardly a specimen is so small",
     with_data(**FORCE, specimen={"thickness": "1 mm", "width": "0.1 nm"}))

only("record_size", "test 't' is 30 mm thick and 10 mm wide. Is the unit of the thickness right",
     with_data(**FORCE, specimen={"thickness": "3 cm", "width": "10 mm"}))
assert found(with_data(**FORCE, specimen={"thickness": "2.1 mm", "width": "2 mm"})) == [], "a square section"

# Headers that speak of another stress, or of another strain, than they are read as.
plain = (folder / "strip.csv").read_text()
(folder / "nominal.csv").write_text(plain.replace("stress [kPa]", "engineering stress [kPa]"))
NOMINAL = {"file": "nominal.csv", "columns": {"stretch": "stretch", "stress": "engineering stress"}}
only("header_measure", "speaks of \"first_piola_kirchhoff\", and it is read as \"cauchy\"", with_data(**NOMINAL))
assert found(with_data(**NOMINAL, stress_measure="first_piola_kirchhoff")) == []
(folder / "hencky.csv").write_text("Hencky strain" + plain[len("stretch"):].replace("\n1.", "\n0."))
HENCKY = {"file": "hencky.csv", "columns": {"strain": "Hencky strain", "stress": "stress"}}
only("header_strain", "Map it as \"true_strain\" where the header is right", with_data(**HENCKY))

# Noise.
only("record_noise", "is 2, which is 200 % of each value. For 2 % write 0.02",
     with_data(noise={"relative": 2, "absolute": "0.1 kPa"}))
only("record_noise", "Is its unit right?", with_data(noise={"absolute": "1 MPa"}))
for noise, words in ((2, "Give 0.02 for 2 %"), (0.02, "")):
    _, said = rig.tunica(program, "simulate", write(STRIP), "--model", "m", "--noise", noise, "-o", folder / f"sim{noise}")
    said = " ".join(said.split())
    assert ("% of each value" in said) == bool(words) and words in said, said

# Angles in radians: of a model, of a test, and of mechanisms of both.
HGO = {"type": "hgo", "parameters": {"theta": {"fixed": 0.7}}}
only("record_angle", "'theta' of model 'm' is 0.7 without a unit", STRIP, HGO)
only("record_angle", "'misalignment' of test 't' is 0.1 without a unit",
     {**STRIP, "parameters": {"misalignment": {"fixed": 0.1}}}, {"type": "hgo"})
assert found({**STRIP, "parameters": {"misalignment": {"fixed": "0.1 deg"}}}, {"type": "hgo"}) == []

# What is published of the material: 400 kPa is an artery's, and no brain's.
assert found(STRIP, {**NEO_HOOKE, "material": "artery"}) == []
only("set_up", "is a stiffness of 400 kPa, 36.4 times what is published of brain (11 kPa: Budday",
     STRIP, {**NEO_HOOKE, "material": "brain"})
only("set_up", "1/775 of what is published of artery", with_data(units={"stress [kPa]": "Pa"}),
     {**NEO_HOOKE, "material": "artery"})

# Keys that do nothing.
only("set_up", "\"guide\" changes nothing", STRIP, fewer_simulations={"guide": True})
only("set_up", "the optimizer 'lm' of \"analysis\" changes nothing without refits", STRIP, analysis={"optimizer": "lm"})
assert found(STRIP, analysis={"optimizer": "lm", "profiles": "all"}) == []
