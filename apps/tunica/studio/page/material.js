// SPDX-License-Identifier: Apache-2.0
// Model and parameters: the curve follows the sliders before anything is fitted.
import { chart } from "./chart.js";
import { add, attempt, check, choice, el, field, notice, panel, problem, put, shell } from "./dom.js";
import { setModel, setParameters, setTests } from "./edits.js";
import { simulate } from "./live.js";
import { readingsPanel } from "./readings.js";
import { ask, save } from "./server.js";
import { latest, rested, sliders } from "./sliders.js";
import { axis, number, percent, plain, quoted, unit } from "./words.js";

const to = (kind, name) => `#/${kind}/${encodeURIComponent(name)}`;

function pictures(run) {
  return run.channels.map((channel) => chart({
    title: plain(channel.test), note: channel.rows > channel.x.length ? `${channel.x.length} of ${channel.rows} rows are drawn` : "",
    x: axis(channel.over, channel.over_unit), y: axis(channel.observable, channel.unit), height: run.channels.length > 2 ? 300 : 380,
    series: [{ name: channel.held_out ? "measured (partly held out)" : "measured", x: channel.x, y: channel.y, points: true },
      { name: "model", x: channel.x, y: [], colour: 0, breaks: channel.breaks, free: true }] }));
}

function modelPanel(name, run, file, catalogue, keepAs) {
  const { document } = file, models = catalogue.models, type = document.models[run.model]?.type, about = models.find((one) => one.name === type);
  const list = choice(models.map((one) => [one.name, plain(one.name)]), type), place = panel("Model");
  const required = about?.options?.length ? ` · options: ${about.options.map((one) => one.name).join(", ")}` : "";
  list.addEventListener("change", () => attempt(place, async () => {
    const changed = structuredClone(document);
    setModel(changed, run.entry, list.value, list.value === "ogden" ? { terms: 2 } : {});
    await keepAs(changed);
  }));
  add(place, field("Constitutive model", list), about ? el("p", {}, about.doc) : "", about ? el("p", {}, el("small", {}, about.reference, required)) : "");
  return place;
}

function testsPanel(name, run, file, keepAs) {
  const { document } = file, own = document.runs[run.entry].tests, place = panel("Tests");
  if (own && !Array.isArray(own)) return add(place, el("p", {}, "This run has tests of its own, which are changed in the file: ", Object.keys(own).map(plain).join(", ")));
  const all = Object.keys(document.tests), used = new Set(own ?? all);
  const rows = all.map((test) => {
    const on = check("fit", used.has(test)), out = check("hold out", document.tests[test].hold_out === true);
    const plainWeight = typeof (document.tests[test].weight ?? 1) === "number";
    const weight = el("input", { type: "number", class: "number", step: "any", min: 0, value: String(plainWeight ? document.tests[test].weight ?? 1 : ""), disabled: !plainWeight, "aria-label": `Weight of ${test}` });
    return { test, on: on.querySelector("input"), out: out.querySelector("input"), weight, node: el("li", {}, el("strong", {}, plain(test)), on, out, el("label", {}, "weight ", weight)) };
  });
  place.append(el("ul", { class: "plain" }, rows.map((row) => row.node)), el("button", { onclick: () => attempt(place, async () => {
    const changed = structuredClone(document);
    setTests(changed, run.entry, rows.filter((row) => row.on.checked).map((row) => row.test), new Set(rows.filter((row) => row.out.checked).map((row) => row.test)),
      new Map(rows.filter((row) => row.weight.value !== "" && Number(row.weight.value) !== (document.tests[row.test].weight ?? 1)).map((row) => [row.test, Number(row.weight.value)])));
    await keepAs(changed);
  }) }, "Use these tests"));
  return place;
}

/** Values that a fit has found, for the sliders; nothing without one. */
function fromResults(all, name, run, knobs) {
  const fits = all.results.filter((one) => one.experiment === name && one.kind === "run").flatMap((one) =>
    one.summary.runs.filter((entry) => entry.run.split("/")[0] === run.model && entry.parameters).map((entry) => [`${one.folder}: ${entry.run}`, entry.parameters]));
  if (!fits.length) return "";
  const list = choice([["", "the initial values"], ...fits.map(([title], k) => [String(k), title])], "", { "data-from": "" });
  list.addEventListener("change", () => knobs.set(list.value === "" ? Object.fromEntries(run.parameters.map((p) => [p.name, p.initial]))
    : Object.fromEntries(Object.entries(fits[Number(list.value)][1]).map(([key, one]) => [key, one.value]))));
  return field("Sliders at", list);
}

/** What `tunica check` says, asked once the page is there. */
async function checked(place, name) {
  try {
    const said = await ask("check", { file: name }), unfixed = new Set(said.problems.flatMap((one) => one.initial.identifiability ?? []));
    const understood = Object.values(said.understood).flat();
    add(place, el("p", {}, el("span", { class: `tag ${said.in_order ? "good" : "bad"}` }, said.in_order ? "in order" : "not in order")),
      said.warnings.length ? el("div", { class: "box bad" }, el("ul", {}, said.warnings.map((line) => el("li", {}, line)))) : "",
      understood.length ? el("ul", {}, understood.map((line) => el("li", {}, line))) : "",
      unfixed.size ? el("details", {}, el("summary", {}, "What the data do not fix at the initial values"), el("ul", {}, [...unfixed].map((line) => el("li", {}, line)))) : "");
  } catch (error) {
    place.append(problem(error.message));
  }
  place.append(shell(`tunica check ${quoted(name)}`));
}

