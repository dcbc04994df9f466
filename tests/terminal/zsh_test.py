#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""zsh_test.py TUNICA FOLDER: zsh takes the completion in FOLDER and completes what is typed, on a terminal."""
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing is left beside the sources
from screen import Screen, need

tunica, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
need("zsh", "zsh")
subprocess.run(["zsh", "-n", folder / "_tunica"], check=True)
need("tmux", "tmux")

# What is typed before the Tab, and what the line is after it.
CASES = [
    ("tunica desc", "tunica describe"),
    ("tunica --allow-world-writable-plugins describe unia", "describe uniaxial"),
    ("tunica run exp", "tunica run experiment.json"),
    ("tunica run experiment.json --boo", "tunica run experiment.json --bootstrap"),
    ("tunica run experiment.json -o res", "tunica run experiment.json -o results/"),
    ("tunica report res", "tunica report results/"),
    ("tunica list mech", "tunica list mechanisms"),
    ("tunica completion z", "tunica completion zsh"),
    ("tunica --allow-world-writable-plugins diagnose experiment.json --mechanisms force_offset,chain", "force_offset,chain_extensibility"),
]
with tempfile.TemporaryDirectory() as work:
    (pathlib.Path(work) / "results").mkdir()
    (pathlib.Path(work) / "experiment.json").touch()
    (pathlib.Path(work) / "strip.csv").touch()
    with Screen(["zsh", "-f"], work, environment={"HOME": work}) as screen:
        screen.enter(f"bindkey -e; PS1='> '; PATH={tunica.parent}:$PATH; fpath=({folder} $fpath); autoload -U compinit; compinit -u -D; print ready | tr a-z A-Z")
        screen.wait_for(lambda text: "READY" in text, "the prompt")
        for typed, completed in CASES:
            # Keys of the line editor, which come in order; an interrupt may be handled after the next key and swallow it.
            screen.press("C-u", "C-l")
            screen.wait_for(lambda text: text.strip() == ">", "an empty screen")
            screen.type(typed)
            screen.press("Tab")
            # Long lines go on in the next row of the screen.
            screen.wait_for(lambda text: completed in text.replace("\n", ""), f"'{completed}' after '{typed}<Tab>'", 20)
print(f"zsh completed {len(CASES)} command lines")
