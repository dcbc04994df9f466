# SPDX-License-Identifier: Apache-2.0
"""Stands before the compiler in the build of the mutants: launcher.py ROOT COPIES COMPILER ARGUMENTS...

A source with an instrumented copy below COPIES is compiled from the copy, alone or joined with others. Library
assertions are on there, as they are in the preset `dev`, so that an index outside is noticed."""
import os
import pathlib
import re
import shutil
import sys

INCLUDED = re.compile(r'^#include "(/[^"]+)"', re.M)


def copy_of(source, root, copies):
    """The instrumented copy of a source, or None."""
    if not source.is_relative_to(root):
        return None
    copy = copies / source.relative_to(root)
    return copy if copy.exists() else None


def replaced(source, root, copies):
    """(what to compile, the folders where its includes are), or None where nothing is instrumented."""
    if source.parent.name != "Unity":
        copy = copy_of(source, root, copies)
        return (copy, [source.parent]) if copy else None
    text, folders = source.read_text(), []
    for name in INCLUDED.findall(text):
        copy = copy_of(pathlib.Path(name), root, copies)
        if copy:
            text = text.replace(f'"{name}"', f'"{copy}"')
            folders.append(pathlib.Path(name).parent)
    if not folders:
        return None
    joined = source.with_suffix(".mutants.cxx")
    if not joined.exists() or joined.read_text() != text:
        joined.write_text(text)
    return joined, folders


def main():
    root, copies, command = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:]
    place = next((k for k, word in enumerate(command) if k and command[k - 1] == "-c"), None)
    found = replaced(pathlib.Path(command[place]), root, copies) if place else None
    if found:
        command[place] = str(found[0])
        runtime = pathlib.Path(__file__).with_name("runtime.hpp")
        command += ["-w", "-O1", "-D_GLIBCXX_ASSERTIONS", "-include", str(runtime)]
        for folder in dict.fromkeys(found[1]):
            command += ["-iquote", str(folder)]
    if shutil.which("ccache"):
        command.insert(0, "ccache")
        os.environ.setdefault("CCACHE_BASEDIR", str(root))
        os.environ["CCACHE_NOHASHDIR"] = "true"
        os.environ["CCACHE_SLOPPINESS"] = "pch_defines,time_macros"
    os.execvp(command[0], command)


if __name__ == "__main__":
    main()
