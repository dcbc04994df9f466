# SPDX-License-Identifier: Apache-2.0
"""What the editor of the studio asks: a text is tried in the place of its file, and nothing else happens."""
import json
import os
import select
import shutil
import socket

from studio_server import Studio


def a_text_is_tried_without_its_servers(studio):
    """What stands in the editor is read, and no server that a test names is asked."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        data = {"file": "strip.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "stress_measure": "cauchy", "noise": {"absolute": "0.2 kPa"}}
        test = {"type": "um_bridge", "url": f"http://127.0.0.1:{server.getsockname()[1]}", "inputs": [["mu"]], "time_limit": 1,
                "outputs": {"stress": {"output": 0, "unit": "kPa"}}, "data": data}
        file = {"format": 1, "models": {"neo_hooke": {"type": "neo_hooke"}}, "tests": {"strip": test}, "optimizers": {"lm": {"type": "ceres_lm"}},
                "runs": [{"model": "neo_hooke", "optimizer": "lm"}]}
        (studio.folder / "strip.csv").write_text("stretch,stress\n1.1,1\n1.2,3\n1.3,4\n")
        (studio.folder / "served.json").write_text(json.dumps(file))
        said = studio.ask("proof", file="served.json", text=json.dumps(file))
        assert said == {"error": None}, said
        assert not select.select([server], [], [], 0.5)[0], "the editor asks a server that the file names"
    file["tests"]["strip"]["inputs"] = [["nu"]]
    said = studio.ask("proof", file="served.json", text=json.dumps(file))
    assert "passing" not in json.dumps(said) and "nu" in said["error"], said
    assert not list(studio.folder.glob(".passing*"))


def a_folder_that_cannot_be_written(tunica, folder):
    """The editor says so; even root may not write here without its capabilities."""
    if not shutil.which("setpriv"):
        print("skipped: a folder that cannot be written, setpriv is not installed")
        return
    locked = folder / "locked"
    locked.mkdir(parents=True)
    (locked / "strip.json").write_text("{}")
    locked.chmod(0o555)
    less = ["--bounding-set", "-all"] if os.geteuid() == 0 else []
    try:
        with Studio("setpriv", folder, "--no-new-privs", *less, tunica) as studio:
            for path, question in (("proof", {"text": "{}"}), ("save", {"text": "{}", "hash": studio.ask("document", file="locked/strip.json")["hash"]})):
                status, said = studio.post(f"/api/{path}", {"file": "locked/strip.json", **question})
                assert status == 400 and said["error"].startswith("locked/strip.json: ") and "make that folder writable" in said["error"], said
                assert "passing" not in said["error"], said
    finally:
        locked.chmod(0o755)
