# SPDX-License-Identifier: Apache-2.0
"""The page of the studio, served from Python."""
import json
import os
import pathlib
import unittest.mock
import urllib.error
import urllib.request

import tunica
from support import PROGRAM, Case


class Studio(Case):
    def ask(self, page):
        """The project, as the page asks for it."""
        opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
        opener.open(page.address, timeout=30).close()
        host = page.address.split("/?")[0]
        request = urllib.request.Request(f"{host}/api/project", b"{}", {"Origin": host})
        with opener.open(request, timeout=30) as answer:
            return json.load(answer)

    def test_a_page_is_served_until_the_end_of_the_block(self):
        (self.folder / "strip.csv").write_text("stretch,stress [kPa]\n1,0\n1.1,2\n")
        with tunica.studio(self.folder, browser=False) as page:
            self.assertEqual(["strip.csv"], self.ask(page)["data"])
            self.assertIn(page.address, repr(page))
        with self.assertRaises(urllib.error.URLError):
            self.ask(page)

    def test_what_the_program_refuses_is_an_input_error(self):
        with self.assertRaisesRegex(tunica.InputError, "there is no such folder"):
            tunica.studio(self.folder / "missing", browser=False)
        with tunica.studio(self.folder, browser=False), self.assertRaisesRegex(tunica.InputError, "serves this folder"):
            tunica.studio(self.folder, browser=False)

    def in_path(self, script):
        """A package as a wheel has it, without its program, and a shell that finds this one."""
        found = self.folder / "bin" / "tunica"
        found.parent.mkdir(exist_ok=True)
        found.write_text(f"#!/bin/sh\n{script}\n")
        found.chmod(0o755)
        return (unittest.mock.patch("tunica.pages.PROGRAM", "nowhere"),
                unittest.mock.patch.dict(os.environ, {"PATH": f"{found.parent}:/bin:/usr/bin"}))

    def test_a_program_in_the_path_has_to_be_of_this_version(self):
        for script, words in (("echo tunica 0.0.7", "bin/tunica in PATH is tunica 0.0.7; expected tunica "),
                              ("exit 3", "is no tunica that tells its version; expected tunica ")):
            without, path = self.in_path(script)
            with without, path, self.assertRaisesRegex(tunica.InputError, words + tunica.__version__):
                tunica.studio(self.folder, browser=False)
        without, path = self.in_path(f'exec "{pathlib.Path(PROGRAM).absolute()}" "$@"')
        with without, path, tunica.studio(self.folder, browser=False) as page:
            self.assertEqual([], self.ask(page)["data"])

    def test_without_a_program_it_says_where_one_comes_from(self):
        with unittest.mock.patch("tunica.pages.PROGRAM", "nowhere"), \
                unittest.mock.patch.dict(os.environ, {"PATH": str(self.folder)}), \
                self.assertRaisesRegex(tunica.InputError, f"found none at .*nowhere or in PATH; .* Install tunica "
                                                          f"{tunica.__version__}"):
            tunica.studio(self.folder, browser=False)
