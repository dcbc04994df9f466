# SPDX-License-Identifier: Apache-2.0
"""Makes reports as a user would and opens them in headless Chromium: every chart drawn, nothing on the console, no
request but for the file itself, values under pointer and keys, legend, zoom and saving at work, hostile names inert.
Screenshots are kept in OUTPUT/screenshots."""
import argparse
import pathlib
import shutil
import subprocess
import sys
import time

from browser import Browser, available
import hostile


def tunica(options, *arguments):
    ended = subprocess.run([options.tunica, "--allow-world-writable-plugins", *map(str, arguments)], capture_output=True,
                           text=True, timeout=120)
    assert ended.returncode in (0, 1), f"tunica {arguments}: {ended.stderr}"


def diagnosed(options, output, name, *what):
    if not options.generator:
        print(f"skipped: no diagnosis '{name}', discovery_generator is not built")
        return []
    cases = output / f"cases_{name}"
    subprocess.run([options.generator, "--out", cases, "--seed", "5", *what], check=True, capture_output=True, timeout=120)
    experiment = next(cases.glob("case-*/experiment.json"))
    tunica(options, "diagnose", experiment, "--quick", "--quiet", "-o", output / name)
    return [output / name / "report.html"]


def reports(options, output):
    examples = options.source / "examples"
    for name in ("lamb_aorta", "treloar"):
        tunica(options, "run", examples / name / "experiment.json", "--quiet", "-o", output / name)
    lamb = output / "lamb_aorta"
    tunica(options, "simulate", examples / "lamb_aorta/experiment.json", "--model", "gho", "--parameters",
           lamb / "result.json", "-o", output / "simulated")
    hostile.with_hostile_names(lamb, output / "hostile", "gho/lm")
    hostile.with_many_realisations(lamb, output / "many", 100)
    for name in ("hostile", "many"):
        tunica(options, "report", output / name)
    tunica(options, "report", lamb, output / "many", "-o", output / "side_by_side.html")
    files = [output / name / "report.html" for name in ("lamb_aorta", "treloar", "simulated", "hostile", "many")]
    files.append(output / "side_by_side.html")
    files += diagnosed(options, output, "named", "--set", "singles", "--effect", "fibre_dispersion", "--lambda", "150", "--cases", "0:1")
    files += diagnosed(options, output, "nothing", "--set", "nulls", "--cases", "0:1")
    return files


def check_drawn(browser, file):
    assert file.stat().st_size <= 3 * 2**20, f"{file}: {file.stat().st_size} bytes"
    fastest = 1e9
    for _ in range(3):  # a busy machine may be slow once
        drawn, failed, milliseconds, figures = browser.open(file)
        assert figures > 0 and drawn == figures and failed == 0, f"{file}: {drawn} of {figures} charts drawn, {failed} failed"
        fastest = min(fastest, milliseconds)
        if fastest < 2000:
            break
    assert fastest < 2000, f"{file}: drawn in {fastest} ms"
    empty = browser.run("return tunicaFigures.filter(f => !f.canvas.querySelector('svg path, svg rect')).map(f => f.chart.title)")
    assert not empty, f"{file}: charts without marks: {empty}"
    unnamed = browser.run("return document.querySelectorAll('.plot:not([aria-label]), svg[role=img]:not([aria-label])').length")
    assert unnamed == 0, f"{file}: {unnamed} charts without a label for screen readers"
    return figures, fastest


def check_quiet(browser, file):
    console = browser.log("browser")
    assert not console, f"{file}: console: {console}"
    asked = [url for url in browser.requests() if not url.startswith(("data:", "blob:", file.as_uri()))]
    assert not asked, f"{file}: requests: {asked}"
    assert browser.run("return window.hacked === undefined"), f"{file}: a name was run"
    assert browser.run("return document.querySelectorAll('main img, main script').length") == 0, f"{file}: a name became an element"


def box(browser, selector):
    return browser.run("const e = document.querySelector(arguments[0]); e.scrollIntoView({block: 'center'});"
                       "const r = e.getBoundingClientRect(); return [r.x, r.y, r.width, r.height]", selector)


