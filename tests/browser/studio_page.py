# SPDX-License-Identifier: Apache-2.0
"""The page of the studio in a browser: what a user sees, clicks and types."""
import time

FIND = """const seen = (n) => n.offsetParent && n.textContent.trim().startsWith(arguments[0]) && !n.disabled;
const found = [...document.querySelectorAll('button, a, summary, option')].find(seen);"""


class Page:
    def __init__(self, browser, pictures=None):
        self.browser, self.pictures = browser, pictures

    def open(self, address):
        self.browser.log("browser"), self.browser.log("performance")
        self.browser.call("POST", self.browser.session + "/url", {"url": address})
        self.see("Worked examples")

    def until(self, script, *arguments, seconds=60):
        limit = time.monotonic() + seconds
        while time.monotonic() < limit:
            found = self.browser.run(script, *arguments)
            if found:
                return found
            time.sleep(0.03)
        said = self.browser.run("return document.body.innerText")
        raise AssertionError(f"not after {seconds} s: {script} {arguments}\n{said[:4000]}\n{self.browser.log('browser')}")

    def see(self, words, seconds=60):
        self.until("return document.body.innerText.includes(arguments[0])", words, seconds=seconds)

    def click(self, words):
        self.until(FIND + "if (found) found.click(); return Boolean(found)", words)

    def go(self, kind, name=""):
        place = f"#/{kind}" + (f"/{name}" if name else "")
        self.browser.run("location.hash = arguments[0]", place)
        self.until("return document.documentElement.dataset.shown === arguments[0]", place)

    def set(self, selector, text):
        """A value as typing gives it."""
        self.until("""const n = document.querySelector(arguments[0]);
          if (n) { n.value = arguments[1]; for (const kind of ['input', 'change']) n.dispatchEvent(new Event(kind, {bubbles: true})); }
          return Boolean(n)""", selector, text)

    def choose_file(self, file):
        element = self.browser.call("POST", self.browser.session + "/element", {"using": "css selector", "value": "input[type=file]"})
        identity = next(iter(element.values()))
        self.browser.call("POST", f"{self.browser.session}/element/{identity}/value", {"text": str(file)})

    def picture(self, name, height=None):
        """The whole page; with a height its upper part, 1000 pixels wide, as docs/studio.md has it."""
        if not self.pictures:
            return
        self.browser.run("document.getElementById('notice').textContent = ''")
        wide, tall = self.browser.run("return [innerWidth, document.documentElement.scrollHeight]")
        self.browser.size(wide, min(tall, 12000))  # charts are drawn where they are in sight
        time.sleep(0.6)
        self.browser.screenshot(self.pictures / f"{name}.png", height, 1000 / 1280 if height else 1)
        self.browser.size(wide, 900)

    def check_fits(self, width):
        wide = self.browser.run("return document.documentElement.scrollWidth")
        assert wide <= width, f"{self.browser.run('return location.hash')}: {wide} px wide on a screen of {width}"

    def check_named(self):
        """What a screen reader calls each control, from the browser's own tree."""
        nodes = self.browser.devtools("Accessibility.getFullAXTree")["nodes"]
        controls = {"button", "textbox", "slider", "combobox", "checkbox", "radio", "spinbutton", "link", "img", "image"}
        for node in nodes:
            role = node.get("role", {}).get("value")
            if role in controls and not node.get("ignored"):
                assert node.get("name", {}).get("value"), f"{self.browser.run('return location.hash')}: a {role} has no name: {node}"
        roles = {node.get("role", {}).get("value") for node in nodes if not node.get("ignored")}
        assert {"main", "banner", "navigation", "heading"} <= roles, roles

    def check_quiet(self, host):
        entries = [entry for entry in self.browser.log("browser") if entry["level"] in ("SEVERE", "WARNING")]
        assert not entries, entries
        others = [url for url in self.browser.requests() if not url.startswith((f"http://{host}/", "data:"))]
        assert not others, others
