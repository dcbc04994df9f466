# SPDX-License-Identifier: Apache-2.0
"""The instrumented build: finds the mutants of every source in parallel, writes the copies and compiles them."""
import dataclasses
import hashlib
import json
import multiprocessing
import pathlib
import subprocess
import sys

from . import schemata, units
from .finding import Finder, Place

HERE = pathlib.Path(__file__).resolve().parent
# Flags of libclang that its Python does not name: the headers are read once, and without the bodies of their functions.
FIRST_PREAMBLE, ONLY_OF_HEADERS = 0x100, 0x800


def configure(root, build):
    """The preset release in a folder of its own, with the launcher that compiles the copies."""
    launcher = f"{sys.executable};{HERE / 'launcher.py'};{root};{build / 'mutation/copies'}"
    command = ["cmake", "--preset", "release", "-B", str(build), "-DTUNICA_BUILD_BENCH=OFF",
               f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}"]
    subprocess.run(command, cwd=root, check=True, stdout=subprocess.DEVNULL)


def errors(unit, path, known=()):
    """(sentence, offset in the source, or None elsewhere) of the errors that are not known."""
    return [(one.spelling, one.location.offset if one.location.file and one.location.file.name == str(path) else None)
            for one in unit.diagnostics if one.severity >= 3 and one.spelling not in known]


def find(job):
    """(name, source, options) -> the places whose instrumented copy compiles, and the copy. Runs in a process of its own.

    A place that does not compile, say a bound that has to be constant, is left out, and the copy is tried once more."""
    from clang.cindex import Index, TranslationUnit, TranslationUnitLoadError
    name, path, options = job
    text = path.read_bytes()
    options = options + ["-include", str(HERE / "runtime.hpp"), "-w", "-ferror-limit=0"]
    reading = (TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD | TranslationUnit.PARSE_PRECOMPILED_PREAMBLE | FIRST_PREAMBLE |
               TranslationUnit.PARSE_SKIP_FUNCTION_BODIES | ONLY_OF_HEADERS)
    try:
        unit = Index.create().parse(str(path), args=options, options=reading)
    except TranslationUnitLoadError:  # a header changed while it was read
        return name, [], b"", "cannot be read now"
    known = {sentence for sentence, _ in errors(unit, path)}  # clang 14 lacks a few things that g++ has; what it cannot read has no mutants
    places, left_out = Finder(unit, path).places, 0
    for _ in range(12):
        copy = schemata.instrumented(text, schemata.numbered(name, places))
        unit.reparse([(str(path), copy.decode())])
        wrong = errors(unit, path, known)
        if not wrong:
            return name, places, copy, f"{left_out} places do not compile and are left out" if left_out else ""
        faulty = schemata.around(places, name, text, [offset for _, offset in wrong if offset is not None])
        if not faulty:
            break
        left_out += len(faulty)
        places = [place for place in places if place not in faulty]
    return name, [], b"", f"no copy compiles: {sorted(wrong)[:2]}"


def remembered(file):
    return json.loads(file.read_text()) if file.exists() else {}


def prepare(root, build, folders, jobs):
    """Instruments what is new or has changed; returns name -> {"hash", "places"} for the sources of the folders."""
    state, copies = build / "mutation", build / "mutation/copies"
    copies.mkdir(parents=True, exist_ok=True)
    tool = b"".join((HERE / name).read_bytes() for name in ("finding.py", "schemata.py"))
    known, work, digests, found = remembered(state / "places.json"), [], {}, {}
    sources = units.wanted(build, root, folders)
    for source, unit in sorted(sources.items()):
        name = str(source.relative_to(root))
        digest = hashlib.sha256(tool + source.read_bytes()).hexdigest()
        if known.get(name, {}).get("hash") == digest:
            found[name] = known[name]
        else:
            work.append((name, source, unit.options))
            digests[name] = digest
    with multiprocessing.Pool(jobs) as pool:
        for done, (name, places, copy, remark) in enumerate(pool.imap_unordered(find, work), 1):
            found[name] = {"hash": digests[name], "places": [dataclasses.asdict(place) for place in places]}
            known.pop(name, None)
            if places or not remark:  # else it is tried again
                known[name] = found[name]
            target = copies / name
            target.parent.mkdir(parents=True, exist_ok=True)
            if places:
                target.write_bytes(copy)
            else:
                target.unlink(missing_ok=True)
            sources[root / name].output.unlink(missing_ok=True)  # compiled again, from the copy
            (state / "places.json").write_text(json.dumps(known))
            print(f"  [{done}/{len(work)}] {name}: {sum(len(place.mutants) for place in places)} mutants"
                  f"{'; ' + remark if remark else ''}", flush=True)
    (state / "places.json").write_text(json.dumps(known))
    return found


def mutants(root, found):
    """All mutants: number, file, line, what is changed and the text it stands in."""
    listed = []
    for name, entry in sorted(found.items()):
        text = (root / name).read_bytes()
        lines = text.decode().split("\n")
        places = [Place(**{**place, "operator": tuple(place["operator"])}) for place in entry["places"]]
        for first, place in schemata.numbered(name, places):
            line = text.count(b"\n", 0, place.operator[0] if place.operator else place.begin) + 1
            for k, words in enumerate(place.mutants):
                listed.append({"number": first + k, "file": name, "hash": entry["hash"], "line": line, "mutant": words,
                               "source": " ".join(lines[line - 1].split()),
                               "text": " ".join(text[place.begin:place.end].decode().split())[:100]})
    return listed


def compile(build, targets):
    """Compiles the program with its plugins, and the tests."""
    subprocess.run(["cmake", "--build", str(build), "--target", "product", *targets], check=True,
                   stdout=subprocess.DEVNULL)
