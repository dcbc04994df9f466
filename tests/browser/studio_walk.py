# SPDX-License-Identifier: Apache-2.0
"""From a stranger's rig file to a diagnosed, extended, exported result in headless Chromium, with three numbers typed. Then
the browser is opened again, the server killed in the middle of a fit and taken up, names that would act are shown, and
every page at 400 px, dark, with its names for screen readers. With --pictures there is one of each page in OUTPUT/pictures."""
import argparse
import json
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys
import time

from browser import Browser, available
from studio_page import Page
from studio_parts import (a_running_job_leads_to_its_page, each_run_of_a_cohort_has_its_table, mistakes_stand_as_the_diagnosis_says, one_queue_a_connection,
                          tests_of_the_first_specimen_that_has_them, texts_survive_leaving)
from studio_server import Studio, cohort_of_strips, mistaken_experiment, rig_file, slow_experiment

# Something is drawn on the canvas of points (0) or of lines (1) of the first chart.
INK = """const c = document.querySelectorAll('.chart canvas')[arguments[0]];
  if (!c || !c.width) return false;
  const copy = new OffscreenCanvas(c.width, c.height).getContext('2d', { willReadFrequently: true });
  copy.drawImage(c, 0, 0);
  return new Uint32Array(copy.getImageData(0, 0, c.width, c.height).data.buffer).some(Boolean)"""
MARKUP = "<img src=x onerror=window.hacked=1>"


def import_rig_file(page, file):
    page.choose_file(file)
    page.see("What was understood")
    page.until(INK, 0, seconds=10)
    page.see("with example sizes")
    for option, size in (("--width", "6 mm"), ("--thickness", "1.5 mm"), ("--gauge-length", "20 mm")):
        page.set(f"[data-option='{option}']", size)
    page.see("stretch = 1 + displacement / 20 mm")
    page.until("return !document.body.innerText.includes('with example sizes')")
    page.see("tunica import strip.txt")
    page.picture("data", 1110)
    page.click("Write the experiment")
    page.see("Curve over the data")


def all_cycles_by_one_click(page, folder):
    """Of three cycles the last loading is taken, which the page says in the open, with a button that takes the history."""
    loop = [*range(30), *range(30, 0, -1)]
    rows = [f"{0.5 * t};{0.05 * k};{0.2 * k}" for t, k in enumerate(3 * loop + [0])]
    (folder / "cycles.csv").write_text("\n".join(["Time [s];Force [N];Extension [mm]", *rows]))
    page.go("data", "cycles.csv")
    page.see("the last cycle, loading only")
    page.click("Take all cycles")
    page.see("rows: all cycles")
    page.see("--cycle all")
    page.until("return !document.body.innerText.includes('Take all cycles')")


def move_sliders(page):
    """The curve is another one after each move; returns the times from a move to its frame, ms."""
    page.set("select", "neo_hooke")
    page.until("return document.querySelector('[data-parameter=mu]')")
    page.until(INK, 1)
    line = "return document.querySelectorAll('.chart canvas')[1].toDataURL()"
    before = page.browser.run(line)
    page.browser.run("""window.tunicaFrames = []; const n = document.querySelector('[data-parameter=mu]');
      let at = 303; const move = () => { n.value = at; n.dispatchEvent(new Event('input')); if ((at += 8) < 640) setTimeout(move, 16); else n.dataset.moved = ""; }; move();""")
    page.until("return tunicaFrames.length >= 10 && document.querySelector('[data-moved]')")
    page.until("return !document.body.innerText.includes('misses by –')")
    assert page.browser.run(line) != before, "the curve does not follow the slider"
    frames = page.browser.run("return tunicaFrames.map((one) => one.frame)")
    page.set("[data-parameter=mu]", "565")
    page.until("return document.querySelector('.tag')?.textContent === 'stable'")
    page.picture("material", 780)
    whole = page.browser.run(line)
    page.browser.run("document.querySelector('.chart').focus()")  # by keys alone
    for key, zoomed in (("+", True), ("ArrowLeft", True), ("0", False)):
        page.browser.key(key)
        page.until("return document.querySelector('.chart').classList.contains('zoomed') === arguments[0]", zoomed)
        page.until("return (document.querySelectorAll('.chart canvas')[1].toDataURL() !== arguments[0]) === arguments[1]", whole, zoomed)
    return frames


