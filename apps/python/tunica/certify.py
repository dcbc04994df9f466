# SPDX-License-Identifier: Apache-2.0
"""python3 -m tunica.certify FOLDER POINTS MODULE...: evaluates the best points of a run in a process of its own, which
knows of the run what is in the folder, and of definitions those of the modules."""
import importlib
import os
import sys

from tunica.verbs import certify


def main(folder, points, *modules):
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as answer:
        os.dup2(2, 1)  # what plugins and modules print is not the answer
        for module in modules:
            importlib.import_module(module)
        answer.write(certify(folder, points))


if __name__ == "__main__":
    main(*sys.argv[1:])
