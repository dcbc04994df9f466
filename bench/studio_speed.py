#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long the page of `tunica studio` takes from a slider to the frame that shows the curve, and from a wheel or a
drag over a chart to its frame, and how a cohort scrolls, in headless Chromium. Prints medians and the worst; asserts nothing.

    bench/studio_speed.py [--tunica build/release/bin/tunica] [--moves 200] [--specimens 500] [--profile]

Sliders move every 20 ms, at any phase of the frames, which come every 16.7 ms. `to frame` is from the event to the end of
the frame's drawing, for every frame that shows a new answer; `answer` is the part until the answer of the server has come,
`drawing` what the page draws after that. `server` is what the core computes. --profile adds what Chromium's profiler saw."""
import argparse
import collections
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(SOURCE / "tests/browser"))
from browser import Browser  # noqa: E402
from studio_page import Page  # noqa: E402
from studio_server import Studio, cohort_of_strips  # noqa: E402

MOVE = """const [moves, done] = [arguments[0], arguments[1]], knobs = [...document.querySelectorAll('[data-parameter]')];
window.tunicaFrames = [];
let k = 0;
const step = () => {
  const knob = knobs[Math.floor(k / 40) % knobs.length], at = 500 + 100 * Math.sin(k / 6);
  knob.value = at;
  knob.dispatchEvent(new Event('input'));
  if (++k < moves) setTimeout(step, 20); else setTimeout(() => done(window.tunicaFrames), 600);
};
step();"""

WHEEL = """const [moves, done] = [arguments[0], arguments[1]], place = document.querySelector('.chart').getBoundingClientRect();
const target = document.querySelector('.chart');
const times = [];
let k = 0, last = 0;
const step = (now) => {
  if (k > 1) times.push(now - last);
  last = now;
  const x = place.left + place.width * (0.5 + 0.3 * Math.sin(k / 9)), y = place.top + place.height / 2;
  if (k % 2) target.dispatchEvent(new WheelEvent('wheel', { bubbles: true, cancelable: true, deltaY: k % 120 < 60 ? -40 : 40, clientX: x, clientY: y, ctrlKey: true }));
  else for (const [type, by] of [['pointerdown', 0], ['pointermove', 15], ['pointerup', 15]])
    target.dispatchEvent(new PointerEvent(type, { bubbles: true, clientX: x + by, clientY: y, button: 0, buttons: 1, pointerId: 1, isPrimary: true }));
  if (++k < moves) requestAnimationFrame(step); else done(times);
};
requestAnimationFrame(step);"""


def strip(direction):
    return {"type": "uniaxial", "direction": direction, "data": {"file": f"s_{direction}.csv", "columns": {"stretch": "stretch", "stress": "stress"}}}


def experiment(folder, name, model, tests):
    document = {"format": 1, "name": name, "seed": 1, "models": {model["type"]: model}, "tests": tests, "optimizers": {"lm": {"type": "ceres_lm", "starts": 1}},
                "runs": [{"model": model["type"], "optimizer": "lm"}]}
    (folder / f"{name}.json").write_text(json.dumps(document, indent=1))
    return f"{name}.json"


def strips_and_tube(folder):
    for name in ("s_circumferential", "s_axial"):
        (folder / f"{name}.csv").write_bytes((SOURCE / f"examples/cn_pressurisation/{name}.csv").read_bytes())
    (folder / "tube.csv").write_bytes((SOURCE / "examples/cn_pressurisation/s_tube.csv").read_bytes())
    tube = {"type": "thick_wall_pressurisation", "inner_radius": "3.71 mm", "thickness": "2.06 mm", "axial_stretch": 1.2,
            "data": {"file": "tube.csv", "columns": {"pressure": "pressure", "outer_diameter_stretch": "outer_diameter_stretch"}}}
    return experiment(folder, "strips_and_tube", {"type": "gho"}, {"circumferential": strip("circumferential"), "axial": strip("axial"), "tube": tube})


