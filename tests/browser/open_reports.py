# SPDX-License-Identifier: Apache-2.0
"""Makes reports as a user would and opens them in headless Chromium: of every folder under examples (budgets cut, see
making.py), of a diagnosis with a named cause, of a tie, of nothing detected, of profiles and bootstrap, of fields, of 100
realisations of four optimisers, of several folders, and of hostile names. Every chart is drawn, nothing on the console, no
request but for the file itself, values under pointer and keys, legend, zoom and saving at work, names inert; a page that is printed at once has every chart. What was
measured is printed. With --pictures there is one of every report, wide and light, narrow and dark, in OUTPUT/screenshots."""
import argparse
import pathlib
import sys

import making
from browser import Browser, available
from checks import (check_drawn, check_each_kind, check_intervals_apart, check_printed_unseen, check_quiet,
                    check_theme_and_paper, check_use)


def look_at(browser, file, name, pictures, seen):
    """On a desk, then on a telephone. `seen`: the kinds of charts that were on a telephone so far; where they are all of
    this report's, one look is enough. None: both looks."""
    for width, scheme in ((1280, "light"), (400, "dark")):
        browser.look(width, scheme)
        figures, milliseconds = check_drawn(browser, file)
        wide = browser.run("return document.documentElement.scrollWidth")
        assert wide <= width, f"{file}: {wide} px wide on a screen of {width}"
        if pictures:
            browser.screenshot(pictures / f"{name}_{width}_{scheme}.png")
        if width == 1280:
            first = browser.run("return document.documentElement.dataset.first") or milliseconds
            kinds = check_each_kind(browser, file)
            said = f"{name}: {figures} charts of {len(kinds)} kinds in {milliseconds} ms, the first screen in {first}"
        check_quiet(browser, file)
        if seen is not None and kinds <= seen:
            break
    if seen is not None:
        seen |= kinds
    print(f"{said}, {file.stat().st_size // 1024} KiB")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tunica", required=True)
    parser.add_argument("--generator")
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--pictures", action="store_true", help="keep a picture of every report, for people")
    parser.add_argument("--every", action="store_true", help="look at every example on a telephone, too, not only at new kinds of charts")
    options = parser.parse_args()
    if not available():
        print("skipped: no browser; apt-get install chromium chromium-driver")
        return 77
    making.begin(options.output)
    downloads, pictures = options.output / "downloads", options.output / "screenshots"
    files = making.reports(options, options.output.resolve())
    with Browser(downloads.resolve()) as browser:
        seen = set()
        for file in files:
            name = file.parent.name if file.name == "report.html" else file.stem
            example = (options.source / "examples" / name).exists() and not (options.every or options.pictures)
            look_at(browser, file, name, options.pictures and pictures, seen if example else None)
        browser.look(1280, "light")
        lamb = options.output.resolve() / "lamb_aorta/report.html"
        check_use(browser, lamb, downloads)
        check_theme_and_paper(browser, lamb, pictures)
        uncertainty = options.output.resolve() / "uncertainty/report.html"
        check_printed_unseen(browser, uncertainty, pictures / "unseen.pdf")
        check_intervals_apart(browser, uncertainty)
    many = (options.output / "many/report.html").read_text()
    assert "100 of 400 realisations are drawn" in many, "the report of 400 realisations does not say what it leaves out"
    return 0


if __name__ == "__main__":
    sys.exit(main())
