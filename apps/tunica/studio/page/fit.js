// SPDX-License-Identifier: Apache-2.0
// Optimisers by one click, the objective as it falls, and what came out.
import { chart } from "./chart.js";
import { attempt, check, el, panel, problem, put, unseen } from "./dom.js";
import { setRuns } from "./edits.js";
import { newest, reportLink, sheetLink, watchJob } from "./jobs.js";
import { simulate } from "./live.js";
import { ask, project, result, save, view } from "./server.js";
import { axis, number, percent, plain, unit } from "./words.js";

const known = { lm: ["Levenberg–Marquardt, 20 starts", { type: "ceres_lm", starts: 20 }], es: ["Evolution strategy", { type: "es" }] };

function parameterTable(run, parameters) {
  return el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `Parameters of ${run}` }, el("table", {}, el("thead", {}, el("tr", {},
    el("th", { scope: "col" }, "Parameter"), el("th", { scope: "col", class: "n" }, "Value"), el("th", { scope: "col", class: "n" }, "95 % interval"), el("th", { scope: "col" }, unseen("Bound")))),
    el("tbody", {}, Object.entries(parameters ?? {}).map(([name, one]) => el("tr", {}, el("th", { scope: "row" }, name), el("td", { class: "n" }, `${number(one.value, 5)}${unit(one.unit)}`),
      el("td", { class: "n" }, one.ci95 ? `${number(one.ci95[0])} … ${number(one.ci95[1])}` : "–"), el("td", {}, one.at_bound ? el("span", { class: "tag bad" }, "at its bound") : ""))))));
}

/** The curves of the best point, asked of the same function as the sliders are. */
async function fitted(name, run, best) {
  const { runs } = await ask("problem", { file: name }), one = runs.find((entry) => entry.label === run);
  if (!one) return "";
  const answer = await simulate({ file: name, run, values: one.parameters.map((p) => best[p.name]?.value ?? p.initial) });
  if (answer.failed) return problem(answer.failed);
  return one.channels.map((channel, k) => chart({ title: plain(channel.test), x: axis(channel.over, channel.over_unit), y: axis(channel.observable, channel.unit), height: 320,
    series: [{ name: "measured", x: channel.x, y: channel.y, points: true }, { name: run, x: channel.x, y: answer.channels[k], colour: 0, breaks: channel.breaks }] }).node);
}

function card(folder, place) {
  const target = el("select", { id: "card-target" }, ["febio", "abaqus", "ansys", "calculix", "lsdyna"].map((one) => el("option", { value: one }, one)));
  const units = el("select", { id: "card-units" }, ["mm-N-MPa", "m-N-Pa", "mm-mN-kPa"].map((one) => el("option", { value: one }, one)));
  const said = el("div");
  return el("div", {}, el("div", { class: "row" }, el("label", { for: target.id }, "Card for "), target, el("label", { for: units.id }, "in "), units,
    el("button", { onclick: () => attempt(said, async () => {
      const job = await ask("start", { verb: "export", folder, to: target.value, units: units.value });
      const file = job.output;
      watchJob(said, job, (last) => last.state === "done" && said.prepend(el("p", {}, el("a", { class: "button", href: view(file), download: file.split("/").pop() }, `Save ${file}`))));
    }) }, "Write the card")), said);
}

/** Those of starts that stopped at default bounds share a line: ten of them would hide the rest. */
function warned({ warnings = [], warning_details: details = [] }) {
  if (!warnings.length) return "";
  const line = (words) => el("li", {}, words), starts = details.length === warnings.length ? warnings.filter((_, k) => details[k].kind === "stopped_at_default_bound") : [];
  const folded = starts.length > 1 ? starts : [];
  return el("div", { class: "box bad" }, el("strong", {}, "Warnings"), el("ul", {}, warnings.filter((one) => !folded.includes(one)).map(line)),
    folded.length ? el("details", {}, el("summary", {}, `Starts stopped at default bounds, and a better point may lie beyond: ${folded.length} warnings`), el("ul", {}, folded.map(line))) : "");
}

