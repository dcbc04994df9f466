#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_commands.py TUNICA SOURCE: every command "tunica VERB …" that README or a page of docs mentions has a verb and
options that the program knows, and every name given to `tunica describe` exists."""
import pathlib
import re
import subprocess
import sys

tunica, source = sys.argv[1], pathlib.Path(sys.argv[2])
PLACEHOLDER = re.compile(r"[A-Z|]+$|my_|\.|[⟨⟩]")  # NAME, WHAT|…, files, and the plugins of tutorials
ACTIONS = {"plugin": ("new", "check"), "cohort": ("merge", "submit", "status", "resubmit")}  # verbs below verbs
helps, problems, count = {}, [], 0


def ask(*words):
    ended = subprocess.run([tunica, "--allow-world-writable-plugins", *words], capture_output=True, text=True, check=False)
    return ended.stdout if ended.returncode == 0 else None


def commands(text):
    """What stands in inline code, or in a line of a block, from the word tunica to its end."""
    fence = re.compile(r"^ *```(\w*)\n(.*?)^ *```", re.S | re.M)
    blocks = [block for language, block in fence.findall(text) if language in ("", "sh")]
    text = fence.sub("", text)
    lines = [line for block in blocks + re.findall(r"(?:^    .*\n)+", text, re.M) for line in block.splitlines()]
    for piece in re.findall(r"`([^`]+)`", text) + lines:
        for part in re.split(r"\||&&|<\(|;|#", piece):
            words = part.replace(")", " ").replace("…", " ").split()
            if words[:1] == ["tunica"] and len(words) > 1:
                yield words[1:]


known = ask("--help") or sys.exit(f"{tunica} --help failed")
names = set((ask("list", "--names") or sys.exit(f"{tunica} list --names failed")).split())
verbs = set(re.findall(r"^  (\w+) ", known.split("Subcommands:")[1], re.M))
for page in [source / "README.md", source / "CONTRIBUTING.md", *sorted((source / "docs").rglob("*.md"))]:
    for words in commands(page.read_text(encoding="utf-8")):
        place = f"{page.relative_to(source)}: tunica {' '.join(words)}"
        verb = next((word for word in words if word in verbs), None)
        if verb is None:
            if words[0] not in ("VERB", "--version", "--help", "0.1.0"):
                problems.append(f"{place}: no such verb; known: {', '.join(sorted(verbs))}")
            continue
        count += 1
        action = words[words.index(verb) + 1:][:1] if verb in ACTIONS else []
        key = (verb, *[word for word in action if word in ACTIONS[verb]])
        helps.setdefault(key, known + (ask(*key, "--help") or ""))
        for option in re.findall(r"(?<!\S)--?[a-z][\w-]*", " ".join(words)):
            if not re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", helps[key]):
                problems.append(f"{place}: {verb} has no option {option}")
        if verb == "describe":
            for name in words[words.index(verb) + 1:]:
                if not name.startswith("-") and not PLACEHOLDER.search(name) and name not in names:
                    problems.append(f"{place}: nothing is called {name}")
if count < 30:
    problems.append(f"found only {count} commands; expected more, see commands() in {sys.argv[0]}")
if problems:
    sys.exit("\n".join(problems))
print(f"{count} commands")