def fit(page):
    page.click("Next: fit")
    page.see("as the file says: neo_hooke/lm")
    page.set("input[type=number]", "3000")
    page.click("Fit")
    page.see("What came out")
    page.until("return document.querySelectorAll('.live .legend span').length === 2")
    page.see("neo_hooke/es")
    page.picture("fit", 1650)


def sliders_at_the_fit(page):
    page.go("model", "strip.json")
    page.set("[data-from]", "0")
    page.until("return Math.abs(Number(document.querySelector('input.number').value) - 328.47) < 0.1")
    page.see("objective 0.65122")  # that of the run
    page.go("fit", "strip.json")


def diagnose(page, folder):
    page.click("Find out what is wrong")
    page.click("Diagnose")
    page.see("What was found")
    page.see("In a shell: tunica diagnose strip.json")
    page.until("return document.querySelectorAll('svg .bar').length >= 2")
    page.picture("causes")
    page.click("Accept")
    page.see("What came out")
    assert list(folder.glob("results/strip-diagnosis-1-extended-fit-1/result.json"))


def compare_and_take_away(page, folder, host):
    page.go("history")
    depths = page.browser.run("return [...document.querySelectorAll('tbody tr')].map((r) => [r.children[1].className, r.children[1].innerText, r.children[2].innerText])")
    assert [depth for depth, *_ in depths] == ["depth0", "depth1", "depth1", "depth2", "depth3"], depths
    misses = [text for _, name, text in depths if "fit-1" in name]
    assert "%" in misses[0] and misses[0] != misses[1], f"the extended model misses as its parent does: {misses}"
    page.picture("history")
    page.browser.run("document.querySelectorAll('tbody input').forEach((box) => box.click())")
    page.click("Compare those")
    page.see("Open comparison.html")
    page.go("fit", "strip.json")
    page.see("Write the card")
    page.click("Write the card")
    page.see("Save cards/strip-fit-1-febio.feb")
    assert "<material" in (folder / "cards/strip-fit-1-febio.feb").read_text()
    for words in ("Report", "fit_strip.csv", "In Python"):
        page.see(words)
    page.check_quiet(host)
    report = page.browser.run("return [...document.querySelectorAll('a')].find((a) => a.textContent.startsWith('Report')).href")
    page.browser.call("POST", page.browser.session + "/url", {"url": report})
    page.until("return document.documentElement.dataset.drawn")
    assert page.browser.run("return document.documentElement.dataset.failed") == "0"
    assert page.browser.run("return window.origin") == "null", "a report is shown with the origin of the page"


