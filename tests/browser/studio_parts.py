# SPDX-License-Identifier: Apache-2.0
"""Parts of the studio's page on their own, in a page that is open, where a walk does not come by."""
import json

LIVE = """return (async () => {
  const kept = [window.WebSocket, window.fetch], sockets = [], asked = [];
  class Fake extends EventTarget {
    static CONNECTING = 0;
    static OPEN = 1;
    constructor() { super(); this.readyState = 0; sockets.push(this); }
    send() {}
    turn(state, kind) { this.readyState = state; this.dispatchEvent(new Event(kind)); }
    says(data) { this.dispatchEvent(new MessageEvent("message", { data })); }
  }
  const bytes = (by) => {
    const words = new TextEncoder().encode(JSON.stringify({ rows: [], by })), all = new Uint8Array(4 + words.length);
    new Uint32Array(all.buffer, 0, 1)[0] = words.length;
    all.set(words, 4);
    return all.buffer;
  };
  window.WebSocket = Fake;
  window.fetch = async (_, { body }) => { asked.push(JSON.parse(body).values[0]); return new Response(bytes("request")); };
  try {
    const { simulate } = await import("/page/live.js?on_its_own"), ask = (value) => simulate({ values: [value] }).then((one) => one.by, (error) => `refused: ${error.message}`);
    const first = await ask(1), [old] = sockets;
    old.turn(1, "open");
    const left = ask(2); // and the connection begins to close
    old.readyState = 2;
    const between = await ask(3), fresh = sockets[1];
    fresh.turn(1, "open");
    const own = ask(4);
    old.turn(3, "close");
    fresh.says(bytes("connection"));
    const answers = [first, await left, between, await own], refusals = [];
    for (const data of ["it leaves the project\\n", '{"error": "as the program says"}', new ArrayBuffer(2)]) {
      const one = ask(5);
      fresh.says(data);
      refusals.push(await one);
    }
    fresh.turn(3, "close");
    await ask(6);
    sockets[2].turn(3, "close"); // refused: it has never been open
    await ask(7);
    return { answers, refusals, asked, sockets: sockets.length };
  } finally {
    [window.WebSocket, window.fetch] = kept;
  }
})()"""


def one_queue_a_connection(page):
    """An old connection that ends leaves the questions of the new one; a refusal ends its question, whatever it is."""
    found = page.browser.run(LIVE)
    assert found["answers"] == ["request", "request", "request", "connection"], found
    assert found["asked"] == [1, 3, 2, 6, 7], found
    assert found["refusals"][:2] == ["refused: it leaves the project\n", "refused: as the program says"] and found["refusals"][2].startswith("refused: "), found
    assert found["sockets"] == 3, "a connection that was refused is asked for at every move"


def a_running_job_leads_to_its_page(page):
    found = page.browser.run("""return import("/page/jobs.js").then(({ jobLine }) => [["run"], ["diagnose"], ["diagnose", true], ["discover"]].map(([verb, readings = false]) =>
      jobLine({ verb, readings, experiment: "a.json", command: "tunica", state: "running", started: 0 }).querySelector("a").getAttribute("href")))""")
    assert found == ["#/fit/a.json", "#/causes/a.json", "#/model/a.json", "#/causes/a.json"], found


def tests_of_the_first_specimen_that_has_them(page):
    """A specimen without a fit of the run leaves no other picture empty, nor does one whose result cannot be read."""
    found = page.browser.run("""return (async () => {
      const kept = window.fetch, asked = [];
      window.fetch = async (url) => {
        asked.push(url.split("/").at(-2));
        if (url.includes("lost")) return new Response("there is none", { status: 400 });
        return new Response(JSON.stringify({ runs: [{ run: "a/lm", best: url.includes("without") ? null : { per_test: { strip: 1 } } }] }));
      };
      try {
        const { testsOf } = await import("/page/cohort.js"), tests = testsOf("a/lm");
        const answers = await Promise.all(["without", "lost", "with", "later"].map((one) => tests(one).catch((error) => error.message)));
        return { answers: answers.map((one) => one ?? null), asked };
      } finally {
        window.fetch = kept;
      }
    })()""")
    assert found == {"answers": [None, "there is none", {"strip": 1}, {"strip": 1}], "asked": ["without", "lost", "with"]}, found


