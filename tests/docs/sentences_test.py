#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sentences_test.py: what sentences.py counts as a sentence, and that it sees a long one."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import sentences

SCRIPT = pathlib.Path(__file__).with_name("sentences.py")
LONG = "This sentence goes on and on " + "and on " * 13 + "until nobody remembers how it began."


class Counting(unittest.TestCase):
    def lengths(self, text):
        return [len(words) for words in sentences.sentences(text)]

    def test_sentences_end_with_a_full_stop_before_a_capital(self):
        self.assertEqual(self.lengths("One two three. Four five six seven!\nEight nine ten"), [3, 4, 3])
        self.assertEqual(self.lengths("See e.g. J. Doe et al. 2018 for 3.5 kPa."), [10])

    def test_list_items_and_what_stands_before_them_are_sentences(self):
        self.assertEqual(self.lengths("There are two kinds:\n\n- one of them is this\n- the other is that\n  and more"), [4, 5, 6])

    def test_code_tables_headings_and_literature_are_no_sentences(self):
        text = "# A heading of four words\n\n```\nsome code in here\n```\n\n    more code in here\n\n| a | b | c |\n|---|---|---|\n"
        self.assertEqual(self.lengths(text + "\nA sentence with `some inline code` in it.\n\n## Literature\n- A. B., C 12 (2000).\n"), [6])

    def test_links_count_as_their_text_and_figures_not_at_all(self):
        self.assertEqual(self.lengths("Look at [this page](a/very/long.md#anchor).\n\n![A figure of it](b.png)"), [4])


class Failing(unittest.TestCase):
    def run_on(self, readme, page):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "docs").mkdir()
            (root / "README.md").write_text(readme)
            (root / "CONTRIBUTING.md").write_text("This is a short sentence.\n")
            (root / "docs/page.md").write_text(page)
            return subprocess.run([sys.executable, SCRIPT, root], capture_output=True, text=True, check=False)

    def test_short_sentences_pass(self):
        self.assertEqual(self.run_on("This is a short sentence.\n", "So is this one.\n").returncode, 0)

    def test_one_long_sentence_fails_in_the_readme_only(self):
        ended = self.run_on("Short sentences all around. " * 10 + LONG, "So is this one.\n")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("README.md: a sentence of 38 words, at most 30 are allowed", ended.stderr)
        ended = self.run_on("This is a short sentence.\n", "Short sentences all around. " * 10 + LONG)
        self.assertEqual(ended.returncode, 0)
        self.assertIn("38 words, docs/page.md: This sentence goes on", ended.stdout)

    def test_a_page_of_long_sentences_fails(self):
        ended = self.run_on("This is a short sentence.\n", LONG)
        self.assertEqual(ended.returncode, 1)
        self.assertIn("docs/page.md: 38.0 words a sentence on average, at most 20 are allowed", ended.stderr)


unittest.main()
