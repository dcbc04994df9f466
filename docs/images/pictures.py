#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""pictures.py TUNICA: makes the pictures of the pages again.

Runs docs/getting-started.md, examples/plate, a diagnosis of examples/hidden_effect and the walk of the studio with TUNICA, opens the reports in headless Chromium,
and reduces each picture to 64 colours with ImageMagick (Debian: chromium, imagemagick)."""
import pathlib
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
source = here.parent.parent
# Folder of the run, name of the picture, height in pixels (the width is 1000).
PICTURES = [("first", "getting-started-run.png", 1230), ("why", "getting-started-diagnosis.png", 1380),
            ("third", "getting-started-prediction.png", 1340), ("hidden", "diagnosis.png", 1270),
            ("plate", "full-field.png", 1650)]

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, source / "tests/docs/run_page.py", sys.argv[1], source, here.parent / "getting-started.md",
                    "--update", "--keep", folder], check=True)
    subprocess.run([sys.argv[1], "--allow-world-writable-plugins", "diagnose", source / "examples/hidden_effect/experiment.json",
                    "-o", pathlib.Path(folder) / "hidden", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([sys.argv[1], "--allow-world-writable-plugins", "run", source / "examples/plate/experiment.json",
                    "-o", pathlib.Path(folder) / "plate", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    for run, name, height in PICTURES:
        report = pathlib.Path(folder) / run / "report.html"
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                        "--virtual-time-budget=8000", f"--window-size=1000,{height}", f"--screenshot={here / name}",
                        report.as_uri()], check=True, stderr=subprocess.DEVNULL)
        subprocess.run(["convert", here / name, "-colors", "64", "-define", "png:compression-level=9", here / name], check=True)
        print(here / name)
    subprocess.run([sys.executable, source / "tests/browser/studio_walk.py", "--tunica", sys.argv[1], "--source", source, "--output",
                    pathlib.Path(folder) / "studio", "--pictures"], check=True)
    for name in ("data", "material", "fit", "mistake"):
        picture = here / f"studio-{name}.png"
        subprocess.run(["convert", pathlib.Path(folder) / f"studio/pictures/{name}.png", "-colors", "64", "-define", "png:compression-level=9",
                        picture], check=True)
        print(picture)