def edits_change_only_what_is_shown(page):
    """The page's own functions on a file of two runs, one of which is not shown."""
    page.browser.run("""import("/page/edits.js").then((edits) => {
      const file = () => ({ models: { a: { type: "neo_hooke", mechanisms: [{ type: "viscoelasticity" }] }, b: { type: "ogden", terms: 2 } },
        tests: { one: {}, two: { mechanisms: [{ type: "force_offset" }] } }, optimizers: { lm: { type: "ceres_lm", starts: 3 } },
        runs: [{ model: "a", optimizer: "lm" }, { model: "b", optimizer: "lm", tests: ["two"] }], stop: { max_evaluations: 9 } });
      const made = (change) => { const one = file(); change(one); return one; };
      let failed = "";
      try { edits.setParameters(file(), 0, [{ name: "none.x", initial: 1 }], [2]); } catch (error) { failed = error.message; }
      window.edited = { before: file(), failed, model: made((one) => edits.setModel(one, 0, "yeoh", {})), known: made((one) => edits.setModel(one, 0, "ogden", {})),
        runs: made((one) => edits.setRuns(one, [["lm", { type: "ceres_lm", starts: 20 }]], 50)), tests: made((one) => edits.setTests(one, 0, ["one"], new Set(), new Map())),
        values: made((one) => edits.setParameters(one, 0, [{ name: "mu", initial: 1 }, { name: "viscoelasticity.tau", initial: 1 }, { name: "two.force_offset.value", initial: 1 }], [2, 3, 4])) };
    })""")
    page.until("return window.edited")
    found = page.browser.run("return window.edited")
    before, (first, second) = found["before"], found["before"]["runs"]
    assert found["model"]["models"] == {**before["models"], "yeoh": {"type": "yeoh", "mechanisms": [{"type": "viscoelasticity"}]}}, found["model"]
    assert found["model"]["runs"] == [{**first, "model": "yeoh"}, second], found["model"]
    assert found["known"] == {**before, "runs": [{**first, "model": "b"}, second]}, found["known"]
    assert found["runs"]["runs"] == [first, second, {**first, "optimizer": "lm_2", "stop": {"max_evaluations": 50}}], found["runs"]
    assert found["runs"]["optimizers"]["lm"] == before["optimizers"]["lm"] and found["runs"]["stop"] == before["stop"], found["runs"]
    assert found["tests"]["runs"] == [{**first, "tests": ["one"]}, second], found["tests"]
    values = found["values"]
    assert values["models"]["a"]["parameters"]["mu"] == {"initial": 2} and values["models"]["b"] == before["models"]["b"], values
    assert values["models"]["a"]["mechanisms"][0]["parameters"]["tau"] == {"initial": 3}, values
    assert values["tests"]["two"]["mechanisms"][0]["parameters"]["value"] == {"initial": 4} and "none.x" in found["failed"], found


def nothing_acts(page, folder, studio):
    (folder / f"{MARKUP}.csv").write_text(f"{MARKUP} [N];displacement [mm]\n" + "".join(f"{k};{k}\n" for k in range(9)))
    (folder / f"{MARKUP}.json").write_text('{"format": 1, "models": {}, "tests": {}}')
    page.open(studio.address)
    page.see(MARKUP)
    page.click(f"{MARKUP}.csv")
    page.see("Columns")
    page.see(f"{MARKUP}.csv")
    page.go("")
    page.click(f"{MARKUP}.json")
    page.until("return document.querySelector('.box.bad')")
    assert page.browser.run("return window.hacked === undefined && !document.querySelector('img')"), "a name has acted"


def one_sheet(page):
    """A fit and a diagnosis are one page each, also from a dark screen, with their curves as ink."""
    for name, words in (("strip-fit-1", "Agreement"), ("strip-diagnosis-1", "How much of the range is missed")):
        page.go("sheet", f"results%2F{name}")
        page.see(words)
        page.browser.look(1280, "dark")
        pages = len(re.findall(rb"/Type\s*/Page[^s]", page.browser.pdf()))
        page.browser.look(1280, "light")
        assert pages == 1, f"{name}: {pages} pages"
    page.go("sheet", "results%2Fstrip-fit-1")
    page.until(INK, 1)
    page.picture("sheet")


