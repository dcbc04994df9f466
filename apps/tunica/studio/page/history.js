// SPDX-License-Identifier: Apache-2.0
// What was tried, as a tree: an experiment, its results, what they led to.
import { add, attempt, el, panel, put, unseen } from "./dom.js";
import { outcome } from "./fit.js";
import { jobLine, reportLink, sheetLink, watchJob } from "./jobs.js";
import { ask, view } from "./server.js";
import { missed, number, plain, unit, verdicts, when } from "./words.js";

/** Rows in the order of the tree: {kind, depth, name, entry}. */
export function tree(all) {
  const parent = new Map(all.results.flatMap((entry) => entry.leads_to.map((one) => [one.file, entry.folder])));
  const rows = [], seen = new Set(), copies = Object.entries(all.copies).filter(([copy, original]) => all.experiments.includes(copy) && all.experiments.includes(original));
  function experiment(name, depth) {
    rows.push({ kind: "experiment", depth, name });
    for (const entry of [...all.results].reverse()) if (entry.experiment === name && !seen.has(entry.folder)) resultOf(entry, depth + 1);
    for (const [copy, original] of copies) if (original === name) experiment(copy, depth + 1);
  }
  function resultOf(entry, depth) {
    seen.add(entry.folder);
    rows.push({ kind: "result", depth, name: entry.folder, entry });
    for (const next of entry.leads_to) experiment(next.file, depth + 1);
  }
  for (const name of all.experiments) if (!parent.has(name) && !copies.some(([copy]) => copy === name)) experiment(name, 0);
  for (const entry of all.results) if (!seen.has(entry.folder)) resultOf(entry, 0);
  return rows;
}

function words(entry) {
  const best = entry.summary?.runs?.find((one) => one.rms === Math.min(...entry.summary.runs.map((run) => run.rms ?? Infinity))) ?? entry.summary?.runs?.[0];
  if (best) return [best.rms ?? null, `${best.run}: ` + Object.entries(best.parameters ?? {}).map(([name, one]) => `${name} ${number(one.value)}${unit(one.unit)}`).join(", ")];
  if (entry.kind === "diagnosis") return [entry.summary.rms, `${verdicts[entry.summary.verdict] ?? entry.summary.verdict}${entry.summary.causes?.length ? `: ${entry.summary.causes.map((one) => plain(one.id)).join(", ")}` : ""}`];
  if (entry.kind === "cohort") return [entry.summary.rms, `${entry.summary.fitted} of ${entry.summary.specimens} specimens fitted${entry.summary.verdict ? `; ${verdicts[entry.summary.verdict] ?? entry.summary.verdict}` : ""}`];
  return [null, entry.kind];
}

export async function historyPage(place, all) {
  const rows = tree(all), below = el("div"), boxes = new Map();
  const line = (row) => {
    const name = el("td", { class: `depth${Math.min(row.depth, 3)}` });
    if (row.kind === "experiment") {
      name.append(el("a", { href: `#/model/${encodeURIComponent(row.name)}` }, el("strong", {}, row.name)));
      return el("tr", {}, el("td"), name, el("td"), el("td"), el("td"), el("td"));
    }
    const [rms, text] = words(row.entry), box = el("input", { type: "checkbox", "aria-label": `Compare ${row.name}`, disabled: row.entry.kind === "unfinished" });
    boxes.set(row.name, box);
    name.append(row.name.replace(/^results\//, ""), " ", el("span", { class: "tag" }, row.entry.kind));
    return el("tr", {}, el("td", {}, box), name, el("td", { class: "n" }, missed(rms)), el("td", {}, text), el("td", {}, el("small", {}, when(row.entry.written))),
      el("td", {}, el("div", { class: "row" }, row.entry.report ? reportLink(row.name) : "", row.entry.kind === "cohort" ? el("a", { class: "button", href: `#/cohort/${encodeURIComponent(row.name)}` }, "Specimens") : "", ["run", "diagnosis"].includes(row.entry.kind) ? sheetLink(row.name) : "", row.entry.kind === "run" ? el("button", { onclick: () => attempt(below, async () => {
        put(below, panel(row.name, await outcome(row.name, row.entry.experiment))); below.scrollIntoView(); }) }, "Take away") : "")));
  };
  const compare = el("button", { onclick: () => attempt(below, async () => {
    const folders = [...boxes].filter(([, box]) => box.checked).map(([folder]) => folder);
    if (folders.length < 2) throw new Error("tick two results or more to compare them");
    const job = await ask("start", { verb: "report", folders }), file = job.output;
    watchJob(below, job, (last) => last.state === "done" && below.prepend(el("p", {}, el("a", { class: "button", href: view(file), target: "_blank", rel: "noopener" }, `Open ${file}`))));
  }) }, "Compare those that are ticked");
  add(place, el("h1", {}, "History"), rows.length ? panel("What was tried", el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Tree of experiments and results" }, el("table", {}, el("thead", {}, el("tr", {},
    [unseen("Compare"), "Experiment and results", "Misses", "What it found", "When", unseen("Files")].map((text) => el("th", { scope: "col" }, text)))), el("tbody", {}, rows.map(line)))), el("div", { class: "row" }, compare)) : el("p", { class: "muted" }, "Nothing yet."), below,
    all.jobs.length ? el("details", { class: "panel" }, el("summary", {}, "Every job, as a command"), el("ul", { class: "plain" }, all.jobs.map(jobLine))) : "");
}