/** What a run came to; also a part of the history. */
export async function outcome(folder, name) {
  const document = await result(folder), parts = [];
  parts.push(warned(document));
  for (const run of document.runs) {
    const size = run.best?.misfit_size;
    parts.push(el("h3", {}, run.run, " ", run.best?.stable === false ? el("span", { class: "tag bad" }, "unstable") : ""), el("p", {}, size ? [size.rms === 0 ? el("span", { class: "big" }, "nothing but noise is missed") : [el("span", { class: "big" }, percent(size.rms)), " of the range is missed beyond noise"]] : "", ` · objective ${number(run.best?.objective, 6)} · ${run.evaluations} evaluations · ${number(run.seconds, 2)} s`),
      el("p", { class: "muted" }, run.ending), run.best ? parameterTable(run.run, run.best.parameters) : "");
  }
  const first = document.ranking?.find((one) => one.rank === 1)?.run ?? document.runs[0]?.run, best = document.runs.find((run) => run.run === first)?.best;
  const curves = el("div", { class: "two" });
  if (best && name) parts.unshift(curves);
  if (best && name) attempt(curves, async () => curves.append(...[await fitted(name, first, best.parameters)].flat()));
  const files = Object.keys(best?.per_test ?? {}).map((test) => el("a", { class: "button", href: view(`${folder}/fit_${test}.csv`), download: `fit_${test}.csv` }, `fit_${test}.csv`));
  parts.push(el("div", { class: "row" }, reportLink(folder, "Report"), sheetLink(folder), files), card(folder),
    el("details", {}, el("summary", {}, "In Python"), el("pre", {}, `import tunica\nresult = tunica.open(${JSON.stringify(folder)})\nprint(result.best)`)));
  return parts;
}

export async function fitPage(place, all, name) {
  const read = await ask("document", { file: name }), { document } = read;
  const live = el("div"), out = el("div"), said = el("div");
  let leave = null;
  const asFile = el("input", { type: "radio", name: "what", id: "as-file", checked: true }), these = el("input", { type: "radio", name: "what", id: "these" });
  const boxes = Object.entries(known).map(([key, [title]]) => [key, check(title, true, { "data-optimizer": key, onchange: () => (these.checked = true) })]);
  const budget = el("input", { type: "number", class: "number", min: 10, step: 1, value: String(Math.min(document.stop?.max_evaluations ?? 20000, 20000)), onchange: () => (these.checked = true) });
  const watch = (job) => {
    leave?.();
    leave = watchJob(live, job, async (last) => {
      await project();
      if (last.state === "done" || last.state === "not_converged") await attempt(out, async () => finished(last.folder));
    });
  };
  async function finished(folder) {
    put(out, panel("What came out", await outcome(folder, name)), panel("Next", el("p", {}, "A fit that misses the data has a reason. The diagnosis looks for it in the material, the rig and the file."),
      el("a", { class: "button", href: `#/causes/${encodeURIComponent(name)}` }, "Find out what is wrong")));
  }
  const go = el("button", { class: "main", onclick: () => attempt(said, async () => {
    let file = name;
    if (these.checked) {
      const changed = structuredClone(document), chosen = boxes.filter(([, box]) => box.querySelector("input").checked).map(([key]) => [key, known[key][1]]);
      if (!chosen.length) throw new Error("no optimiser is chosen; tick one");
      setRuns(changed, chosen, Number(budget.value));
      ({ file } = await save(name, read, changed));
    }
    const job = await ask("start", { verb: "run", experiment: file });
    out.replaceChildren();
    if (file !== name) location.hash = `#/fit/${encodeURIComponent(file)}`;
    else watch(job);
  }) }, "Fit");
  const labels = (document.runs ?? []).map((run) => `${run.model ?? "layers"}/${run.optimizer}`).join(", ");
  place.append(el("h1", {}, name), panel("Fit", el("fieldset", {}, el("legend", {}, "Which searches"),
    el("div", {}, asFile, el("label", { for: asFile.id }, `as the file says: ${labels || "none"}`)),
    el("div", {}, these, el("label", { for: these.id }, "these too, added to the runs of the file, at equal budget")), el("div", { class: "row" }, boxes.map(([, box]) => box), el("label", {}, "at most ", budget, " evaluations each"))),
    el("div", { class: "row" }, go), said), live, out);
  const last = newest(all, "run", name);
  if (last) watch(last);
  live.className = "panel live";
  return () => leave?.();
}
