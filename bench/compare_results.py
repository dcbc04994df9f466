#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compare result.json of two builds: every number must be the same to its last bit.

    bench/compare_results.py OLD NEW                 two result.json, or two folders with result.json anywhere below them
    bench/compare_results.py OLD NEW --within 1e-10  floating-point numbers may differ by so much, relatively

Numbers, true, false and null are compared at the same JSON path; lists and objects must have the same size. Sentences may
change, and so may short codes such as "named"; both are listed. Keys that NEW adds are listed as well. Left out are clock
times and what describes the program rather than its results (LEFT_OUT).
Exit code 1: a number differs, a key or a whole result is missing. Exit code 2: there is nothing to compare."""
import argparse
import json
import pathlib
import re
import sys

# Clock times, and the program that ran: versions, hashes of its input files, threads.
LEFT_OUT = {"seconds", "seconds_spent", "date", "tunica", "plugins", "compiler", "libraries", "vector_level", "input_sha256", "data",
            "threads"}
CODE = re.compile(r"[\w./#+-]+")  # a string without blanks is a code, a name or a unit


def bits(value):
    """Equal for two numbers exactly if they are equal to the last bit; the sign of zero counts."""
    return float(value).hex()


class Comparison:
    def __init__(self, within=0.0):
        self.within, self.largest = within, 0.0
        self.numbers, self.missing, self.added, self.codes, self.sentences = [], [], [], [], []
        self.compared = 0

    def see(self, path, old, new):
        if isinstance(old, dict) and isinstance(new, dict):
            self.see_objects(path, old, new)
        elif isinstance(old, list) and isinstance(new, list):
            self.see_lists(path, old, new)
        elif isinstance(old, str) and isinstance(new, str):
            if old != new:
                (self.codes if CODE.fullmatch(old) and CODE.fullmatch(new) else self.sentences).append((path, old, new))
        else:
            self.see_values(path, old, new)

    def see_objects(self, path, old, new):
        for key in old:
            if key in LEFT_OUT:
                continue
            if key in new:
                self.see(f"{path}.{key}", old[key], new[key])
            else:
                self.missing.append((f"{path}.{key}", old[key], "missing"))
        self.added += [(f"{path}.{key}", "new", new[key]) for key in new if key not in old and key not in LEFT_OUT]

    def see_lists(self, path, old, new):
        if len(old) != len(new) and all(isinstance(one, str) for one in old + new):
            (self.codes if all(CODE.fullmatch(one) for one in old + new) else self.sentences).append((path, old, new))
            return
        if len(old) != len(new):
            self.missing.append((path, f"{len(old)} entries", f"{len(new)} entries"))
        for k, (a, b) in enumerate(zip(old, new)):
            self.see(f"{path}[{k}]", a, b)

    def see_values(self, path, old, new):
        self.compared += 1
        plain = (bool, type(None))
        if isinstance(old, plain) or isinstance(new, plain):
            same = old is new
        elif isinstance(old, (int, float)) and isinstance(new, (int, float)):
            same = bits(old) == bits(new) or self.close(old, new)
        else:
            same = False
        if not same:
            self.numbers.append((path, old, new))

    def close(self, old, new):
        """Within the tolerance; counts must be equal all the same."""
        if self.within == 0 or not (isinstance(old, float) and isinstance(new, float)):
            return False
        if old == new:  # 0.0 and -0.0
            return True
        change = abs(new - old) / max(abs(old), abs(new))
        if change <= self.within:
            self.largest = max(self.largest, change)
        return change <= self.within


def results(place):
    """Path below the folder -> result.json."""
    if place.is_file():
        return {"": place}
    return {str(file.parent.relative_to(place)): file for file in sorted(place.rglob("result.json"))}


def show(title, found, most):
    if not found:
        return
    print(f"{title}: {len(found)}")
    for path, old, new in found[:most]:
        print(f"  {path}\n    old {short(old)}\n    new {short(new)}")
    if len(found) > most:
        print(f"  … and {len(found) - most} more (--most)")


def short(value):
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 240 else text[:240] + " …"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("--within", type=float, default=0.0, metavar="R", help="relative difference that is let pass (default: 0)")
    parser.add_argument("--most", type=int, default=20, help="entries shown of each kind (default: 20)")
    parser.add_argument("--quiet", action="store_true", help="neither changed sentences nor new keys")
    parser.add_argument("--finished", action="store_true", help="only results that NEW has, for a run that still goes on")
    options = parser.parse_args()
    old, new = results(options.old), results(options.new)
    if options.finished:
        old = {name: file for name, file in old.items() if name in new}
    if not old:
        print(f"{options.old}: no result.json to compare with {options.new}", file=sys.stderr)
        return 2
    seen = Comparison(options.within)
    for name, file in old.items():
        if name not in new:
            seen.missing.append((name or str(file), "result.json", "missing"))
            continue
        seen.see(name or "result", json.loads(file.read_text("utf-8")), json.loads(new[name].read_text("utf-8")))
    seen.added += [(name, "new", "result.json") for name in new if name not in old]
    if not options.quiet:
        show("changed sentences", seen.sentences, options.most)
        show("new keys", seen.added, options.most)
    show("changed codes", seen.codes, options.most)
    show("MISSING", seen.missing, options.most)
    show("DIFFERENT NUMBERS", seen.numbers, options.most)
    print(f"{len(old)} results, {seen.compared} numbers compared: {len(seen.numbers)} differ, {len(seen.missing)} keys are "
          f"missing; {len(seen.codes)} codes and {len(seen.sentences)} sentences changed, {len(seen.added)} keys are new")
    if options.within:
        print(f"the largest relative difference that was let pass is {seen.largest:.2g}")
    return 1 if seen.numbers or seen.missing else 0


if __name__ == "__main__":
    sys.exit(main())
