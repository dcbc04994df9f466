# SPDX-License-Identifier: Apache-2.0
"""python3 -m tunica.certify FOLDER POINTS: evaluates the best points of a run in a process of its own."""
import sys

from tunica.verbs import certify

if __name__ == "__main__":
    sys.stdout.write(certify(*sys.argv[1:]))
