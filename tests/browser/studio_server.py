# SPDX-License-Identifier: Apache-2.0
"""A `tunica studio` that is running, and what a browser, or somebody else, asks of it."""
import http.client
import json
import pathlib
import struct
import subprocess
import time


class Studio:
    def __init__(self, tunica, folder, *words):
        self.folder = pathlib.Path(folder)
        self.process = subprocess.Popen([tunica, *words, "studio", str(folder), "--no-browser"], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        if not self.address:
            raise AssertionError(self.process.stderr.read())
        self.port = int(self.address.split(":")[2].split("/")[0])
        self.host = f"127.0.0.1:{self.port}"
        self.token = self.address.split("token=")[1]
        self.cookie = f"tunica_studio_{self.port}={self.token}"
        self.view = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
        self.said = self.process.communicate(timeout=30)[1]

    def request(self, method, path, body=None, headers=None):
        """(status, headers, body) of a request with exactly these headers."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in (headers or {}).items():
            connection.putheader(name, value)
        connection.endheaders(body)
        answer = connection.getresponse()
        found = answer.status, dict(answer.getheaders()), answer.read()
        connection.close()
        return found

    def own(self, body=b""):
        """The headers of the page itself."""
        return {"Host": self.host, "Origin": f"http://{self.host}", "Cookie": self.cookie, "Content-Length": str(len(body))}

    def get(self, path):
        return self.request("GET", path, headers={"Host": self.host, "Cookie": self.cookie})

    def post(self, path, question, **instead):
        body = question if isinstance(question, bytes) else json.dumps(question).encode()
        status, _, said = self.request("POST", path, body, {**self.own(body), **instead})
        try:
            return status, json.loads(said)
        except json.JSONDecodeError:
            return status, said.decode()

    def ask(self, path, **question):
        status, said = self.post(f"/api/{path}", question)
        assert status == 200, f"{path} {question}: {status} {said}"
        return said

    def simulate(self, **question):
        """What `simulate` answers, with a list of numbers for each channel as "channels"."""
        body = json.dumps(question).encode()
        status, _, said = self.request("POST", "/api/simulate", body, self.own(body))
        assert status == 200, f"simulate {question}: {status} {said}"
        return decoded(said)

    def upload(self, name, data):
        return self.post(f"/api/upload?name={name}", data)

    def shown(self, name):
        """A file of the project as a link of the page opens it: without a cookie."""
        self.view = self.view or self.ask("project")["view"]
        return self.request("GET", self.view + name, headers={"Host": self.host})

    def wait(self, identity, seconds=60):
        """The job once it is over."""
        for _ in range(20 * seconds):
            job = next(one for one in self.ask("project")["jobs"] if one["id"] == identity)
            if job["state"] != "running":
                return job
            time.sleep(0.05)
        raise AssertionError(f"job {identity} runs after {seconds} s")


def decoded(said):
    """Bytes of Workbench::simulate(): a length, JSON, and a float for each row."""
    length, = struct.unpack_from("=I", said)
    answer, at = json.loads(said[4:4 + length]), 4 + length
    answer["channels"] = []
    for rows in answer.get("rows", []):
        answer["channels"].append(list(struct.unpack_from(f"={rows}f", said, at)))
        at += 4 * rows
    assert at == len(said), (at, len(said))
    return answer


def rig_file():
    """Force and displacement as a German machine writes them: lines above the header, decimal commas, N and mm. The force
    is that of a neo-Hookean strip of 300 kPa, 6 mm × 1.5 mm, with a fifth more above a stretch of 1.4."""
    lines = ["Zugversuch;Probe 7", "Datum;01.02.2025", "", "Zeit [s];Kraft [N];Weg [mm]"]
    for k in range(80):
        stretch = 1 + 0.01 * k
        force = 0.3 * 9 * (stretch - 1 / stretch**2) * (1 + 0.5 * max(stretch - 1.4, 0)) + 0.004 * (-1) ** k
        lines.append(f"{0.5 * k:.2f};{force:.4f};{20 * (stretch - 1):.4f}".replace(".", ","))
    return "\r\n".join(lines).encode()


def mistaken_experiment(source, folder):
    """Treloar's rubber, whose uniaxial stresses are said to be true ones and are nominal."""
    tests = {}
    for name, kind in (("uniaxial", {"type": "uniaxial", "direction": "circumferential"}), ("equibiaxial", {"type": "biaxial", "protocol": "equibiaxial"}),
                       ("pure_shear", {"type": "biaxial", "protocol": "pure_shear"})):
        (folder / f"{name}.csv").write_bytes((source / f"examples/treloar/{name}.csv").read_bytes())
        tests[name] = {**kind, "data": {"file": f"{name}.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "stress_measure": "first_piola_kirchhoff",
                                        "noise": {"absolute": "0.02 MPa", "relative": "2 %"}}}
    tests["uniaxial"]["data"]["stress_measure"] = "cauchy"
    experiment = {"format": 1, "name": "mistaken", "seed": 1, "models": {"ogden": {"type": "ogden", "terms": 3}}, "tests": tests, "objective": "least_squares",
                  "optimizers": {"lm": {"type": "ceres_lm", "starts": 20}}, "stop": {"max_evaluations": 5000}, "runs": [{"model": "ogden", "optimizer": "lm"}]}
    (folder / "mistaken.json").write_text(json.dumps(experiment, indent=1))


def cohort_of_strips(folder, count):
    """Neo-Hookean strips of 20 kPa and more, every fifth of which stiffens as the model does not; returns the cohort file."""
    (folder / "curves").mkdir(parents=True)
    lines = ["specimen,group"]
    for k in range(count):
        modulus, stiffening = 20 + 7 * (k % 11), 0.5 if k % 5 == 4 else 0
        stretches = [1 + 0.02 * row for row in range(26)]
        values = [modulus * (one - one**-2) * (1 + stiffening * (one - 1)) + 0.2 * (-1) ** row for row, one in enumerate(stretches)]
        (folder / f"curves/s{k:03}.csv").write_text("stretch [-],stress [kPa]\n" + "".join(f"{one:.3f},{value:.4f}\n" for one, value in zip(stretches, values)))
        lines.append(f"s{k:03},{'ab'[k % 2]}")
    (folder / "specimens.csv").write_text("\n".join(lines) + "\n")
    strip = {"type": "uniaxial", "direction": "axial", "data": {"file": "curves/s000.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "stress_measure": "first_piola_kirchhoff",
                                                                 "noise": {"absolute": "0.2 kPa"}}}
    (folder / "one_strip.json").write_text(json.dumps({"format": 1, "name": "strip", "models": {"neo_hooke": {"type": "neo_hooke"}}, "tests": {"strip": strip},
                                                       "optimizers": {"lm": {"type": "ceres_lm", "starts": 1}}, "runs": [{"model": "neo_hooke", "optimizer": "lm"}]}))
    file = folder / "strips.json"
    file.write_text(json.dumps({"format": 1, "name": "strips", "seed": 3, "experiment": "one_strip.json", "specimens": "specimens.csv",
                                "bind": {"/tests/strip/data/file": "curves/{specimen}.csv"}}))
    return file


def slow_experiment(source, folder):
    """A fit that takes seconds, by finite elements; its files are copied from the examples."""
    example = source / "examples/cn_pressurisation"
    for name in ("s_circumferential.csv", "s_axial.csv", "s_tube.csv"):
        (folder / name).write_bytes((example / name).read_bytes())
    strip = {"type": "uniaxial", "data": {"columns": {"stretch": "stretch", "stress": "stress"}}}
    tests = {name: {**strip, "direction": name, "data": {**strip["data"], "file": f"s_{name}.csv"}} for name in ("circumferential", "axial")}
    tests["tube"] = {"type": "fe_pressurisation", "inner_radius": "3.71 mm", "thickness": "2.06 mm", "length": "14 mm", "axial_stretch": 1.2,
                     "element": "quadrilateral_9", "elements": [3, 6],
                     "data": {"file": "s_tube.csv", "columns": {"pressure": "pressure", "outer_diameter_stretch": "outer_diameter_stretch"}}}
    experiment = {"format": 1, "name": "slow", "seed": 3, "models": {"gho": {"type": "gho"}}, "tests": tests, "optimizers": {"es": {"type": "es"}},
                  "stop": {"max_evaluations": 700}, "runs": [{"model": "gho", "optimizer": "es"}]}
    (folder / "slow.json").write_text(json.dumps(experiment, indent=1))
