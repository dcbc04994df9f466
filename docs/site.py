#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The pages as a web site with search: docs/site.py [OUT], by MkDocs (Debian: mkdocs). OUT is build/site unless given.

Pages lie in the site as they do here, so that their links go on to work. Files that a page links are taken along, and a
folder that it links becomes a list of its files. A link that leads nowhere is an error.
"""
import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^)\s#]+)[^)]*\)")
#: Where readers begin, in the order of the menu; all other pages are below "More".
MENU = {
    "Start": ["README.md", "docs/getting-started.md", "docs/faq.md", "docs/glossary.md", "docs/capabilities.md"],
    "Asking": ["docs/experiment-file.md", "docs/experiment-reference.md", "docs/command-line.md", "docs/python.md", "docs/rig-layouts.md", "docs/full-field.md"],
    "Models and solvers": ["docs/theory.md", "docs/composed.md", "docs/optimizers.md", "docs/solvers.md"],
    "Answers": ["docs/results.md", "docs/results-reference.md", "docs/diagnosis.md", "docs/discovery.md", "docs/export.md",
                "docs/errors.md"],
    "Many specimens": ["docs/cohort.md", "docs/cohort_statistics.md", "docs/cohort_diagnosis.md", "docs/cohort_cluster.md"],
    "Extending it": ["docs/plugin-guide.md", "docs/plugin-check.md", "docs/sdk.md", "docs/architecture.md", "CONTRIBUTING.md",
                     "docs/migration.md", "CHANGELOG.md"],
}
#: The theme keeps the cells of a table on one line; sentences have to wrap.
STYLE = ".wy-table-responsive table td, .wy-table-responsive table th { white-space: normal }\n"


def listing(folder):
    """A page with the files of a folder that has none of its own."""
    entries = sorted(path for path in folder.iterdir() if not path.name.startswith((".", "__")))
    lines = [f"- [{html.escape(path.name)}]({path.name}{'/' if path.is_dir() else ''})" for path in entries if path.is_file()]
    return f"# {folder.relative_to(ROOT)}\n\n" + "\n".join(lines) + "\n", [path for path in entries if path.is_file()]


def page_of(folder):
    """The page that a link to a folder leads to."""
    return folder / ("README.md" if (folder / "README.md").exists() else "index.md")


def linked(page, target):
    """The file or folder that a link of a page names; None for addresses and for what is not there."""
    if re.match(r"[a-z]+:", target):
        return None
    path = (page.parent / target).resolve()
    return path if path.exists() and path.is_relative_to(ROOT) else None


def place(path):
    """Where a file lies in the site. MkDocs leaves out what begins with a dot."""
    return pathlib.Path(*(part.lstrip(".") for part in path.relative_to(ROOT).parts))


def put(path, text, stage):
    file = stage / place(path)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8") if text is not None else shutil.copyfile(path, file)


def collect(stage):
    """Copies every page, and what they link, into the stage; returns the pages."""
    waiting = [ROOT / name for names in MENU.values() for name in names] + sorted((ROOT / "docs").rglob("*.md"))
    pages = set()
    while waiting:
        path = waiting.pop()
        if path in pages:
            continue
        pages.add(path)
        if path.suffix != ".md":
            put(path, None, stage)
            continue
        if path.exists():
            text = path.read_text(encoding="utf-8")
        else:
            text, files = listing(path.parent)
            waiting += files
        targets = {target: linked(path, target) for target in LINK.findall(text)}
        waiting += [page_of(target) if target.is_dir() else target for target in targets.values() if target]
        # A link to a folder has to name its page, and one to a hidden file the place that it has here.
        for target, found in targets.items():
            leads_to = found and place(page_of(found) if found.is_dir() else found)
            if found and leads_to != found.relative_to(ROOT):
                text = re.sub(rf"\]\({re.escape(target)}(?=[)#\s])",
                              f"]({os.path.relpath(leads_to, path.relative_to(ROOT).parent)}", text)
        put(path, text, stage)
    return sorted(str(place(path)) for path in pages if path.suffix == ".md")


def main():
    out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/site").resolve()
    stage = out.parent / f"{out.name}-pages"
    shutil.rmtree(stage, ignore_errors=True)
    pages = collect(stage)
    (stage / "site.css").write_text(STYLE)
    shown = {name for names in MENU.values() for name in names}
    menu = [{title: names} for title, names in MENU.items()] + [{"More": [name for name in pages if name not in shown]}]
    version = re.search(r"project\(tunica VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    configuration = {"site_name": f"tunica {version}", "docs_dir": str(stage), "site_dir": str(out), "nav": menu,
                     "theme": {"name": "readthedocs", "highlightjs": False}, "plugins": ["search"], "extra_css": ["site.css"],
                     "use_directory_urls": False, "markdown_extensions": ["sane_lists"]}
    file = out.parent / f"{out.name}.yml"
    file.write_text(json.dumps(configuration, indent=2))  # JSON is YAML
    status = subprocess.run(["mkdocs", "build", "--quiet", "--strict", "--clean", "-f", str(file)]).returncode
    if status:
        sys.exit(status)
    print(out / "index.html")


main()
