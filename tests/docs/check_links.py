#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_links.py TUNICA SOURCE_DIR: every link of README and docs leads to a file, every anchor to a heading; each claim
of docs/capabilities.md links what proves it; and that page names exactly the models, tests, mechanisms and optimisers
there are."""
import json
import pathlib
import re
import subprocess
import sys

tunica, source = sys.argv[1], pathlib.Path(sys.argv[2])
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)", re.S)
problems = []


def without_code(text):
    return re.sub(r"```.*?```", "", text, flags=re.S)


def anchors(page):
    """As GitHub makes them of the headings."""
    found = re.findall(r"^#+ (.+)$", without_code(page.read_text(encoding="utf-8")), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in found}


pages = [source / "README.md", source / "CONTRIBUTING.md", *sorted((source / "docs").glob("*.md"))]
links = 0
for page in pages:
    for link in LINK.findall(without_code(page.read_text(encoding="utf-8"))):
        if re.match(r"[a-z]+:", link):
            continue
        links += 1
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            problems.append(f"{page.name}: {link} does not exist")
        elif anchor and anchor not in anchors(target):
            problems.append(f"{page.name}: {link} names no heading of {target.name}")
assert links > 30, f"found only {links} links"

readme = (source / "README.md").read_text(encoding="utf-8")
first_screen = readme[:readme.index("## ")]
if readme.count("\n") > 75:
    problems.append(f"the README has {readme.count(chr(10))} lines; one screen was promised, the rest belongs into docs")
for wanted, count in (("![", 1), ("```json", 1), ("./bootstrap ", 2)):
    if first_screen.count(wanted) != count:
        problems.append(f"the first screen of the README has {first_screen.count(wanted)} of '{wanted}', expected {count}")
if first_screen.count("\n") > 45:
    problems.append(f"the first screen of the README has {first_screen.count(chr(10))} lines")

capabilities = (source / "docs/capabilities.md").read_text(encoding="utf-8")
claims = capabilities.split("## What it can do that others cannot\n")[1].split("\n## ")[0]
bullets = re.findall(r"^- .*(?:\n  .*)*", claims, re.M)
assert len(bullets) >= 8, f"found only {len(bullets)} claims"
for bullet in bullets:
    proofs = [link for link in LINK.findall(bullet) if re.match(r"(?:\.\./(?:tests|examples|bench)|figures|images)/", link)]
    if not proofs:
        problems.append(f"no test, example, bench or figure stands behind: {bullet[:70]}")

listed = json.loads(subprocess.run([tunica, "--allow-world-writable-plugins", "list", "--json"],
                                   capture_output=True, text=True, check=True).stdout)
names = {one["name"] for shelf in ("models", "tests", "optimizers", "mechanisms") for one in listed[shelf]}
inside = capabilities.split("## Models, tests, mechanisms, optimisers\n")[1].split("\n## ")[0]
written = set(re.findall(r"`([a-z0-9_]+)`", inside))
if missing := names - written:
    problems.append(f"docs/capabilities.md does not name {', '.join(sorted(missing))}")
if unknown := written - names:
    problems.append(f"docs/capabilities.md names {', '.join(sorted(unknown))}, and no plugin provides that")

print(f"{links} links in {len(pages)} pages, {len(bullets)} claims, {len(names)} names")
if problems:
    sys.exit("\n".join(problems))