def mistakes_stand_as_the_diagnosis_says(page, folder):
    """First and with a button where they are as likely as the causes, else below them; those that gain little nowhere."""
    file = folder / "results/strip-diagnosis-1/result.json"
    before = file.read_text()
    document = json.loads(before)
    base = document["diagnosis"]["base"]["squares"]
    document["diagnosis"]["causes"] = [{"id": "force_offset", "group": "rig", "probability": 0.8, "explanation": "the force has an offset"}]
    mistake = {"kind": "stress_measure", "tests": ["strip"], "sentence": "the stresses are others", "mend": "another measure", "squares": base / 10, "p_after": 0.5,
               "probability": 0.9, "near": True, "changes": [{"op": "add", "path": "/tests/strip/data/stress_measure", "value": "cauchy"}]}
    others = [{**mistake, "sentence": "it gains little", "squares": base / 1.1}, {**mistake, "sentence": "it is unlikely", "probability": 0},
              {**mistake, "sentence": "it is of no size", "mechanism": "force_offset", "amplitudes": [0]}]
    for standing, codes, is_asked in (("near", [], True), ("ahead", [], True), ("far", ["file_as_likely"], True), ("far", ["unlisted_misfit"], False)):
        document["diagnosis"]["file"].update(standing=standing, causes=[*others, mistake])
        document["diagnosis"]["reason_codes"] = codes
        file.write_text(json.dumps(document))
        page.go("causes", "strip.json")
        page.see("the stresses are others, this fits 10 times better")
        heads, buttons = page.browser.run("""return [[...document.querySelectorAll('h3')].map((one) => one.textContent),
          [...document.querySelectorAll('.mistake button')].length]""")
        first = heads.index("What the file may say that is not so") < heads.index("Causes")
        assert (first, buttons) == ((True, 1) if is_asked else (False, 0)), f"{standing}, {codes}: {heads}, {buttons} buttons"
        page.go("sheet", "results%2Fstrip-diagnosis-1")
        page.see("How much of the range is missed")
        shown = page.browser.run("return document.body.innerText")
        assert ("the stresses are others: fits 10 times better" in shown) == is_asked, f"{standing}, {codes}: {shown}"
        assert not any(one["sentence"] in shown for one in others), f"{standing}, {codes}: {shown}"
    file.write_text(before)


def each_run_of_a_cohort_has_its_table(page, folder):
    """What specimens have in common is that of the run that is chosen."""
    file = folder / "results/strips/result.json"
    before = file.read_text()
    document = json.loads(before)
    first = document["cohort"]["populations"][0]
    other = {**json.loads(json.dumps(first)), "run": "other/lm"}
    for parameter in other["parameters"]["of"].values():
        for mean in parameter["means"].values():
            mean["value"] = 4321
    document["cohort"]["populations"].append(other)
    file.write_text(json.dumps(document))
    page.go("cohort", "results%2Fstrips")
    table = "return document.querySelector('[aria-label=\"Typical values\"]').textContent"
    before_choice = page.browser.run(table)
    for run, is_other in (("other/lm", True), (first["run"], False)):
        page.set("select", run)
        assert ("4321" in page.browser.run(table)) == is_other, page.browser.run(table)
    assert page.browser.run(table) == before_choice
    file.write_text(before)


def texts_survive_leaving(page, name):
    """Text that is not saved is there again after a walk to another step, and only until it is given up."""
    value = "return document.getElementById('text').value"
    page.go("history")
    page.go("file", name)
    before = page.browser.run(value)
    page.browser.run("const n = document.getElementById('text'); n.focus(); n.setSelectionRange(0, 0); document.execCommand('insertText', false, '// not yet saved\\n')")
    page.go("model", name)
    page.see(f"{name} is not saved")
    assert page.browser.run("const leaving = new Event('beforeunload', { cancelable: true }); dispatchEvent(leaving); return leaving.defaultPrevented"), "the tab is closed unasked"
    page.go("file", name)
    page.see("This text was left unsaved")
    assert page.browser.run(value) == "// not yet saved\n" + before
    page.click("Take the text of the file")
    page.until("return !document.body.innerText.includes('This text was left unsaved')")
    assert page.browser.run(value) == before
    assert not page.browser.run("const leaving = new Event('beforeunload', { cancelable: true }); dispatchEvent(leaving); return leaving.defaultPrevented")
