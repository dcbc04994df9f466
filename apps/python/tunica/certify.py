# SPDX-License-Identifier: Apache-2.0
"""python3 -m tunica.certify FOLDER POINTS MODULE...: evaluates the best points of a run in a process of its own, which
knows of the run what is in the folder, and of definitions those of the modules."""
import importlib
import sys

from tunica.verbs import certify


def main(folder, points, *modules):
    for module in modules:
        importlib.import_module(module)
    sys.stdout.write(certify(folder, points))


if __name__ == "__main__":
    main(*sys.argv[1:])
