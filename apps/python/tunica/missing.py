# SPDX-License-Identifier: Apache-2.0
"""What to do where the package is there without its extension module."""
import pathlib
import sys
import sysconfig


def explained():
    """Which module is missing in the folder of the package, and how it gets there."""
    folder = pathlib.Path(__file__).absolute().parent
    wanted = f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"
    others = sorted(path.name for path in folder.glob("_core*.so"))
    found = f"found {', '.join(others)}, which are for other Pythons" if others else "it was not built"
    return (f"{folder / wanted}: expected the extension module for {sys.executable}; {found}. Build the target "
            f"tunica_python with this Python and install it again: cmake --preset release -D Python_EXECUTABLE="
            f"{sys.executable} && cmake --build build/release --target tunica_python. It needs pybind11-dev and the headers "
            "of that Python (python3-dev)")
