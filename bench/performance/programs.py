# SPDX-License-Identifier: Apache-2.0
"""Rows of whole programs: start-up, calibrations, uncertainties, diagnoses, and the peers that do the same."""
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]


class Failure(Exception):
    pass


def without_comments(text):
    """JSON with // comments, none of which stands in a string with quotes of its own."""
    return re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*', lambda match: match.group(1) or "", text)


def example(name, folder, change):
    """A changed copy of an example's experiment beside its data; returns the file."""
    place = folder / name
    if not place.exists():
        shutil.copytree(SOURCE / "examples" / name, place)
        for beside in ("lamb_aorta", "known_solution"):
            if not (folder / beside).exists():
                shutil.copytree(SOURCE / "examples" / beside, folder / beside)
    experiment = json.loads(without_comments((place / "experiment.json").read_text(encoding="utf-8")))
    experiment.pop("$schema", None)
    change(experiment)
    file = place / f"benchmark_{abs(hash(json.dumps(experiment)))}.json"
    file.write_text(json.dumps(experiment), encoding="utf-8")
    return file


def run(command, folder):
    """Wall and processor seconds of a command."""
    begin = time.perf_counter()
    with open(folder / "output", "wb") as output:
        child = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, cwd=folder)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    seconds = time.perf_counter() - begin
    if child.returncode not in (0, 1):
        raise Failure(f"{' '.join(map(str, command))} ended with {child.returncode}:\n" +
                      (folder / "output").read_text(errors="replace")[-2000:])
    return seconds, usage.ru_utime + usage.ru_stime


def row(name, what, samples, cpu=None, size="", **more):
    quartiles = statistics.quantiles(samples, n=4) if len(samples) > 2 else [min(samples), 0, max(samples)]
    median = statistics.median(samples)
    facts = {} if cpu is None else {"processor_s": statistics.median(cpu)}
    made = {"name": name, "what": what, "unit": "run", "size": size, "clock": "wall", "time_s": median,
            "spread": (quartiles[2] - quartiles[0]) / 2 / median, "repeats": len(samples), "floors": [], "peers": [],
            "growth": None, "facts": facts, "samples_s": samples}
    made["facts"].update(more)
    return made


