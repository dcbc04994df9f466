#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""interface_abi_test.py LIBRARY HEADER RECORD [--write]: a change of the binary interface needs a new plugin API number.

LIBRARY is interface_abi.cpp with the debug information of every class; abidw (Debian: abigail-tools) writes down what is
in it. RECORD holds the number, and of each class and enum of tunica its size, its members with their offsets in bits, and
its virtual functions with their places in the table. Unlike interface_test.py it sees what a type elsewhere does to
these, and does not mind code that changes nothing."""
import difflib
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

library, header, record = map(pathlib.Path, sys.argv[1:4])


def written_down():
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "interface.abi"
        subprocess.run(["abidw", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", "--out-file", file, library],
                       check=True)
        return xml.etree.ElementTree.parse(file).getroot()


def type_names(root):
    """Identifier -> name of a type, as far as it has one of its own."""
    marks = {"pointer-type-def": "*", "reference-type-def": "&"}
    plain = {one.get("id"): one for one in root.iter() if one.get("id")}

    def name(identifier, depth=0):
        one = plain.get(identifier)
        if one is None or depth > 8:
            return "?"
        if one.tag in marks:
            return name(one.get("type-id"), depth + 1) + marks[one.tag]
        if one.tag == "qualified-type-def":
            return ("const " if one.get("const") else "") + name(one.get("type-id"), depth + 1)
        return one.get("name") or one.tag
    return name


def lines_of(scope, name, path=""):
    """What a class, an enum or a namespace of tunica is."""
    for one in scope:
        inner = one
        if one.tag == "member-type":
            inner = one[0]
        if inner.tag not in ("class-decl", "enum-decl", "namespace-decl"):
            continue
        title = f"{path}{inner.get('name')}"
        if inner.tag == "enum-decl":
            yield f"enum {title}: " + ", ".join(f"{v.get('name')}={v.get('value')}" for v in inner.iter("enumerator"))
        if inner.tag == "class-decl" and not inner.get("is-declaration-only"):
            yield f"class {title}: {inner.get('size-in-bits')} bits"
            for base in inner.findall("base-class"):
                yield f"class {title} < {name(base.get('type-id'))} at {base.get('layout-offset-in-bits')}"
            for member in inner.findall("data-member"):
                if member.get("static") != "yes":
                    variable = member.find("var-decl")
                    yield (f"class {title}: {variable.get('name')} at {member.get('layout-offset-in-bits')}: "
                           f"{name(variable.get('type-id'))}")
            for member in inner.findall("member-function"):
                if member.get("vtable-offset", "-1") != "-1":
                    yield (f"class {title}: virtual {member.get('vtable-offset')} "
                           f"{member.find('function-decl').get('mangled-name') or 'destructor'}")
        yield from lines_of(inner, name, title + "::")


def found_lines():
    root = written_down()
    name, found = type_names(root), set()
    for unit in root.iter("abi-instr"):
        for space in unit.findall("namespace-decl"):
            if space.get("name") == "tunica":
                found |= set(lines_of(space, name))
    return sorted(line for line in found if not line.startswith("class Boundary"))


if shutil.which("abidw") is None:
    print("abidw is not here: install the Debian package abigail-tools")
    sys.exit(77)
number = re.search(r"#define TUNICA_PLUGIN_API (\d+)", header.read_text(encoding="utf-8"))[1]
found = [f"api {number}", *found_lines()]
if len(found) < 50:
    sys.exit(f"only {len(found)} lines: abidw does not see the classes of the interface")
if "--write" in sys.argv:
    record.write_text("\n".join(found) + "\n", encoding="utf-8")
    sys.exit()
known = record.read_text(encoding="utf-8").splitlines()
again = f"{sys.argv[0]} {library} {header} {record} --write"
if known[1:] != found[1:] and known[0] == found[0]:
    print("\n".join(difflib.unified_diff(known, found, "recorded", "found", lineterm="", n=0)))
    sys.exit(f"the binary interface has changed, and TUNICA_PLUGIN_API is still {number}: raise it by one in "
             f"tunica/plugin.hpp, then record it: {again}")
if known != found:
    sys.exit(f"TUNICA_PLUGIN_API is {number}, recorded is '{known[0]}'; record it: {again}")