def plate(folder):
    rows = [f"{1 + 0.04 * k},{0.8 * 30 * (1 + 0.04 * k - (1 + 0.04 * k)**-2):.5f}" for k in range(11)]
    (folder / "plate.csv").write_text("stretch [-],stress [kPa]\n" + "\n".join(rows))
    test = {"type": "plane_specimen", "shape": "plate_with_hole", "length": "20 mm", "width": "10 mm", "hole_radius": "2 mm", "direction": "axial", "elements": [20, 10],
            "data": {"file": "plate.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "stress_measure": "first_piola_kirchhoff"}}
    return experiment(folder, "plate", {"type": "neo_hooke"}, {"plate": test})


def many_rows(folder, count=50000):
    """A strip in 25 cycles, with noise; a sum of sines in place of random numbers."""
    rows = []
    for k in range(count):
        stretch = 1.001 + 0.4 * (1 - math.cos(2 * math.pi * 25 * k / count)) / 2
        noise = math.sin(12.9898 * k) * 2 + math.sin(78.233 * k)
        rows.append(f"{stretch:.6f},{30 * (stretch**2 - 1 / stretch) + noise:.5f}")
    (folder / "many.csv").write_text("stretch [-],stress [kPa]\n" + "\n".join(rows))
    test = {"type": "uniaxial", "direction": "axial", "data": {"file": "many.csv", "columns": {"stretch": "stretch", "stress": "stress"}}}
    return experiment(folder, "many", {"type": "neo_hooke"}, {"strip": test})


SCROLL = """const [steps, done] = arguments, times = [];
let k = 0, last = 0;
const step = (now) => {
  if (k > 1) times.push(now - last);
  last = now;
  scrollBy(0, 60);
  if (++k < steps && scrollY + innerHeight < document.documentElement.scrollHeight - 1) requestAnimationFrame(step);
  else setTimeout(() => done([times, document.querySelectorAll('.tile .chart').length]), 300);
};
requestAnimationFrame(step);"""


def asynchronous(browser, script, *arguments):
    return browser.call("POST", browser.session + "/execute/async", {"script": script, "args": list(arguments)})


def row(name, times):
    return f"  {name:10} median {statistics.median(times):6.1f} ms   worst {max(times):6.1f} ms" if times else f"  {name:10} –"


def hot(profile):
    """Own time by function, of Chromium's sampling profiler."""
    nodes, own = {node["id"]: node for node in profile["nodes"]}, collections.Counter()
    for identity, delta in zip(profile["samples"], profile["timeDeltas"]):
        frame = nodes[identity]["callFrame"]
        own[f"{frame['functionName'] or '(nameless)'} {frame['url'].rsplit('/', 1)[-1]}:{frame['lineNumber'] + 1}"] += delta / 1000
    return [f"    {time:8.1f} ms  {name}" for name, time in own.most_common(14)]


def sliders(page, name, moves, profile):
    page.go("model", name)
    page.until("return document.querySelector('[data-parameter]') && document.querySelector('.tag')")
    asynchronous(page.browser, MOVE, 20)
    if profile:
        page.browser.devtools("Profiler.enable"), page.browser.devtools("Profiler.start")
    frames = asynchronous(page.browser, MOVE, moves)
    seen = hot(page.browser.devtools("Profiler.stop")["profile"]) if profile else []
    print(f"{name}: {moves} moves, {len(frames)} frames")
    for key, title in (("frame", "to frame"), ("answer", "answer"), ("drawing", "drawing"), ("server", "server")):
        print(row(title, [one[key] for one in frames if key in one]))
    print("\n".join(seen), flush=True)


def zoom(page, name, moves, profile):
    page.go("model", name)
    page.until("return document.querySelector('.chart')")
    if profile:
        page.browser.devtools("Profiler.enable"), page.browser.devtools("Profiler.start")
    times = asynchronous(page.browser, WHEEL, moves)
    seen = hot(page.browser.devtools("Profiler.stop")["profile"]) if profile else []
    print(f"{name}: zoomed and moved {moves} times, {1000 / statistics.mean(times):.0f} frames a second")
    print(row("frame", times))
    print("\n".join(seen), flush=True)


def specimens(page, folder, tunica, count):
    file = cohort_of_strips(folder / "many", count)
    subprocess.run([tunica, "cohort", str(file), "-o", str(folder / "results/many"), "--quiet", "--no-reports"], check=True, stdout=subprocess.DEVNULL)
    page.go("cohort", "results%2Fmany")
    page.see(f"{count} of {count} specimens")
    times, drawn = asynchronous(page.browser, SCROLL, 2000)
    print(f"{count} specimens, scrolled through, {drawn} drawn on the way: {1000 / statistics.mean(times):.0f} frames a second")
    print(row("frame", times))
    arranged = asynchronous(page.browser, """const done = arguments[0], order = [...document.querySelectorAll('select')].at(-2), begun = performance.now();
      order.value = 'id';
      order.dispatchEvent(new Event('change'));
      requestAnimationFrame(() => setTimeout(() => done(performance.now() - begun)));""")
    print(f"  sorted by name in {arranged:.0f} ms", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tunica", default=str(SOURCE / "build/release/bin/tunica"))
    parser.add_argument("--moves", type=int, default=200)
    parser.add_argument("--specimens", type=int, default=500, help="of a cohort, which is fitted for it; 0: none")
    parser.add_argument("--profile", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = [make(folder) for make in (strips_and_tube, plate, many_rows)]
        with Studio(options.tunica, folder) as studio, Browser(folder, watched=False) as browser:
            browser.call("POST", browser.session + "/timeouts", {"script": 120000})
            page = Page(browser)
            browser.call("POST", browser.session + "/url", {"url": studio.address})
            page.see("Worked examples")
            for file in files:
                sliders(page, file, options.moves, options.profile)
            zoom(page, files[-1], options.moves, options.profile)
            if options.specimens:
                specimens(page, folder, options.tunica, options.specimens)
    return 0


if __name__ == "__main__":
    sys.exit(main())
