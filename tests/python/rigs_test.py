# SPDX-License-Identifier: Apache-2.0
"""import_rig writes what `tunica import` writes, and asks what that asks."""
import subprocess

import tunica
from support import Case, PROGRAM

STRIP = "Time (s),Displacement (mm),Force (N)\n" + "".join(f"{k},{0.5 * k},{0.02 * k * k}\n" for k in range(12))
SIZES = {"width": "5 mm", "thickness": "1 mm", "gauge_length": "20 mm"}


class Rigs(Case):
    def setUp(self):
        super().setUp()
        self.strip = self.folder / "strip.csv"
        self.strip.write_text(STRIP)

    def test_it_writes_what_the_program_writes(self):
        found = tunica.import_rig(self.strip, self.folder / "a.json", **SIZES)
        done = subprocess.run([PROGRAM, "import", self.strip, "-o", self.folder / "b.json", "--width", "5 mm", "--thickness",
                               "1 mm", "--gauge-length", "20 mm"], check=True, capture_output=True, text=True)
        self.assertEqual((self.folder / "b.json").read_text(), (self.folder / "a.json").read_text())
        self.assertTrue(found.in_order)
        self.assertIn("strip: stretch = 1 + displacement / 20 mm, from 'Displacement' in mm", found.understood)
        said = " ".join(done.stdout.split())
        for line in found.notes + found.understood:
            self.assertIn(" ".join(line.split()), said)
        self.assertEqual(found.file, self.folder / "a.json")
        self.assertEqual(tunica.check(found)["in_order"], found.in_order)

    def test_what_the_file_does_not_say_is_an_exception_with_the_text_of_the_program(self):
        with self.assertRaises(tunica.InputError) as asked:
            tunica.import_rig(self.strip, self.folder / "a.json", width="5 mm")
        done = subprocess.run([PROGRAM, "import", self.strip, "-o", self.folder / "b.json", "--width", "5 mm"], check=False,
                              capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertEqual(2, done.returncode)
        self.assertIn(" ".join(str(asked.exception).split()), " ".join(done.stderr.split()))
        self.assertIn("--thickness", str(asked.exception))
        self.assertFalse((self.folder / "a.json").exists())

    def test_arguments_of_a_wrong_kind_are_refused(self):
        for arguments in ({"columns": 3}, {"width": 5.0}, {"decimal": "x"}, {"skip_lines": "-1"}, {"each": "a\0"}):
            with self.assertRaises(tunica.InputError):
                tunica.import_rig(self.strip, self.folder / "a.json", **{**SIZES, **arguments})
        with self.assertRaises(tunica.InputError):
            tunica.import_rig([], self.folder / "a.json")

    def test_columns_units_and_options_are_dictionaries(self):
        self.strip.write_text(STRIP.replace("Force (N)", "Signal"))
        found = tunica.import_rig([self.strip], self.folder / "a.json", **SIZES, columns={"force": "Signal"},
                                  units={"Signal": "mN"}, direction="axial")
        data = found.input["tests"]["strip"]["data"]
        self.assertEqual("Signal", data["columns"]["force"])
        self.assertEqual("mN", data["units"]["Signal"])
        self.assertEqual("axial", found.input["tests"]["strip"]["direction"])
