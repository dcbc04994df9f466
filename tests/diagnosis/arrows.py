#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""arrows.py FOLDER: in core/src/diagnosis, a room includes itself and the rooms before it, and no others.

The order of the rooms is the order of a diagnosis. Files beside the rooms are the first of them (result, request), or
see all of them (diagnosis), but only output may include those. Prints every arrow that climbs and ends with 1."""
import pathlib
import re
import sys

ROOMS = ["result", "request", "evidence", "hypotheses", "detection", "naming", "file", "prospects", "diagnosis", "output"]
INCLUDE = re.compile(r'^#include "diagnosis/([^"]+)"', re.M)


def room_of(path):
    """The room of a file, by its path inside the folder."""
    first = pathlib.PurePath(path).parts[0]
    return pathlib.PurePath(first).stem


def climbing(folder):
    """(file, include) for every arrow to a later room, and for files and includes that are in no room."""
    for file in sorted(folder.rglob("*.[ch]pp")):
        own = file.relative_to(folder).as_posix()
        for included in INCLUDE.findall(file.read_text(encoding="utf-8")):
            rooms = [room_of(own), room_of(included)]
            if not all(room in ROOMS for room in rooms) or ROOMS.index(rooms[1]) > ROOMS.index(rooms[0]):
                yield own, included


def main():
    found = list(climbing(pathlib.Path(sys.argv[1])))
    for own, included in found:
        print(f"{own} includes {included}; the order is {' < '.join(ROOMS)}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