def editor(page, folder):
    """What may stand at the caret, what the program says of the text and where, and a file that somebody else has changed."""
    before = (folder / "strip.json").read_text()
    page.go("file", "strip.json")
    page.see("the program can read it")
    page.browser.run("""const n = document.getElementById('text'); n.focus(); const at = n.value.indexOf('"runs"'); n.setSelectionRange(at, at);
      document.execCommand('insertText', false, '"seeed": 3,\\n  ')""")
    page.see("unknown key 'seeed'")
    line = before[:before.index('"runs"')].count("\n") + 1
    page.see(f"Go to line {line}")
    assert page.browser.run("return document.querySelector('.numbers .wrong').textContent.trim()") == str(line)
    page.click("Save")
    page.until("return [...document.querySelectorAll('.box.bad')].length === 2")  # it is not written
    assert (folder / "strip.json").read_text() == before
    select = "const n = document.getElementById('text'), at = n.value.indexOf(arguments[0]); n.focus(); n.setSelectionRange(at, at + arguments[0].length)"
    page.browser.run(select, '"seeed"')
    for letter in '"seed"':  # by hand, with the list beside it
        page.browser.devtools("Input.dispatchKeyEvent", type="keyDown", key=letter, text=letter)
        page.browser.devtools("Input.dispatchKeyEvent", type="keyUp", key=letter)
    page.until("return document.querySelector('.options').hidden")
    typed = page.browser.run("return document.getElementById('text').value")
    assert typed == before.replace('"runs"', '"seed": 3,\n  "runs"', 1), typed
    page.browser.run(select, '"seed"')
    page.browser.devtools("Input.dispatchKeyEvent", type="keyDown", key='"', text='"')
    page.until("return !document.querySelector('.options').hidden")
    offered = page.browser.run("return [...document.querySelectorAll('.options li')].map((one) => one.textContent)")
    assert "seed" in offered and "tests" not in offered, offered
    while page.browser.run("return document.querySelector('.options [aria-selected=true]').textContent") != "seed":
        page.browser.key("ArrowDown")
    page.browser.key("Enter")
    page.see("the program can read it")
    page.click("Save")
    page.see("strip.json is saved")
    assert json.loads((folder / "strip.json").read_text())["seed"] == 3
    (folder / "strip.json").write_text(before)
    page.click("Save")
    page.see("the file has changed since")
    assert (folder / "strip.json").read_text() == before
    refused = [entry["message"] for entry in page.browser.log("browser")]
    assert len(refused) == 2 and all("/api/save" in one for one in refused), refused


def cohort(page, options, folder):
    """Specimens as a grid: each drawn once it is in sight, worst first, and filtered."""
    file = cohort_of_strips(folder / "many", 60)
    subprocess.run([options.tunica, "cohort", str(file), "-o", str(folder / "results/strips"), "--quiet", "--no-reports"], check=True, stdout=subprocess.DEVNULL)
    page.go("history")
    page.click("Specimens")
    page.see("60 of 60 specimens")
    drawn = "return document.querySelectorAll('.tile .chart').length"
    page.until(drawn + " >= 4")
    assert page.browser.run(drawn) < 60, "all are drawn, though most are out of sight"
    ids = page.browser.run("return [...document.querySelectorAll('.tile h3')].map((one) => one.textContent)")
    assert sorted(ids[:12]) == [f"s{k:03}" for k in range(4, 60, 5)], ids
    page.picture("cohort")
    page.browser.run("document.querySelector('.tile:last-child').scrollIntoView()")
    page.until("return document.querySelector('.tile:last-child .chart')")
    page.browser.run("const n = [...document.querySelectorAll('select')].at(-1); n.value = 'fitted'; n.dispatchEvent(new Event('change'))")
    page.see("60 of 60 specimens")
    page.click("s004")
    page.see("Agreement")


def mistake_taken_back(page, folder):
    """The file says true stresses and means nominal ones: it is asked before any cause, the diagnosis offers it, and the copy
    fits."""
    page.go("model", "mistaken.json")
    page.click("Try other readings")
    page.see("are first Piola–Kirchhoff stresses, not Cauchy ones, this fits")
    assert page.browser.run("return Boolean(document.querySelector('.mistake svg.meaning'))")
    page.go("causes", "mistaken.json")
    page.click("Diagnose")
    page.see("are first Piola–Kirchhoff stresses, not Cauchy ones, this fits")
    assert page.browser.run("return document.querySelector('.verdict').innerText") == "Does the file say what is so?"
    page.picture("mistake", 1240)
    page.click("Take it so, and fit")
    page.see("What came out")
    page.go("history")
    names = page.browser.run("return [...document.querySelectorAll('tbody tr')].map((row) => [row.children[1].className, row.children[1].innerText.trim()])")
    assert names.index(["depth0", "mistaken.json"]) < names.index(["depth1", "mistaken-2.json"]), names
    assert '"cauchy"' in (folder / "mistaken.json").read_text() and '"cauchy"' not in (folder / "mistaken-2.json").read_text()


