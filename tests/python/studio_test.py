# SPDX-License-Identifier: Apache-2.0
"""The page of the studio, served from Python."""
import json
import urllib.error
import urllib.request

import tunica
from support import Case


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
