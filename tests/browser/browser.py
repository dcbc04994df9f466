# SPDX-License-Identifier: Apache-2.0
"""Headless Chromium over the WebDriver protocol, which is JSON over HTTP: Python's own library is enough."""
import base64
import json
import shutil
import socket
import subprocess
import time
import urllib.request


def available():
    return shutil.which("chromium") is not None and shutil.which("chromedriver") is not None


class Browser:
    def __init__(self, downloads, watched=True):
        """Logs of the console and the network cost time for every request; not `watched` there are none."""
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self.base = f"http://127.0.0.1:{port}"
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(100):
            try:
                self.call("GET", "/status")
                break
            except OSError:
                time.sleep(0.05)
        options = {"args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"],
                   "prefs": {"download.default_directory": str(downloads), "download.prompt_for_download": False}}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options}
        if watched:
            wanted["goog:loggingPrefs"] = {"browser": "ALL", "performance": "ALL"}
        self.session = "/session/" + self.call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})["sessionId"]
        self.devtools("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(downloads))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.call("DELETE", self.session)
        finally:
            self.driver.terminate()
            self.driver.wait()

    def call(self, method, path, body=None):
        data = None if method == "GET" else json.dumps(body or {}).encode()
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=method)
        with urllib.request.urlopen(request, timeout=300) as answer:
            return json.load(answer)["value"]

    def devtools(self, command, **parameters):
        return self.call("POST", self.session + "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def run(self, script, *arguments):
        return self.call("POST", self.session + "/execute/sync", {"script": script, "args": list(arguments)})

    def size(self, width, height):
        self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def look(self, width, scheme):
        self.size(width, 900)
        self.devtools("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def open(self, file):
        """Returns [charts drawn, charts failed, milliseconds, figures] once the page says that it is done."""
        self.log("browser"), self.log("performance")
        self.call("POST", self.session + "/url", {"url": file.as_uri()})
        for _ in range(1200):
            state = self.run("const d = document.documentElement.dataset; return [d.drawn, d.failed, d.milliseconds]")
            if state[0] is not None:
                figures = self.run("return document.querySelectorAll('figure[data-chart]').length")
                return [int(value) for value in state] + [figures]
            time.sleep(0.05)
        raise AssertionError(f"{file}: not drawn after a minute; the console says {self.log('browser')}")

    def log(self, kind):
        return self.call("POST", self.session + "/se/log", {"type": kind})

    def requests(self):
        """The addresses asked for since the page was opened."""
        messages = (json.loads(entry["message"])["message"] for entry in self.log("performance"))
        return [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]

    def mouse(self, kind, x, y):
        pressed = {"button": "left", "buttons": 1, "clickCount": 1} if kind != "mouseMoved" else {}
        self.devtools("Input.dispatchMouseEvent", type=kind, x=x, y=y, **pressed)

    def key(self, name):
        for kind in ("keyDown", "keyUp"):
            self.devtools("Input.dispatchKeyEvent", type=kind, key=name, code=name)

    def pdf(self):
        return base64.b64decode(self.devtools("Page.printToPDF", printBackground=False, paperWidth=8.27, paperHeight=11.69)["data"])

    def screenshot(self, file, height=None, scale=1):
        size = self.devtools("Page.getLayoutMetrics")["cssContentSize"]
        clip = {"x": 0, "y": 0, "width": size["width"], "height": min(size["height"], height or 12000), "scale": scale}
        picture = self.devtools("Page.captureScreenshot", format="png", captureBeyondViewport=True, clip=clip)
        file.write_bytes(base64.b64decode(picture["data"]))