def every_page_narrow_and_dark(page, examples=("fit", "causes", "model")):
    page.browser.look(400, "dark")
    assert page.browser.run("return getComputedStyle(document.body).backgroundColor") == "rgb(22, 25, 29)"
    for kind, name in (("", ""), ("history", ""), ("data", "strip.txt"), ("file", "strip.json"), ("sheet", "results%2Fstrip-fit-1"), ("cohort", "results%2Fstrips"),
                       *((kind, "strip.json") for kind in examples)):
        page.go(kind, name)
        time.sleep(0.3)
        page.check_fits(400)
        page.check_named()
        page.picture(f"narrow_{kind or 'start'}")
    page.browser.look(1280, "light")


def killed_and_taken_up(options, folder, downloads):
    with Studio(options.tunica, folder) as studio, Browser(downloads) as browser:
        page = Page(browser)
        page.open(studio.address)
        page.go("fit", "slow.json")
        page.click("Fit")
        page.until("const n = document.querySelector('.live')?.innerText.match(/([\\d,]+) evaluations/); return n && Number(n[1].replace(',', '')) > 100")
        studio.process.send_signal(signal.SIGKILL)
    with Studio(options.tunica, folder) as studio, Browser(downloads) as browser:
        page = Page(browser)
        page.open(studio.address)
        page.see("Running and interrupted")
        page.click("Resume")
        page.see("What came out")
        assert (folder / "results/slow-fit-1/result.json").exists() and not (folder / "results/slow-fit-2").exists()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tunica", required=True)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--pictures", action="store_true", help="keep a picture of every page, for people")
    options = parser.parse_args()
    if not available():
        print("skipped: no browser; apt-get install chromium chromium-driver")
        return 77
    output = options.output.resolve()
    shutil.rmtree(output, ignore_errors=True)
    folder, downloads, pictures = (output / name for name in ("rubber", "downloads", "pictures"))
    for place in (folder, downloads, pictures):
        place.mkdir(parents=True)
    raw = output / "strip.txt"
    raw.write_bytes(rig_file())
    with Studio(options.tunica, folder) as studio:
        with Browser(downloads) as browser:
            page = Page(browser, pictures if options.pictures else None)
            browser.look(1280, "light")
            way = output / "open.html"  # as the studio writes it for the browser: from a file, which is another site
            way.write_text(f'<meta http-equiv="refresh" content="0;url={studio.address}">')
            page.open(way.as_uri())
            browser.log("performance")  # has the file
            assert "token" not in browser.run("return location.href"), "the token stays in the address"
            assert browser.run("return document.cookie") == "", "scripts can read the cookie"
            page.picture("start")
            import_rig_file(page, raw)
            frames = move_sliders(page)
            print(f"from a slider to its frame: {statistics.median(frames):.1f} ms, at most {max(frames):.1f} ms, {len(frames)} frames")
            fit(page)
            sliders_at_the_fit(page)
            diagnose(page, folder)
            compare_and_take_away(page, folder, studio.host)
        with Browser(downloads) as browser:  # another browser, the same state
            page = Page(browser, pictures if options.pictures else None)
            page.open(studio.address)
            page.see("strip-diagnosis-1-extended-fit-1")
            page.go("fit", "strip.json")
            page.see("What came out")
            one_sheet(page)
            editor(page, folder)
            texts_survive_leaving(page, "strip.json")
            mistakes_stand_as_the_diagnosis_says(page, folder)
            cohort(page, options, folder)
            each_run_of_a_cohort_has_its_table(page, folder)
            every_page_narrow_and_dark(page)
            page.check_quiet(studio.host)
            edits_change_only_what_is_shown(page)
            one_queue_a_connection(page)
            a_running_job_leads_to_its_page(page)
            tests_of_the_first_specimen_that_has_them(page)
            all_cycles_by_one_click(page, folder)
            mistaken_experiment(options.source, folder)
            mistake_taken_back(page, folder)
            nothing_acts(page, folder, studio)
    slow = output / "slow"
    slow.mkdir()
    slow_experiment(options.source, slow)
    killed_and_taken_up(options, slow, downloads)
    return 0


if __name__ == "__main__":
    sys.exit(main())
