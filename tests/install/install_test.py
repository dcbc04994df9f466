#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""install_test.py --build DIR --source DIR --work DIR PART: one part of the install test. `prefix` installs and moves what
was installed; the others use it as a stranger would, with nothing of the build tree but the refused plugins."""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ask = argparse.ArgumentParser(description=__doc__)
ask.add_argument("--build", type=pathlib.Path, required=True)
ask.add_argument("--source", type=pathlib.Path, required=True)
ask.add_argument("--work", type=pathlib.Path, required=True)
ask.add_argument("--launcher", help="compiler launcher, for example ccache")
ask.add_argument("--python", help="the Python that the package was built for")
ask.add_argument("--all", action="store_true", help="part like: every plugin that can be copied; takes minutes")
ask.add_argument("part")
told = ask.parse_args()
prefix = told.work / "moved/tunica"
program = prefix / "bin/tunica"
examples = ["demiray", "fung_exponential", "fibre_damage", "angular_fibres", "bulge", "pattern_search", "grip_compliance"]
os.umask(0o022)  # a plugin that others could change is refused
os.environ.pop("TUNICA_PLUGIN_PATH", None)


def run(*words, code=0, cwd=None):
    """Both outputs of a command, which has to end with this exit code."""
    done = subprocess.run([str(word) for word in words], cwd=cwd, capture_output=True, text=True)
    if done.returncode != code:
        sys.exit(f"{' '.join(map(str, words))}\nexit code {done.returncode}, expected {code}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def expect(condition, about):
    if not condition:
        sys.exit(f"install_test.py {told.part}: {about}")


def fresh(name):
    folder = told.work / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def install():
    here = fresh("first/tunica")
    fresh("moved").rmdir()
    run("cmake", "--install", told.build, "--prefix", here)
    here.parent.rename(prefix.parent)  # where it was installed to exists no more
    expect(program.exists(), f"{program} was not installed")
    libraries = [path for path in prefix.rglob("*.so*") if not {"plugins", "dist-packages"} & {*path.parts}]
    expect(not libraries, f"libraries without a place in the policy: {libraries}")
    shown = run(program, "list", "models")
    expect("gho" in shown, f"the moved program does not find its plugins:\n{shown}")
    for file in [*prefix.rglob("*.cmake"), *prefix.rglob("*.pc")]:
        for path in (told.build, told.source, told.work):
            expect(str(path) not in file.read_text(), f"{file} names {path}")


def build(folder):
    """cmake -S folder -B folder/build && cmake --build folder/build, optimised as a user gets it in a few parts only: what
    the parts look at is the same without, and a model compiles in a third of the time."""
    settings = [f"-DCMAKE_CXX_COMPILER_LAUNCHER={told.launcher}"] if told.launcher else []
    if told.part not in ("demiray", "new_model", "new_optimizer"):
        settings.append("-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG")
    run("cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={prefix}", *settings)
    run("cmake", "--build", folder / "build")


def passes(folder, name):
    print(run("ctest", "--test-dir", folder / "build", "--output-on-failure", "--no-tests=error"))
    exported = run("nm", "-D", "--defined-only", "-C", folder / f"build/{name}.so").split("\n")
    ours = [line.split(maxsplit=2)[-1] for line in exported if line and " A " not in line]
    expect(ours == ["tunica_plugin"], f"{name} exports {ours}")


def new(kind):
    """Five commands from nothing to a result."""
    name = f"my_{kind}"
    folder = fresh(f"new_{kind}") / name
    verb = "diagnose" if kind == "mechanism" else "run"
    print(run(program, "plugin", "new", kind, name, cwd=folder.parent))
    build(folder)
    print(run(program, "plugin", "check", folder / f"build/{name}.so"))
    print(run(program, "--plugin-path", folder / f"build/{name}.so", verb, folder / "experiment.json", "-o", folder / "out"))
    result = json.loads((folder / "out/result.json").read_text())
    expect(f"{name} 1.0.0" in json.dumps(result["provenance"]), f"{name} is not in the provenance")
    passes(folder, name)


def documents():
    """The folder of the pages: README.md, docs, examples, schemas."""
    return next(prefix.glob("share/doc/*/README.md")).parent


def pages():
    """Pages and examples are there, links between them lead somewhere, and an example runs as it was installed."""
    here = documents()
    shown = [here / "README.md", *here.glob("docs/**/*.md"), *here.glob("examples/**/*.md")]
    expect(len(shown) > 40, f"only {len(shown)} pages in {here}")
    for name in ("docs", "examples", "schemas"):
        kept = {"docs": "*.md", "examples": "*.json", "schemas": "*.json"}[name]
        for path in (told.source / name).rglob(kept):
            if not {"build", "results", "out"} & {*path.parts}:
                expect((here / path.relative_to(told.source)).exists(), f"{path} was not installed")
    for page in shown:
        for link in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", page.read_text()):
            target = (page.parent / link).resolve()
            expect(target.is_relative_to(here.resolve()), f"{page}: {link} leads out of the pages")
            if target.relative_to(here.resolve()).parts[:1] in [("docs",), ("examples",), ("schemas",)]:
                expect(target.exists(), f"{page}: {link} leads nowhere")
    folder = fresh("pages")
    run(program, "run", here / "examples/treloar/experiment.json", "-o", folder / "out")
    expect((folder / "out/result.json").exists(), "the example has no result")


def like():
    """A copy of a built-in plugin of each kind that can be copied: it builds, passes and answers to its own name."""
    copies = [("model", "gho"), ("test", "simple_shear"), ("optimizer", "es")]
    if told.all:
        copies = [(kind, name) for kind, names in copied().items() for name in names]
    for kind, name in copies:
        mine = f"my_{name}_2"
        folder = fresh(f"like_{name}") / mine
        print(run(program, "plugin", "new", kind, mine, "--like", name, cwd=folder.parent))
        for path in folder.iterdir():
            if path.suffix in (".cpp", ".hpp"):
                expect(not re.search(rf'"{name}"', path.read_text()), f"{path} still names {name}")
        build(folder)
        passes(folder, mine)
        shown = run(program, "--plugin-path", folder / f"build/{mine}.so", "describe", mine)
        expect(f"plugin {mine} 1.0.0" in shown, f"{mine} is not described: {shown}")


def copied():
    """What can be copied, as the refusals list it."""
    kinds = {}
    for kind in ("model", "test", "optimizer"):
        shown = re.sub(r"\s+", " ", run(program, "plugin", "new", kind, "mine", "--like", "external", code=2, cwd=fresh("copied")))
        kinds[kind] = re.search(r"take one of the \w+ ([a-z0-9_, ]+)", shown)[1].strip().split(", ")
    return kinds


def like_refuses():
    folder = fresh("like_refuses")
    for words, message in [(("model", "mine", "--like", "composed"), "--like composed: it cannot be copied, since"),
                           (("model", "mine", "--like", "composed"), "take one of the models arruda_boyce, four_fibre"),
                           (("optimizer", "mine", "--like", "nlopt"), "take one of the optimizers es"),
                           (("model", "mine", "--like", "uniaxial"), "write `tunica plugin new test NAME --like uniaxial`"),
                           (("model", "mine", "--like", "ghp"), "there is no such model to copy. Did you mean 'gho'"),
                           (("mechanism", "mine", "--like", "fibre_dispersion"), "a mechanism cannot be copied; leave --like out"),
                           (("model", "gho", "--like", "hgo"), "'gho' is provided by a loaded plugin")]:
        shown = run(program, "plugin", "new", *words, code=2, cwd=folder)
        expect(message in re.sub(r"\s+", " ", shown), f"{words}: {shown}")
    expect(not [*folder.iterdir()], "something was written")


def new_refuses():
    folder = fresh("new_refuses")
    for words, message in [(("modle", "mine"), "there is no kind of plugin called 'modle'. Did you mean 'model'"),
                           (("model", "My-Model"), "'My-Model' cannot name a plugin; expected lower-case letters"),
                           (("model", "gho"), "'gho' is provided by a loaded plugin"),
                           (("test", "mine", "-o", folder), "exists and is not empty; nothing was written")]:
        (folder / "file").write_text("mine\n")
        shown = run(program, "plugin", "new", *words, code=2, cwd=folder)
        expect(message in re.sub(r"\s+", " ", shown), f"{words}: {shown}")
    expect([path.name for path in folder.iterdir()] == ["file"], "something was written")


def example(name):
    folder = fresh(f"examples/{name}")
    shutil.copytree(documents() / "examples/plugins" / name, folder, dirs_exist_ok=True)  # as it was installed
    build(folder)
    passes(folder, name)


def pkg_config():
    folder = fresh("pkg_config")
    os.environ["PKG_CONFIG_PATH"] = str(next(prefix.rglob("tunica.pc")).parent)
    flags = run("pkg-config", "--cflags", "tunica").split()
    for variable in ("plugin_cflags", "plugin_ldflags"):
        flags += run("pkg-config", f"--variable={variable}", "tunica").split()
    source = told.source / "examples/plugins/demiray/demiray.cpp"
    run("g++", source, *flags, "-o", folder / "demiray.so")
    expect("demiray" in run(program, "--plugin-path", folder / "demiray.so", "describe", "demiray"), "is not described")


def python():
    """The package finds the plugins beside it, wherever both have been moved."""
    package = prefix / "lib/python3/dist-packages"
    here = fresh("python")
    (here / "use.py").write_text(
        "import json, sys, tunica\n"
        "result = tunica.run(sys.argv[1], 'out', certificate=True)\n"
        "certified = result.best.best['certificate']['fresh_process']\n"
        "print(json.dumps([tunica.__file__, certified, len(tunica.names()['models'])]))\n")
    shown = run("env", f"PYTHONPATH={package}", told.python, "-B", "use.py",
                told.source / "examples/treloar/experiment.json", cwd=here)
    file, certified, models = json.loads(shown.splitlines()[-1])
    expect(pathlib.Path(file).is_relative_to(prefix), f"the package was loaded from {file}")
    expect(certified, "the fresh process did not find the package")
    expect(models == len(run(program, "list", "models", "--names").split()), f"{models} models")
    expect(not [path for path in (package / "tunica").iterdir() if path.is_symlink()], "links into the sources")
    expect((package / "tunica/py.typed").exists(), "no py.typed")


def paths():
    return [word for name in examples for word in ("--plugin-path", told.work / f"examples/{name}/build/{name}.so")]


def shelves():
    listed = run(program, *paths(), "list")
    schema = run(program, *paths(), "schema")
    for name in examples:
        expect(re.search(rf"^  {name} ", listed, re.MULTILINE), f"{name} is not listed:\n{listed}")
        expect(f'"{name}"' in schema, f"{name} is not in the schema")
        expect(f"plugin {name} 1.0.0" in run(program, *paths(), "describe", name), f"{name} is not described")


def beside_built_ins():
    """One experiment with a third-party model, test and optimiser among built-in ones."""
    folder = fresh("beside_built_ins")
    plugins = told.source / "examples/plugins"
    experiment = json.loads((plugins / "bulge/experiment.json").read_text())
    experiment["models"]["tissue"] = {"type": "demiray"}
    experiment["tests"]["bulge"]["data"]["file"] = str(plugins / "bulge/bulge.csv")
    experiment["tests"]["strip"]["data"]["file"] = str(plugins / "bulge/strip.csv")
    experiment["tests"]["strip"]["hold_out"] = False
    experiment["optimizers"]["pattern"] = {"type": "pattern_search"}
    experiment["runs"] = [{"model": m, "optimizer": o} for m in ("rubber", "tissue") for o in ("lm", "pattern")]
    (folder / "experiment.json").write_text(json.dumps(experiment))
    print(run(program, *paths(), "run", folder / "experiment.json", "-o", folder / "out"))
    runs = json.loads((folder / "out/result.json").read_text())["runs"]
    expect(len(runs) == 4, f"{len(runs)} runs")
    for one in runs[:2]:  # made with mu = 400 kPa
        value = one["best"]["parameters"]["mu"]["value"]
        expect(abs(value - 400) < 2, f"mu = {value} with {one['optimizer']}")
    found = [one["best"]["objective"] for one in runs]
    for built_in, third_party in (found[:2], found[2:]):
        expect(abs(third_party / built_in - 1) < 1e-4, f"ceres_lm and pattern_search disagree: {found}")


def refusals():
    folder = fresh("refusals")
    api = int(re.search(r"define TUNICA_PLUGIN_API (\d+)", (prefix / "include/tunica/plugin.hpp").read_text())[1])
    good = told.source / "tests/bad_plugins/good.cpp"

    def compiled(name, flags=(), change=()):
        """The good plugin, with other flags or another edition of the headers."""
        include = prefix / "include"
        if change:
            include = folder / f"{name}_include"
            shutil.copytree(prefix / "include", include)
            header = include / "tunica/plugin.hpp"
            for old, new in change:
                before = header.read_text()
                header.write_text(before.replace(old, new))
                expect(header.read_text() != before, f"{old!r} is not in plugin.hpp")
        run("g++", "-std=c++20", "-shared", "-fPIC", "-fvisibility=hidden", "-fno-gnu-unique", f"-I{include}",
            "-I/usr/include/eigen3", *flags, good, "-o", folder / f"{name}.so")
        return folder / f"{name}.so"

    define = f"define TUNICA_PLUGIN_API {api}"
    cases = [(compiled("avx", ["-mavx"]), "alignment: expected 16, found 32"),
             (compiled("debug", ["-D_GLIBCXX_DEBUG"]), "debug"),
             (compiled("older", change=[(define, f"define TUNICA_PLUGIN_API {api - 1}")]), f"plugin API {api - 1}; expected {api}"),
             (compiled("newer", change=[(define, f"define TUNICA_PLUGIN_API {api + 1}")]), f"plugin API {api + 1}; expected {api}"),
             (compiled("longer", change=[("const char* version;", "const char* version;\n  const char* licence;"),
                                         ("plugin_version, ", 'plugin_version, "", ')]),
              "bytes; expected")]
    texts = {"default_outside_bounds": "outside its own bounds", "missing_symbol": "exports no symbol", "no_name": "has no name", "null_header": "null pointer",
             "no_register_function": "no register function", "non_standard_throw": "threw something",
             "other_fingerprint": "binary interface differs", "other_struct_size": "bytes; expected",
             "throwing_registration": "registration of plugin", "undefined_symbol": "needs the symbol",
             "wrong_api": "was built for plugin API", "duplicate_name": ""}
    for path in sorted((told.build / "tests/bad_plugins").glob("*.so")):
        if path.stem in ("good", "duplicate_name"):
            continue
        expect(path.stem in texts, f"{path.name}: no message is known for it")
        cases.append((pathlib.Path(shutil.copy(path, folder)), texts[path.stem]))
    for path, message in cases:
        for words in (["--plugin-path", path, "list"], ["plugin", "check", path]):
            shown = re.sub(r"\s+", " ", run(program, *words, code=3))
            expect(message in shown, f"{path.name}: expected '{message}' in: {shown}")
    fine = compiled("fine")
    expect("[good" in run(program, "--plugin-path", fine, "list"), "a good plugin is not listed")
    twice = run(program, "--plugin-path", fine, "--plugin-path", shutil.copy(fine, folder / "again.so"), "list", code=3)
    expect("again.so" in twice, twice)


parts = {"prefix": install, "new_refuses": new_refuses, "pkg_config": pkg_config, "shelves": shelves,
         "beside_built_ins": beside_built_ins, "refusals": refusals}
parts["python"] = python
parts.update({"pages": pages, "like": like, "like_refuses": like_refuses})
parts.update({f"new_{kind}": lambda kind=kind: new(kind) for kind in ("model", "test", "optimizer", "mechanism")})
parts.update({name: lambda name=name: example(name) for name in examples})
parts[told.part]()