class Programs:
    """Rows of the programs of a build. `floor(jacobian)` returns seconds of the fused kernel of two strips of 40 points
    by level, measured in this minute."""

    def __init__(self, build, quick, floor):
        self.build, self.quick, self.floor = pathlib.Path(build).resolve(), quick, floor
        self.tunica = self.build / "bin/tunica"
        self.repeats = 1 if quick else 3

    def names(self):
        return list(self.table())

    def table(self):
        studies = {
            "startup/version": lambda: self.startup("version", "--version"),
            "startup/all_plugins": lambda: self.startup("all_plugins", "list", "models"),
            "study/known_solution_x100": self.known_solution,
            "study/lamb_aorta/lm": lambda: self.lamb_aorta("lm"),
            "study/lamb_aorta/es": lambda: self.lamb_aorta("es"),
            "study/lamb_aorta/all": lambda: self.lamb_aorta("all"),
            "study/lamb_aorta/profiles": lambda: self.lamb_aorta("profiles", "--profiles", "all"),
            "study/lamb_aorta/bootstrap_200": lambda: self.lamb_aorta("bootstrap_200", "--bootstrap", "200"),
            "study/inverse_fe/lm": lambda: self.inverse_fe("lm"),
            "study/inverse_fe/es": lambda: self.inverse_fe("es"),
            "study/inverse_fe/lm_guided": lambda: self.inverse_fe("lm", guided=True),
            "study/inverse_fe/es_guided": lambda: self.inverse_fe("es", guided=True),
            "study/long_tube_simulated": self.simulated,
            "diagnosis/quick": lambda: self.diagnosis("quick", "--quick"),
            "diagnosis/full": lambda: self.diagnosis("full"),
        }
        if "fewer_simulations" not in (SOURCE / "schemas/tunica-experiment.schema.json").read_text(encoding="utf-8"):
            del studies["study/inverse_fe/lm_guided"], studies["study/inverse_fe/es_guided"]
        return studies

    # ---- start-up

    def startup(self, name, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            command = [self.tunica, *arguments]
            bare = [self.build / "bin/bench_dlopen"]
            if name != "version":
                bare += sorted((self.build / "lib/tunica/plugins").glob("*.so"))
            count = 3 if self.quick else 21
            times = [(run(command, folder), run(bare, folder)) for _ in range(count)]
        made = row(f"startup/{name}", f"tunica {' '.join(arguments)}", [own[0] for own, _ in times], [own[1] for own, _ in times])
        made["floors"] = [{"what": "a bare program that loads the same libraries", "level": "",
                           "time_s": statistics.median(floor[0] for _, floor in times),
                           "ratio": statistics.median(own[0] / floor[0] for own, floor in times)}]
        return made

    # ---- calibrations

    def calibration(self, name, what, file, *arguments, points=80, repeats=None):
        """`tunica run`, beside what the fused kernel would need for as many evaluations of its strips."""
        samples, cpu = [], []
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for k in range(repeats or self.repeats):
                seconds, processor = run([self.tunica, "run", file, "-o", folder / str(k), "--quiet", *arguments], folder)
                samples.append(seconds)
                cpu.append(processor)
            result = json.loads((folder / "0/result.json").read_text())
        evaluations = sum(one["evaluations"] for one in result["runs"])
        jacobians = sum(one.get("jacobians", 0) for one in result["runs"])
        best = min((one["best"]["objective"] for one in result["runs"] if one["best"].get("objective") is not None), default=None)
        made = row(name, what, samples, cpu, evaluations=evaluations, jacobians=jacobians, best_objective=best)
        simulations = [one["full_simulations"]["count"] for one in result["runs"] if "full_simulations" in one]
        if simulations:
            made["facts"]["full_simulations"] = sum(simulations)
        if points:
            threads = os.cpu_count() if "-j" not in arguments else int(arguments[arguments.index("-j") + 1])
            for level, (objective, jacobian) in self.floor().items():
                seconds = (evaluations * objective + jacobians * jacobian) * points / 80 / threads
                made["floors"].append({"what": f"its evaluations by the fused kernel on {threads} thread(s)", "level": level,
                                       "time_s": seconds, "ratio": made["time_s"] / seconds})
        return made

    def known_solution(self):
        with tempfile.TemporaryDirectory() as folder:
            realisations = 2 if self.quick else 100

            def change(experiment):
                experiment["runs"] = [{"model": "gho", "optimizer": "es", "realisations": realisations}]
            file = example("known_solution", pathlib.Path(folder), change)
            made = self.calibration("study/known_solution_x100", f"known solution by es, {realisations} realisations", file, points=102)
            one = self.calibration("", "", file, "-j", "1", points=0, repeats=1)
        made["facts"]["one_thread_s"] = one["time_s"]
        made["facts"]["gain_of_threads"] = one["time_s"] / made["time_s"]
        return made

    def lamb_aorta(self, name, *arguments):
        def change(experiment):
            if name == "all":
                return
            optimizer = "es" if name == "es" else "lm"
            experiment["runs"] = [one for one in experiment["runs"] if (one["model"], one["optimizer"]) == ("gho", optimizer)]
            if name == "es" and self.quick:
                experiment["runs"][0]["stop"] = {"max_evaluations": 1200}
        what = {"lm": "lamb aorta, gho by lm, 20 starts, with intervals and certificate", "es": "lamb aorta, gho by es",
                "all": "lamb aorta, all four runs of the example", "profiles": "the same by lm with profiles of all parameters",
                "bootstrap_200": "the same by lm with 200 bootstrap draws"}[name]
        with tempfile.TemporaryDirectory() as folder:
            made = self.calibration(f"study/lamb_aorta/{name}", what, example("lamb_aorta", pathlib.Path(folder), change), *arguments)
        peers = self.scipy() if name in ("lm", "es") else None
        if peers:
            of, words = ("least_squares", f"scipy least_squares, {1 if self.quick else 20} start(s)") if name == "lm" else (
                "differential_evolution", f"scipy differential_evolution, {peers['differential_evolution_evaluations']} evaluations")
            made["peers"].append({"what": words, "level": "", "time_s": peers[of + "_s"], "ratio": made["time_s"] / peers[of + "_s"],
                                  "objective": peers[of + "_objective"]})
        return made

    def inverse_fe(self, optimizer, guided=False):
        """Two strips, the clamped tube and transverse stability (Canales et al. 2023), set S. Without a guide `es` has a
        coarse mesh, as in examples/cn_pressurisation."""
        coarse = self.quick or (optimizer == "es" and not guided)

        def change(experiment):
            tube = "s_tube_quick" if coarse else "s_tube"
            stop = {"max_evaluations": 8 if self.quick else 200 if optimizer == "lm" and not guided else 12000}
            if not guided:
                stop["target"] = 1e-9 if optimizer == "lm" else 3e-8
            if self.quick:
                experiment["optimizers"] = {"lm": {"type": "ceres_lm", "starts": 1}, "es": {"type": "es", "parents": 2, "offspring": 4}}
            used = ["s_circumferential", "s_axial", tube]
            experiment["runs"] = [{"model": "gho", "optimizer": optimizer, "tests": used, "stop": stop,
                                   "constraints": [{"type": "transverse_stability", "h": 1}]}]
            if guided:
                experiment["fewer_simulations"] = {"guide": True}
            experiment["tests"] = {name: test for name, test in experiment["tests"].items() if name in used}
            experiment["models"].pop("known_angle", None)
        name = optimizer + ("_guided" if guided else "")
        what = f"two strips and the clamped tube ({'3x6 nine-node' if coarse else '25x50'} elements), stable, by {optimizer}"
        with tempfile.TemporaryDirectory() as folder:
            return self.calibration(f"study/inverse_fe/{name}", what + (" with a guide" if guided else ""),
                                    example("cn_pressurisation", pathlib.Path(folder), change), points=0,
                                    repeats=1 if name == "es" else None)

    # ---- simulations and diagnoses

    def simulated(self):
        """A ring of Yeoh's rubber at 21 pressures: long tube here, hexahedra in CalculiX."""
        def external(experiment):
            experiment["tests"] = {"tube": experiment["tests"]["tube"]}

        def own(experiment):
            experiment["tests"] = {"tube": {
                "type": "thick_wall_pressurisation", "inner_radius": "1 mm", "thickness": "0.5 mm", "axial_stretch": 1,
                "data": {"file": "own.csv", "columns": {"pressure": "pressure", "outer_diameter": "diameter"}}}}
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            ours = example("calculix", folder, own)
            theirs = example("calculix", folder, external)
            lines = [line for line in (ours.parent / "tube.csv").read_text().splitlines() if line[:1].isdigit()]
            rows = [[float(word) for word in line.split(",")[:2]] for line in lines]
            (ours.parent / "own.csv").write_text("pressure [kPa],diameter [mm]\n" + "".join(f"{p},{3 + g}\n" for p, g in rows))
            (folder / "parameters.json").write_text(json.dumps({"c10": 170, "c20": -8, "c30": 1.2}))
            times = []
            has_peer = shutil.which("ccx") is not None
            for k in range(self.repeats):
                command = [self.tunica, "simulate", "FILE", "--model", "yeoh", "--parameters", folder / "parameters.json", "-o"]
                pair = []
                for which, file in (("own", ours), ("ccx", theirs)):
                    if which == "own" or has_peer:
                        pair.append(run([file if word == "FILE" else word for word in command] + [folder / f"{which}{k}"], folder)[0])
                times.append(pair)
        made = row("study/long_tube_simulated", "tunica simulate, a ring of rubber as long tube", [pair[0] for pair in times],
                   size=f"{len(rows)} pressures")
        if has_peer:
            made["peers"] = [{"what": "the same through CalculiX, hexahedra", "level": "",
                              "time_s": statistics.median(pair[1] for pair in times),
                              "ratio": statistics.median(pair[0] / pair[1] for pair in times)}]
        return made

    def diagnosis(self, name, *arguments):
        samples, cpu = [], []
        file = SOURCE / "examples/lamb_aorta_cause/experiment.json"
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for k in range(1 if name == "full" else self.repeats):
                seconds, processor = run([self.tunica, "diagnose", file, "-o", folder / str(k), "--quiet", *arguments], folder)
                samples.append(seconds)
                cpu.append(processor)
        return row(f"diagnosis/{name}", "lamb aorta, tunica diagnose " + " ".join(arguments), samples, cpu)

    # ---- peers

    def scipy(self):
        """What peers.py measures, once a process; None without scipy."""
        if not hasattr(self, "scipy_found"):
            self.scipy_found = None
            for python in ("python3", "/usr/bin/python3"):
                if shutil.which(python) and subprocess.run([python, "-c", "import scipy"], capture_output=True).returncode == 0:
                    command = [python, str(pathlib.Path(__file__).with_name("peers.py")), str(SOURCE)]
                    done = subprocess.run(command + (["--quick"] if self.quick else []), capture_output=True, text=True)
                    if done.returncode != 0:
                        raise Failure(done.stderr[-2000:])
                    self.scipy_found = json.loads(done.stdout)
                    break
        return self.scipy_found
