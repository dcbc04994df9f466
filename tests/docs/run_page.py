#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run_page.py TUNICA SOURCE PAGE [--update] [--keep FOLDER]: does what a page tells its reader to do, in a new folder.

A block after "<!-- file: NAME -->" is written to NAME. Blocks of sh are run one after the other, and a command that ends
with another code than 0 (or that of "<!-- exit code: N -->") is an error. A block after "<!-- shows: FROM .. TO -->" has to
be what the last block of sh printed, from the first line that begins with FROM to the one before the next that begins with
TO; pieces are joined by ";". Measured seconds may differ. --update writes what was printed into the page, --keep leaves
the folder for the pictures."""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"((?:<!-- [^\n]* -->\n)?)```(\w*)\n(.*?)```", re.S)


def pieces(wanted, printed):
    """The lines of `printed` that "FROM .. TO; FROM .. TO" selects, joined by "…"."""
    lines, found, at = printed.splitlines(), [], 0
    for piece in wanted.split("; "):
        begin, _, end = (part.strip() for part in piece.partition(".."))
        first = next((i for i in range(at, len(lines)) if lines[i].lstrip().startswith(begin)), None)
        if first is None:
            sys.exit(f"no line begins with '{begin}' in what was printed:\n{printed}")
        at = next((i for i in range(first + 1, len(lines)) if end and lines[i].lstrip().startswith(end)), len(lines))
        found.append("\n".join(lines[first:at]).rstrip())
    return "\n…\n".join(found) + "\n"


def without_seconds(text):
    """Rows of the ranking have the seconds of a run, and behind them perhaps failures, χ²/ν and ΔAICc."""
    return re.sub(r"(?m)^( *\d* +\S.*?) +\d+\.\d{3}((?: +\S+){0,3})$", r"\1\2", re.sub(r"[ \t]+$", "", text, flags=re.M))


def run(commands, folder, tools):
    """Exit code, what was printed, and the folder in which the commands ended."""
    where = tools / "where"
    script = f'export PATH="{tools}:$PATH" LC_ALL=C.UTF-8\ntrap \'pwd > "{where}"\' EXIT\nset -e\n{commands}'
    ended = subprocess.run(["bash", "-c", script], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           encoding="utf-8", check=False)
    return ended.returncode, ended.stdout, pathlib.Path(where.read_text(encoding="utf-8").strip())


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("tunica", type=pathlib.Path)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path)
    given = parser.parse_args()
    text = given.page.read_text(encoding="utf-8")
    home = pathlib.Path(tempfile.mkdtemp())
    tools = home / "tools"
    tools.mkdir()
    (tools / "tunica").write_text(f'#!/bin/sh\nexec "{given.tunica.resolve()}" --allow-world-writable-plugins "$@"\n')
    (tools / "tunica").chmod(0o755)
    clone = home / "clone"
    clone.mkdir()
    (clone / "examples").symlink_to((given.source / "examples").resolve())
    folder, printed, count, differ = clone, "", {"sh": 0, "file": 0, "shows": 0}, []

    def one(block):
        nonlocal folder, printed
        mark, language, body = block.groups()
        if name := re.match(r"<!-- file: (\S+) -->", mark):
            (folder / name[1]).write_text(body, encoding="utf-8")
            count["file"] += 1
        elif shown := re.match(r"<!-- shows: (.*) -->", mark):
            count["shows"] += 1
            actual = pieces(shown[1], printed)
            if without_seconds(actual) != without_seconds(body):
                differ.append(f"the page shows\n{body}and tunica printed\n{actual}")
                return f"{mark}```{language}\n{actual}```"
        elif language == "sh":
            wanted = re.match(r"<!-- exit code: (\d+) -->", mark)
            code, printed, folder = run(body, folder, tools)
            count["sh"] += 1
            if code != (int(wanted[1]) if wanted else 0):
                sys.exit(f"{given.page.name}: exit code {code} of\n{body}{printed}")
        return block[0]

    changed = BLOCK.sub(one, text)
    if given.keep:
        shutil.copytree(folder, given.keep, dirs_exist_ok=True)
    shutil.rmtree(home)
    if given.update:
        given.page.write_text(changed, encoding="utf-8")
    elif differ:
        sys.exit("\n".join(differ) + f"\n{sys.argv[0]} … --update writes what is printed into {given.page}")
    if not count["sh"]:
        sys.exit(f"{given.page.name} has no block of sh; expected the commands of a reader")
    print(f"{given.page.name}: {count['sh']} blocks of commands, {count['file']} files, {count['shows']} outputs")


main()
