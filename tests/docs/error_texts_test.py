#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""error_texts_test.py DOCS: what docs/error_texts.py reads out of C++."""
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv.pop(1))
from error_texts import GAP, NAMES, messages  # noqa: E402


class ErrorTexts(unittest.TestCase):
    def said(self, source, *expected, **options):
        self.assertEqual(list(messages(source, **options)), list(expected))

    def test_adjacent_literals_are_one_text(self):
        self.said('throw InputError("the bounds " "are reversed; swap them");', "the bounds are reversed; swap them")

    def test_what_is_known_at_run_time_only_is_a_gap(self):
        self.said('throw InputError(fmt::format("{}: row {:.3g} of {{}}", file, at(2, 3)));', f"{GAP}: row {GAP} of {{}}")
        self.said('throw InputError("the option \'" + name + "\' is \\"odd\\"");', f"the option '{GAP}' is \"odd\"")

    def test_numbered_fields_and_literal_arguments_are_filled_in(self):
        self.said('throw Refused(fmt::format("no {0}; give a {0}", "name"));', "no name; give a name")

    def test_branches_are_messages_of_their_own_and_short_ones_in_arguments_stand_side_by_side(self):
        self.said('return Status::failed(late ? "too late" : early ? "too early" : reason);', "too late", "too early", GAP)
        self.said('throw InputError(fmt::format("acts on a {}", model ? "model" : "test"));', "acts on a ⟨model/test⟩")

    def test_the_text_passes_through_a_local_function(self):
        wrapper = """const auto refuse = [&](std::string_view why, int = 0) -> double {
                       throw InputError(fmt::format("'{}' is no quantity: {}. Expected a number.", text, why)); };"""
        self.said(wrapper + 'return refuse("it is empty");', f"'{GAP}' is no quantity: it is empty. Expected a number.")

    def test_fail_joins_what_is_wrong_and_the_help(self):
        self.said('node.fail("no run is given", "Give one.");', "no run is given. Give one.")
        self.said('fail(at_, fmt::format("found {}", x), suggestion(x, all));', f"found {GAP}. {NAMES}")

    def test_constants_of_the_file_are_known(self):
        self.said('constexpr std::string_view cure = "rebuild it"; throw Refused(fmt::format("old; {}", cure));',
                  "old; rebuild it")

    def test_only_warnings_are_read_of_lists_and_comments_are_not_read(self):
        self.said('names.push_back("mu"); warnings.push_back("it is odd"); // throw InputError("no")', "it is odd")

    def test_returned_texts_count_where_asked_for(self):
        self.said('if (bad) return "no such file; check the path"; return {};')
        self.said('if (bad) return "no such file; check the path"; return {};', "no such file; check the path", returns=True)


unittest.main()