def check_use(browser, file, downloads):
    """The first chart with a curve, by mouse and by keys."""
    browser.open(file)
    chart = browser.run("return document.querySelectorAll('figure .legend button').length") and "figure:has(.legend button)"
    x, y, width, height = box(browser, f"{chart} .canvas")
    said = f"return document.querySelector('{chart} .value').textContent"
    for step in range(30):
        browser.mouse("mouseMoved", x + width * 0.1 + step * width * 0.03, y + height * 0.5)
        if browser.run(said):
            break
    assert ":" in browser.run(said), "no value under the pointer"
    browser.run(f"document.querySelector('{chart} .plot').focus()")
    browser.key("ArrowRight")
    first = browser.run(said)
    browser.key("ArrowRight")
    assert first and browser.run(said) != first, "the arrow keys do not read values"
    marks = f"return document.querySelectorAll('{chart} .canvas path').length"
    before = browser.run(marks)
    browser.run(f"document.querySelector('{chart} .legend button').click()")
    time.sleep(0.3)
    assert browser.run(marks) < before, "switching a series off leaves it"
    browser.mouse("mouseMoved", x + width * 0.4, y + height * 0.3)
    browser.mouse("mousePressed", x + width * 0.4, y + height * 0.3)
    browser.mouse("mouseMoved", x + width * 0.7, y + height * 0.6)
    browser.mouse("mouseReleased", x + width * 0.7, y + height * 0.6)
    zoom = browser.run(f"const e = document.querySelector('{chart}'); return tunicaFigures.find(f => f.element === e).zoom")
    assert set(zoom) == {"xdom", "ydom"} and zoom["xdom"][0] < zoom["xdom"][1], f"zoom: {zoom}"
    for label in ("SVG", "PNG", "CSV"):
        browser.run(f"[...document.querySelectorAll('{chart} .tool')].find(b => b.textContent === '{label}').click()")
    for _ in range(100):
        saved = {path.suffix: path for path in downloads.iterdir()}
        if {".svg", ".png", ".csv"} <= set(saved):
            break
        time.sleep(0.05)
    assert saved[".png"].read_bytes()[:4] == b"\x89PNG" and saved[".svg"].read_text().startswith("<svg")
    assert saved[".csv"].read_text().startswith("series,")
    check_quiet(browser, file)


def check_theme_and_paper(browser, file):
    browser.look(1280, "dark")
    browser.open(file)
    paper = "return getComputedStyle(document.body).backgroundColor"
    ink = "return getComputedStyle(document.querySelector('.canvas svg')).backgroundColor"
    dark, drawn = browser.run(paper), browser.run(ink)
    browser.run("document.getElementById('theme').click()")
    time.sleep(0.5)
    assert browser.run(paper) == "rgb(255, 255, 255)" != dark, "the button does not change the theme"
    assert browser.run(ink) == "rgb(255, 255, 255)" != drawn, "the charts do not follow the theme"
    browser.run("document.getElementById('theme').click()")
    browser.devtools("Emulation.setEmulatedMedia", media="print")
    assert browser.run(paper) == "rgb(255, 255, 255)", "dark on paper"
    browser.devtools("Emulation.setEmulatedMedia", media="screen")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tunica", required=True)
    parser.add_argument("--generator")
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    options = parser.parse_args()
    if not available():
        print("skipped: no browser; apt-get install chromium chromium-driver")
        return 77
    shutil.rmtree(options.output, ignore_errors=True)
    downloads, pictures = options.output / "downloads", options.output / "screenshots"
    downloads.mkdir(parents=True)
    pictures.mkdir()
    files = reports(options, options.output.resolve())
    with Browser(downloads.resolve()) as browser:
        for file in files:
            name = file.parent.name if file.name == "report.html" else file.stem
            for width, scheme in ((1280, "light"), (400, "dark")):
                browser.look(width, scheme)
                figures, milliseconds = check_drawn(browser, file)
                wide = browser.run("return document.documentElement.scrollWidth")
                assert wide <= width, f"{file}: {wide} px wide on a screen of {width}"
                check_quiet(browser, file)
                browser.screenshot(pictures / f"{name}_{width}_{scheme}.png")
            print(f"{name}: {figures} charts in {milliseconds} ms, {file.stat().st_size // 1024} KiB")
        browser.look(1280, "light")
        check_use(browser, files[0], downloads)
        check_theme_and_paper(browser, files[0])
    many = (options.output / "many/report.html").read_text()
    assert "100 of 400 realisations are drawn" in many, "the report of 400 realisations does not say what it leaves out"
    return 0


if __name__ == "__main__":
    sys.exit(main())
