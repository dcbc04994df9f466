# SPDX-License-Identifier: Apache-2.0
"""The backend of pyproject.toml (PEP 517): one wheel with the extension module and the plugins inside, built by CMake.

It needs what ./bootstrap installs, and nothing from PyPI: Debian 12 has no scikit-build-core. A first build takes as long
as that of the program; the folder build/wheel is kept, so that the next one is quick.
"""
import base64
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = ROOT / "build/wheel"
DEFINED = {"CMAKE_BUILD_TYPE": "Release", "CMAKE_UNITY_BUILD": "ON", "CMAKE_UNITY_BUILD_BATCH_SIZE": "40",
           "TUNICA_PRECOMPILED_HEADERS": "ON", "TUNICA_BUILD_TESTS": "OFF", "TUNICA_BUILD_BENCH": "OFF",
           # The package with its plugins inside, which apps/python/_installation.py.in names.
           "TUNICA_PYTHON_INSTALL_DIR": ".", "CMAKE_INSTALL_LIBDIR": "tunica", "Python_EXECUTABLE": sys.executable}


def version():
    return re.search(r"project\(tunica VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def metadata():
    return (f"Metadata-Version: 2.1\nName: tunica\nVersion: {version()}\n"
            "Summary: Material parameters from mechanical tests of soft tissue and rubber\nLicense: Apache-2.0\n"
            "Requires-Python: >=3.9\nRequires-Dist: numpy (>=1.22)\nRequires-Dist: pandas; extra == 'frames'\n"
            "Provides-Extra: frames\nDescription-Content-Type: text/markdown\n\n"
            + (ROOT / "README.md").read_text(encoding="utf-8"))


def cmake(*words):
    subprocess.run(["cmake", *map(str, words)], check=True)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    cmake("-S", ROOT, "-B", BUILD, "-G", "Ninja", *(f"-D{name}={value}" for name, value in DEFINED.items()))
    cmake("--build", BUILD, "--target", "product", "tunica_python")
    stage = BUILD / "stage"
    shutil.rmtree(stage, ignore_errors=True)
    for component in ("python", "runtime"):
        cmake("--install", BUILD, "--prefix", stage, "--component", component, "--strip")
    tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    tag = f"{tag}-{tag}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    about = f"tunica-{version()}.dist-info"
    files = {str(path.relative_to(stage)): path.read_bytes()
             for path in sorted((stage / "tunica").rglob("*")) if path.is_file()}
    files[f"{about}/METADATA"] = metadata().encode()
    files[f"{about}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{about}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: tunica {version()}\nRoot-Is-Purelib: false\n"
                               f"Tag: {tag}\n").encode()

    def line(name, content):
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        return f"{name},sha256={digest},{len(content)}\n"
    record = "".join(line(*file) for file in files.items()) + f"{about}/RECORD,,\n"
    wheel = f"tunica-{version()}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in {**files, f"{about}/RECORD": record.encode()}.items():
            archive.writestr(name, content)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    """The tracked files, as `git archive` has them."""
    name = f"tunica-{version()}"
    archive = pathlib.Path(sdist_directory) / f"{name}.tar.gz"
    tracked = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, capture_output=True, text=True).stdout
    with tarfile.open(archive, "w:gz") as packed:
        for path in filter(None, tracked.split("\0")):
            packed.add(ROOT / path, f"{name}/{path}")
        about = BUILD / "PKG-INFO"
        about.parent.mkdir(parents=True, exist_ok=True)
        about.write_text(metadata(), encoding="utf-8")
        packed.add(about, f"{name}/PKG-INFO")
    return archive.name