export async function materialPage(place, all, name) {
  const [file, catalogue] = await Promise.all([ask("document", { file: name }), ask("catalogue")]);
  let gone = false, judged = null;
  /** Saves, and shows what was saved. Nothing is asked of the file in between: it may have other parameters by then. */
  const keepAs = async (changed) => {
    gone = true;
    await judged;
    const { file: saved } = await save(name, file, changed).catch((error) => {
      gone = false;
      throw error;
    });
    if (saved !== name) notice(`${name} stays as it is; the change is in ${saved}`);
    if (saved === name) dispatchEvent(new HashChangeEvent("hashchange")); else location.hash = to("model", saved);
  };
  const below = el("div");
  place.append(el("h1", {}, name), below);
  const problemOf = await attempt(below, () => ask("problem", { file: name }));
  const checks = panel("Check"), readings = readingsPanel(all, name);
  checked(checks, name);
  if (!problemOf) { place.append(checks, text(name, file)); return; }
  let run = problemOf.runs[0];
  const choose = problemOf.runs.length > 1 ? field("Run", choice(problemOf.runs.map((one) => [one.label, one.label]), run.label, { onchange: (event) => show(problemOf.runs.find((one) => one.label === event.target.value)) })) : "";
  const body = el("div");
  add(below, choose, body);
  function show(chosen) {
    run = chosen;
    const charts = pictures(run), quality = el("div", { class: "row", role: "status" }), failed = el("div"), stable = el("div", { class: "row", role: "status" }), objective = el("strong");
    const shown = (answer) => {
      put(failed, answer.failed ? problem(answer.failed) : "");
      if (answer.failed) return;
      answer.channels.forEach((values, k) => charts[k].set(1, values));
      objective.textContent = answer.objective === null ? "…" : number(answer.objective, 5);
      put(quality, el("span", {}, "objective ", objective), ...answer.quality.map((one, k) => one
        ? el("span", {}, plain(run.channels[k].test), " misses by ", el("strong", {}, percent(one.share)), ` of the range (RMSE ${number(one.rmse, 3)}${unit(run.channels[k].unit)})`) : ""));
    };
    const follow = latest((values) => simulate({ file: name, run: chosen.label, values }), shown, (error) => failed.replaceChildren(problem(error.message)));
    const judge = rested((values) => { if (!gone && run === chosen) judged = stability(values); });
    const stability = async (values) => {
      try {
        const said = await ask("judge", { file: name, run: chosen.label, values });
        objective.textContent = number(said.objective, 5);
        put(stable, el("span", { class: `tag ${said.stable === false ? "bad" : said.stable ? "good" : ""}` }, said.stable === false ? "unstable" : said.stable ? "stable" : "not judged"),
          el("details", {}, el("summary", {}, "Stability of the material"), el("ul", {}, said.sentences.map((line) => el("li", {}, line)))));
      } catch (error) {
        put(stable, el("small", {}, error.message));
      }
    };
    const moved = (values) => { if (!gone) follow(values); judge(values); };
    const knobs = sliders(run.parameters, moved), saving = el("div");
    moved(knobs.values);
    const keep = el("button", { onclick: () => attempt(saving, async () => {
      const changed = structuredClone(file.document);
      setParameters(changed, run.entry, run.parameters, knobs.values);
      await keepAs(changed);
    }) }, "Keep as initial values and bounds");
    put(body, el("div", { class: "wide" },
      el("div", { class: "sticky" }, modelPanel(name, run, file, catalogue, keepAs),
        panel("Parameters", fromResults(all, name, run, knobs), knobs.node, el("div", { class: "row" }, keep), saving,
          run.fixed.length ? el("p", {}, el("small", {}, "Held: ", run.fixed.map((one) => `${one.name} = ${number(one.value)}${unit(one.unit)}`).join(", "))) : "",
          el("p", {}, el("small", {}, "A shell simulates at the values that the file holds; keep those of the sliders first.")),
          shell(`tunica simulate ${quoted(name)} --model ${quoted(run.model)} -o predicted`))),
      el("div", {}, panel("Curve over the data", charts.map((one) => one.node), quality, stable, failed, el("div", { class: "row" }, el("a", { class: "button main", href: to("fit", name) }, "Next: fit"))),
        testsPanel(name, run, file, keepAs), readings, checks, text(name, file))));
  }
  show(run);
  return () => (gone = true);
}

const text = (name, file) => el("details", { class: "panel" }, el("summary", {}, "The experiment file"), el("p", {}, el("a", { class: "button", href: to("file", name) }, "Edit the file")), el("pre", { tabindex: 0 }, file.text));
