#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""layouts.py TUNICA SOURCES FOLDER: what `tunica import` makes of the layouts of testing machines, what it asks and what
it refuses. Layouts are those of public readers and files (see docs/rig-layouts.md); the values are made up."""
import json
import pathlib
import shutil
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
import rig

program, sources, out = sys.argv[1:4]
folder = rig.fresh_folder(out)
layouts = pathlib.Path(sources) / "tests" / "rig" / "layouts"
STRIP = ("--width", "5 mm", "--thickness", "1.5 mm")
GAUGED = (*STRIP, "--gauge-length", "20 mm")
FORCE = {"time", "displacement", "force"}

# file, options, columns that are right, unit entries that are right (a part), words that must be said
ACCEPTED = [
    ("instron_bluehill.csv", GAUGED, {"time": "Time", "displacement": "Extension", "force": "Load"}, {}, "12 rows"),
    ("instron_compression.csv", (*GAUGED, "--compression", "positive"),
     {"time": "Time", "displacement": "Compressive extension", "force": "Compressive load"}, {}, ""),
    ("mts_testsuite.csv", GAUGED, {"time": "Running Time", "displacement": "Axial Displacement", "force": "Axial Force"}, {},
     "'Axial Displacement Command' (set point)"),
    ("mts_german.dat", GAUGED, {"time": "Laufzeit", "force": "Ch 1 Kraft", "displacement": "Ch 1 Weg"}, {},
     "'Ch 1 Kraft Sollwert' (set point)"),
    ("mti.txt", GAUGED, {"time": "Time", "force": "Load", "displacement": "Disp"}, {}, "'Stress' (stress), 'Strain' (strain)"),
    ("zwick_testxpert.csv", GAUGED, {"time": 1, "displacement": "Standardweg", "force": "Standardkraft"}, {}, "12 rows"),
    ("zwick_utf16.txt", GAUGED, {"time": "Prüfzeit", "displacement": "Traversenweg", "force": "Standardkraft"}, {}, ""),
    ("shimadzu_trapezium.csv", GAUGED, {"time": "Time", "force": "Force", "displacement": "Stroke"}, {}, "12 rows"),
    ("electroforce_wintest.txt", GAUGED, {"time": "Elapsed Time", "displacement": "Disp", "force": "Load"}, {}, "'Points'"),
    ("cellscale_univert.csv", STRIP, {"time": "Time_S", "displacement": "Displacement_mm", "force": "Force_N"},
     {"Displacement_mm": "mm", "Force_N": "N", "Time_S": "s"}, "gauge length 20"),
    ("cellscale_biotester.csv", ("--each", "SetName", "--thickness", "0.8 mm", "--width", "5 mm"),
     {"time": "Time_S", "displacement_circumferential": "XDisplacement_um", "displacement_axial": "YDisplacement_um",
      "force_circumferential": "XForce_mN", "force_axial": "YForce_mN"}, {}, "left out as preconditioning"),
    ("vasotracker.csv", ("--thickness", "20um", "--set", "outer_radius=55um", "--set", "axial_stretch=1.2", "--unit",
                         "Outer Diameter=um", "--unit", "Inner Diameter=um"),
     {"time": "Time", "outer_diameter": "Outer Diameter", "inner_diameter": "Inner Diameter",
      "pressure": "Avg Pressure"}, {}, "'Set Pressure' (set point)"),
    ("admet.csv", GAUGED, {"displacement": "Position", "force": "Load"}, {}, "'Stress' (stress), 'Strain' (strain)"),
    ("mecmesin.csv", GAUGED, {"time": "Time", "displacement": "Displacement", "force": "Load"}, {}, "'Peak Load' (force)"),
    ("tinius_olsen.csv", GAUGED, {"time": "Time", "displacement": "Position", "force": "Force"}, {}, "'Extension' (strain)"),
    ("labview.lvm", (*GAUGED, "--column", "time=X_Value", "--unit", "X_Value=s"),
     {"time": "X_Value", "displacement": "Displacement", "force": "Force"}, {}, "12 rows"),
    ("lloyd_nexygen.csv", GAUGED, {"time": "Time", "displacement": "Extension", "force": "Load"}, {}, "'Index'"),
    ("testresources.csv", GAUGED, {"time": "Time", "displacement": "Position", "force": "Load"}, {}, "'Command' (set point)"),
    ("hegewald.csv", GAUGED, {"time": "Zeit", "displacement": "Traversenweg", "force": "Kraft"}, {}, "'Dehnung' (strain)"),
    ("vic_strain.csv", (*STRIP, "--column", "green_strain=eyy", "--unit", "eyy=1"),
     {"time": "time", "green_strain": "eyy", "force": "Load"}, {}, "'exy' (shear strain)"),
    ("aramis.csv", (), {"true_strain": "True strain", "stress": "True stress"}, {}, "is a cauchy stress"),
    ("planar_pk2.csv", ("--strain-measure", "green", "--stress-measure", "second_piola_kirchhoff", "--unit", "E11=1", "--unit",
                        "E22=1"),
     {"green_strain_circumferential": "E11", "green_strain_axial": "E22", "stress_circumferential": "S11",
      "stress_axial": "S22"}, {}, ""),
    ("numbered_axes.csv", ("--thickness", "1 mm", "--width", "10 mm", "--gauge-length", "10 mm"),
     {"force_circumferential": "Force 1", "force_axial": "Force 2", "displacement_circumferential": "Disp 1",
      "displacement_axial": "Disp 2"}, {}, ""),
    ("french.csv", GAUGED, {"time": "Temps", "displacement": "Déplacement", "force": "Force"}, {}, "'Consigne' (set point)"),
    ("spanish.csv", ("--stress-measure", "first_piola_kirchhoff"), {"time": "Tiempo", "strain": "Deformación", "stress": "Esfuerzo"},
     {}, ""),
    ("ccfatigue.csv", GAUGED, {"force": "Machine_Load_kN", "displacement": "Machine_Displacement_mm"},
     {"Machine_Load_kN": "kN"}, "'exx' (strain)"),
    ("phalanx.txt", (*GAUGED, "--column", "displacement=Z/m", "--unit", "Z/m=m"),
     {"time": "time/s", "displacement": "Z/m", "force": "force/N"}, {"force/N": "N", "time/s": "s"}, ""),
    ("percent.csv", ("--stress-measure", "cauchy", "--unit", "Strain=%"), {"strain": "Strain", "stress": "Stress"},
     {"Strain": "%"}, ""),
    ("dmt_labchart.txt", ("--thickness", "20um", "--set", "outer_radius=150um", "--set", "axial_stretch=1"),
     {"time": "Time", "pressure": "Pressure", "outer_diameter": "Outer Diameter", "inner_diameter": "Inner Diameter"}, {}, ""),
    ("labchart_pressure.txt", GAUGED, {"time": "Time", "force": "Force", "displacement": "Displacement"}, {}, "12 rows"),
    ("zwick_french.TRA", GAUGED, {"time": "Temps", "force": "Force standard", "displacement": "Course standard"}, {},
     "'Traverse absolue' (displacement)"),
    ("zwick_english.txt", GAUGED, {"time": "Time", "displacement": "Standard travel", "force": "Standard force"}, {},
     "'Crosshead absolute' (displacement), 'Capteur de course' (displacement)"),
    ("wavematrix.csv", GAUGED, {"time": "Total Time", "displacement": "Position", "force": "Force"}, {}, "'Stress' (stress)"),
    ("bluehill_universal.csv", GAUGED, {"time": "Time", "displacement": "Displacement", "force": "Force"}, {}, "'AVE2'"),
    ("films_curve.csv", GAUGED, {"time": "Time", "displacement": "Displacement", "force": "Load"}, {},
     "'Stress' (stress), 'Strain' (strain)"),
    ("instron_cyclic.csv", GAUGED, {"time": "Time", "displacement": "Displacement", "force": "Force"}, {},
     "the last loading is taken"),
    ("muscle_load_position.csv", ("--diameter", "14mm", "--height", "21mm", "--compression", "positive"),
     {"time": "Time", "force": "Load", "displacement": "Position"}, {}, "displacement / 21 mm"),
    ("rheos_names.csv", (*GAUGED, "--column", "displacement=d", "--column", "force=f", "--unit", "d=mm", "--unit", "f=N", "--unit",
                         "t=s"), {"displacement": "d", "force": "f", "time": "t"}, {}, ""),
    ("shimadzu_specimens.csv", (*GAUGED, "--column", "displacement=#6", "--column", "force=#5", "--column", "time=#4"),
     {"displacement": 6, "force": 5, "time": 4}, {}, ""),
    ("testresources_mtl32.csv", (*GAUGED, "--column", "displacement=X1Disp mm", "--column", "force=X1L N", "--unit",
                                 "X1Disp mm=mm", "--unit", "X1L N=N"),
     {"displacement": "X1Disp mm", "force": "X1L N", "time": "Time sec"}, {}, "'X2Disp mm' (displacement)"),
    ("walter_bai_400.csv", GAUGED, {"time": "Temps", "displacement": 2, "force": "Force"}, {}, ""),
    ("walter_bai_100.csv", GAUGED, {"time": "C_1_Temps", "displacement": 2, "force": "C_1_Force"}, {}, ""),
    ("effort_position.csv", GAUGED, {"time": "t", "displacement": "pos", "force": "F"}, {}, ""),
    ("biotester_marks.csv", ("--thickness", "0.8 mm", "--width", "5 mm"),
     {"time": "Time_S", "force_circumferential": "XForce_mN", "force_axial": "YForce_mN", "displacement_circumferential":
      "XDisplacement_um", "displacement_axial": "YDisplacement_um"}, {}, "gauge length 5000 um"),
    ("deben_microtest.MTR", (*GAUGED, "--unit", "Elongation=mm", "--unit", "Force=N"),
     {"displacement": "Elongation", "force": "Force"}, {"Elongation": "mm"}, "'Position' (displacement)"),
    ("catman.ASC", GAUGED, {"time": "Zeit  1 - Standardmessrate", "force": "Kraft", "displacement": "Standardwegaufnehmer"}, {},
     "not used: 'Maytec'"),
    ("exponent.tab", GAUGED, {"time": "Time", "displacement": "Distance", "force": "Force"}, {}, "from 'Force' in gf"),
    ("mecmesin_raw.txt", GAUGED, {"time": "Time", "displacement": "Displacement", "force": "Load"}, {}, "from 'Load' in gf"),
    ("bluehill_cyclic_compression.csv", ("--diameter", "14mm", "--height", "21mm", "--compression", "negative"),
     {"time": "Time", "displacement": "Extension", "force": "Load"}, {}, "the last loading is taken"),
    ("vic_lagrange.csv", (*STRIP, "--column", "green_strain=eyy [1] - Lagrange"),
     {"green_strain": "eyy [1] - Lagrange", "force": "Force"}, {}, "'exx [1] - Lagrange' (strain)"),
    ("labchart_stars.txt", GAUGED, {"time": "Time", "displacement": "Displacement", "force": "Force"}, {}, "not used: 'Trigger'"),
    ("metadata_table.csv", GAUGED, {"time": "Time", "displacement": "Displacement", "force": "Force"}, {}, "names in line 3"),
    ("mts_crosshead.txt", GAUGED, {"displacement": "Crosshead", "force": "Load", "time": "Time"}, {}, "12 rows"),
    ("aurora_dmc.ddf", (*GAUGED, "--column", "displacement=AI0"), {"time": "Time", "displacement": "AI0", "force": "AI1"}, {},
     "from 'AI1' in mN"),
    ("schmidt_gauge.csv", (*GAUGED, "--skip-lines", "2", "--column", "force=#1", "--column", "displacement=#3", "--unit", "#1=N",
                           "--unit", "#3=mm"), {"force": 1, "displacement": 3}, {}, ""),
    ("testxpert_steps.csv", GAUGED, {"time": 1, "force": "Kraft", "strain": "Nenndehnung"}, {},
     "'Traverse absolut' (displacement), 'Nennspannung' (stress)"),
    ("vic_lagrange.csv", (*STRIP, "--column", "strain=eyy [1] - Lagrange"),
     {"green_strain": "eyy [1] - Lagrange", "force": "Force"}, {}, ""),
    ("ncorr.csv", (*STRIP, "--column", "strain=Eyy", "--strain-measure", "green", "--unit", "Eyy=1"),
     {"green_strain": "Eyy", "force": "force_N"}, {"force_N": "N"}, "'Exy' (shear strain)"),
    ("mark10.csv", GAUGED, {"time": "Time", "displacement": "Travel", "force": "Load"}, {}, "not used: 'Reading'"),
    ("electroforce_two_axes.csv", GAUGED, {"time": "Elapsed Time", "displacement": "Disp", "force": "Load"}, {},
     "'Rotation' (an angle), 'Torque' (torque)"),
    ("starrett.csv", GAUGED, {"time": "Time", "displacement": "Distance", "force": "Load"}, {}, "'% Strain' (strain)"),
    ("testworks.txt", GAUGED, {"time": "Time", "displacement": "Extension", "force": "Load"}, {},
     "'Stress' (stress), 'Strain' (strain)"),
]
for name, options, columns, units, words in ACCEPTED:
    shutil.copy(layouts / name, folder / name)
    target = folder / (name + ".json")
    target.unlink(missing_ok=True)  # of the same file with other options
    printed, said = rig.tunica(program, "import", folder / name, *options, "-o", target)
    said = " ".join((printed + said).split())
    block = next(iter(json.loads(target.read_text())["tests"].values()))["data"]
    assert block["columns"] == columns, f"{name}: {block['columns']}"
    assert units.items() <= block.get("units", {}).items(), f"{name}: {block.get('units')}"
    assert words in said, f"{name}: '{words}' is not said:\n{said}"
    rig.tunica(program, "check", target)

# file, options, what it asks or says in refusing
REFUSED = [
    ("instron_compression.csv", GAUGED, "--compression SIGN"),
    ("living_systems.csv", ("--thickness", "30um", "--set", "outer_radius=80um", "--set", "axial_stretch=1"),
     "Is 'Diameter' the outer_diameter or the inner_diameter"),
    ("vasotracker.csv", ("--thickness", "20um", "--set", "outer_radius=55um"), "Axial stretch that is held"),
    ("labchart_blocks.txt", GAUGED, "a second block of the recording begins here"),
    ("wavematrix_torsion.csv", GAUGED, "no column is known to give 'stretch'"),
    ("films_summary.csv", GAUGED, "no column is known to give 'stretch'"),
    ("instron_thousands.csv", GAUGED, "'Load' (text such as '3,740.00')"),
    ("muscle_load_position.csv", ("--diameter", "14mm", "--height", "21mm"), "--compression positive or --compression negative"),
    ("rheos_names.csv", GAUGED, "no column is known to give 'stretch'"),
    ("shimadzu_specimens.csv", GAUGED, "Column of the displacement: '#3' or '#6'"),
    ("testresources_mtl32.csv", GAUGED, "no column is known to be measured"),
    ("testresources_mtl32.csv", (*GAUGED, "--column", "force=X1L N", "--unit", "X1L N=N"), "Column of the displacement: 'X1Disp mm' or 'X2Disp mm'"),
    ("dma_frequency.csv", GAUGED, "no column is known to give 'stretch'"),
    ("microtester.csv", STRIP, "Unit of the column 'Size' (length)"),
    ("aurora.txt", GAUGED, "no column is known to give 'stretch'"),
    ("vic_strain.csv", STRIP, "Column along the force: 'exx' or 'eyy'"),
    ("aramis.csv", ("--stress-measure", "first_piola_kirchhoff"), "the column 'True stress' says cauchy"),
    ("aramis.csv", ("--strain-measure", "engineering"), "the column 'True strain' says true"),
    ("planar_pk2.csv", (), "--strain-measure"),
    ("percent.csv", ("--stress-measure", "cauchy"), "1 or %"),
    ("stretch_squared.csv", (), "'Stretch squared' (squared stretch)"),
    ("total_force.csv", ("--thickness", "80um", "--set", "outer_radius=350um", "--set", "axial_stretch=1", "--column",
                         "axial_force=Total axial force", "--set", "axial_strech=1"), "no such option"),
    ("diameter_change.csv", ("--test", "thick_wall_pressurisation", "--thickness", "80um", "--set", "outer_radius=350um",
                             "--set", "axial_stretch=1"), "'Diameter change' (change of diameter)"),
    ("phalanx.txt", GAUGED, "no column is known to give 'stretch'"),
    ("sheet.xlsx", (), "a workbook"),
    ("sheet.xls", (), "a workbook (.xls)"),
    ("deben_microtest.MTR", GAUGED, "Unit of the column 'Elongation' (displacement)"),
    ("bluehill_cyclic_compression.csv", ("--diameter", "14mm", "--height", "21mm"), "for example negative"),
    ("rheowin.txt", GAUGED, "line 6: no column is known to give 'stretch'"),
    ("vic_lagrange.csv", STRIP, "Column along the force: 'exx [1] - Lagrange' or 'eyy [1] - Lagrange'"),
    ("vic_lagrange.csv", (*STRIP, "--column", "green_strain=eyy [1] - Lagrange", "--strain-measure", "true"),
     "the column 'eyy [1] - Lagrange' says green"),
    ("ncorr.csv", (*STRIP, "--column", "green_strain=Eyy", "--strain-measure", "true", "--unit", "Eyy=1"),
     "and --strain-measure says that its strain is true"),
    ("vic_lagrange.csv", (*STRIP, "--column", "true_strain=eyy [1] - Lagrange"), "its name says that its strain is green"),
    ("optics11.txt", GAUGED, "A tip that is pressed into a surface is a test of its own"),
    ("labchart_rings.txt", GAUGED, "'Channel 1', 'Channel 2'"),
    ("aurora_dmc.ddf", GAUGED, "'AI0', 'AI1' (force)"),
    ("schmidt_gauge.csv", GAUGED, "give columns by their number"),
    ("flexure.csv", GAUGED, "the column 'Flex Stress' speaks of bending"),
    ("trios_growth.txt", GAUGED, "the column 'Shear rate' is one of a rheometer"),
    ("rheocompass.csv", GAUGED, "beyond the last of the 2 columns the header names"),
    ("rheocompass.csv", (*GAUGED, "--skip-lines", "5"), "is one of a rheometer"),
]
for name, options, words in REFUSED:
    shutil.copy(layouts / name, folder / name)
    target = folder / "refused.json"
    printed, said = rig.tunica(program, "import", folder / name, *options, "-o", target, code=2)
    said = " ".join(said.split())
    assert words in said and not target.exists(), f"{name}: '{words}' is not said:\n{said}"

# A total force is said to be none of the test's; the pressures and diameters make the test.
shutil.copy(layouts / "total_force.csv", folder)
printed, _ = rig.tunica(program, "import", folder / "total_force.csv", "--thickness", "80um", "--set", "outer_radius=350um",
                        "--set", "axial_stretch=1", "-o", folder / "total.json")
assert "the test takes the reduced one" in " ".join(printed.split()), printed

# True strain and Cauchy stress of made-up rows come to the stretch and the stress that they were made of.
printed, _ = rig.tunica(program, "check", folder / "aramis.csv.json")
largest = float(" ".join(printed.split()).split("over stretch 1 … ")[1].split()[0].rstrip(","))
assert abs(largest - (1 + 2.75 / 20)) < 1e-3, printed
# Values in volts come to what they were made of, by scale and offset: 2.75 mm, 5.1219 N.
printed, _ = rig.tunica(program, "check", folder / "aurora_dmc.ddf.json")
largest = float(" ".join(printed.split()).split("over stretch 1 … ")[1].split()[0].rstrip(","))
assert abs(largest - (1 + 2.75 / 20)) < 1e-3, printed
bare = (folder / "aurora_dmc.ddf").read_text().replace("Scale (units/V)", "Scaled")
(folder / "bare.ddf").write_text(bare)
_, said = rig.tunica(program, "import", folder / "bare.ddf", *GAUGED, "--column", "displacement=AI0", "--unit", "AI0=mm", "-o",
                     folder / "volts.json", code=2)
assert "line 24: the rows are in volts" in " ".join(said.split()), said

# Decimal commas are numbers too; a text among the volts is no voltage.
volts = (folder / "aurora_dmc.ddf").read_text()
(folder / "comma.ddf").write_text(volts.replace(".", ","))
rig.tunica(program, "import", folder / "comma.ddf", *GAUGED, "--column", "displacement=AI0", "-o", folder / "comma.json")
printed, _ = rig.tunica(program, "check", folder / "comma.json")
assert "over stretch 1 … 1.137" in " ".join(printed.split()), printed
(folder / "text.ddf").write_text(volts.replace("\n3\t", "\n3\tx"))
_, said = rig.tunica(program, "import", folder / "text.ddf", *GAUGED, "--column", "displacement=AI0", "-o", folder / "text.json",
                     code=2)
assert "where a voltage is expected" in " ".join(said.split()), said

# A second table below the first is named where the reader comes to it.
_, said = rig.tunica(program, "import", folder.joinpath(shutil.copy(layouts / "trios_steps.txt", folder)), "--test",
                     "simple_shear", "--column", "shear=Strain", "--column", "shear_stress=Stress", "-o",
                     folder / "steps.json", code=2)
assert "The names of the columns come again in line 30" in " ".join(said.split()), said

# A name that speaks of bending is noticed where no column does.
shutil.copy(layouts / "admet.csv", folder / "flexure_3.csv")
printed, _ = rig.tunica(program, "import", folder / "flexure_3.csv", *GAUGED, "-o", folder / "flexure_3.json")
assert "speaks of bending" in " ".join(printed.split()), printed

# The direction of a strip: from the table of specimens, from the name of a file, from an option for one test.
for stem in ("a", "Longitudinal_2", "c"):
    shutil.copy(layouts / "admet.csv", folder / f"{stem}.csv")
(folder / "specimens.csv").write_text("specimen,width,thickness,gauge length,direction\na,5,1.5,20,axial\n"
                                      "Longitudinal_2,5,1.5,20,\nc,5,1.5,20,oblique\n")
printed, _ = rig.tunica(program, "import", *(folder / f"{stem}.csv" for stem in ("a", "Longitudinal_2", "c")),
                        "--specimens", folder / "specimens.csv", "--direction", "c=axial", "-o", folder / "directions.json")
assert "'oblique'" in printed and "and is not used" in " ".join(printed.split()), printed
tests = json.loads((folder / "directions.json").read_text())["tests"]
assert all(test["direction"] == "axial" for test in tests.values()), tests

# Areas and lengths of a table of sizes.
for name in ("bluehill_universal.csv", "properties.csv"):
    shutil.copy(layouts / name, folder / name)
printed, _ = rig.tunica(program, "import", folder / "bluehill_universal.csv", "--specimens", folder / "properties.csv", "-o",
                        folder / "areas.json")
sizes = next(iter(json.loads((folder / "areas.json").read_text())["tests"].values()))["data"]["specimen"]
assert sizes == {"area": "7.5 mm2", "gauge_length": "20 mm"}, sizes
assert "mm2 is assumed" in " ".join(printed.split()), printed

# How a file is laid out may be said, where it would be found otherwise or not at all.
(folder / "bare.txt").write_text("made by a script\nway;load\n" + "".join(f"0,{k};1,{k}\n" for k in range(10)))
printed, _ = rig.tunica(program, "import", folder / "bare.txt", *GAUGED, "--delimiter", ";", "--decimal", ",", "--skip-lines", "1",
                        "--rows", "1:8", "--column", "displacement=way", "--column", "force=load", "--unit", "way=mm", "--unit",
                        "load=N", "-o", folder / "bare.json")
data = next(iter(json.loads((folder / "bare.json").read_text())["tests"].values()))["data"]
assert (data["delimiter"], data["decimal"], data["skip_lines"], data["rows"]) == (";", ",", 1, "1:8"), data
printed, _ = rig.tunica(program, "check", folder / "bare.json")
assert "rows: 7 of the 10 in the file" in printed and "146.7 … 226.7 kPa" in printed, printed

# Sizes that say two things are refused.
for table, words in (
    ("specimen,width [mm],thickness [mm]\nadmet,5,1.5\nadmet,6,1.5\n", "lines 2 and 3 both have the specimen 'admet'"),
    ("specimen,width [mm],thickness [%]\nadmet,5,1.5\n", "'thickness' has the unit '%'"),
    ("specimen,width [mm],thickness [mm],Width 2 [mm]\nadmet,5,1.5,6\n", "'Width 2' comes to 6 mm, and a column before it to 5 mm"),
):
    shutil.copy(layouts / "admet.csv", folder / "admet.csv")
    (folder / "specimens.csv").write_text(table)
    _, said = rig.tunica(program, "import", folder / "admet.csv", "--gauge-length", "20 mm", "--specimens",
                         folder / "specimens.csv", "-o", folder / "sizes.json", code=2)
    assert words in " ".join(said.split()), said
(folder / "specimens.csv").write_text("specimen,width [mm],width sd [mm],thickness [mm]\nadmet,5,0.2,1.5\n")
rig.tunica(program, "import", folder / "admet.csv", "--gauge-length", "20 mm", "--specimens", folder / "specimens.csv", "-o",
           folder / "sizes.json")
sizes = next(iter(json.loads((folder / "sizes.json").read_text())["tests"].values()))["data"]["specimen"]
assert sizes["width"] == "5 mm", sizes

# A sheet in two files; rows that do not go together are refused, and no table is left.
for axis, scale in (("axial", 1.0), ("circ", 0.8)):
    (folder / f"sheet_{axis}.csv").write_text("Time (s),Force (N),Displacement (mm)\n" + "".join(
        f"{k},{scale * 0.1 * k * k:.3f},{0.1 * k:.1f}\n" for k in range(10)))
both = (folder / "sheet_circ.csv", folder / "sheet_axial.csv", "--join", "--thickness", "1 mm", "--width", "10 mm",
        "--gauge-length", "10 mm", "-o", folder / "joined.json")
rig.tunica(program, "import", *both)
test = json.loads((folder / "joined.json").read_text())["tests"]["joined"]
assert test["type"] == "biaxial" and test["data"]["columns"] == {
    "time": "Time", "force_circumferential": "Force circumferential", "displacement_circumferential":
    "Displacement circumferential", "force_axial": "Force axial", "displacement_axial": "Displacement axial"}, test
for made in ("joined.json", "joined.csv"):
    (folder / made).unlink()
# Labels of rows come along, so that steps of a protocol can be told apart.
for axis, scale in (("axial", 1.0), ("circ", 0.8)):
    (folder / f"step_{axis}.csv").write_text("Step,Time (s),Force (N),Displacement (mm)\n" + "".join(
        f"{'load' if k < 10 else 'hold'},{k},{scale * 0.1 * k * k:.3f},{0.1 * k:.1f}\n" for k in range(20)))
rig.tunica(program, "import", folder / "step_circ.csv", folder / "step_axial.csv", "--join", "--where", "Step=load", "--thickness",
           "1 mm", "--width", "10 mm", "--gauge-length", "10 mm", "-o", folder / "joined.json")
assert (folder / "joined.csv").read_text().splitlines()[1].startswith('"Step"')
test = json.loads((folder / "joined.json").read_text())["tests"]["joined"]
assert test["data"]["where"] == {"Step": "load"}, test
for made in ("joined.json", "joined.csv"):
    (folder / made).unlink()
(folder / "sheet_axial.csv").write_text("Time (s),Force (N),Displacement (mm)\n" + "".join(
    f"{k + 0.5},{0.1 * k * k:.3f},{0.1 * k:.1f}\n" for k in range(10)))
_, said = rig.tunica(program, "import", *both, code=2)
assert "Bring both to the same times" in " ".join(said.split()) and not (folder / "joined.csv").exists(), said
print(f"{len(ACCEPTED)} layouts are read, {len(REFUSED)} cases are asked about or refused")
