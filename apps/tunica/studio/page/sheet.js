// SPDX-License-Identifier: Apache-2.0
// A result on one sheet of paper: what was fitted, how well, with which parameters, or what is wrong. Printed, it is a PDF.
import { budgetOf, causeLine } from "./causes.js";
import { curvesOf } from "./curves.js";
import { add, el, put, shell } from "./dom.js";
import { asksFile, gaining, gainOf, headingOf } from "./readings.js";
import { result } from "./server.js";
import { capitalised, missed, number, percent, plain, quoted, unit } from "./words.js";

const most = { curves: 6, parameters: 16, warnings: 4, causes: 4 };
const head = (words) => el("thead", {}, el("tr", {}, words.map((text, k) => el("th", { scope: "col", class: k ? "n" : null }, text))));
const more = (list, limit, what) => (list.length > limit ? el("p", {}, el("small", {}, `and ${list.length - limit} more ${what}, see the report`)) : "");

function parametersOf(best) {
  const all = Object.entries(best.parameters ?? {});
  return [el("table", {}, head(["Parameter", "Value", "95 % interval"]), el("tbody", {}, all.slice(0, most.parameters).map(([name, one]) => el("tr", {}, el("th", { scope: "row" }, name),
    el("td", { class: "n" }, `${number(one.value, 5)}${unit(one.unit)}`, one.at_bound ? " (at its bound)" : ""), el("td", { class: "n" }, one.ci95 ? `${number(one.ci95[0])} … ${number(one.ci95[1])}` : "–"))))),
  more(all, most.parameters, "parameters")];
}

function runsOf(runs) {
  if (runs.length < 2) return "";
  return [el("h2", {}, "All searches"), el("table", {}, head(["Run", "Misses", "Objective", "Evaluations"]), el("tbody", {}, runs.slice(0, 8).map((run) => el("tr", {}, el("th", { scope: "row" }, run.run),
    el("td", { class: "n" }, missed(run.best?.misfit_size?.rms)), el("td", { class: "n" }, number(run.best?.objective, 5)), el("td", { class: "n" }, String(run.evaluations))))))];
}

async function ofRun(folder, document) {
  const name = document.ranking?.find((one) => one.rank === 1)?.run ?? document.runs[0]?.run, run = document.runs.find((one) => one.run === name), best = run?.best;
  if (!best) return [el("p", {}, run?.ending ?? "nothing was fitted")];
  const curves = el("div", { class: "curves" }), size = best.misfit_size, quality = Object.entries(best.per_test ?? {}).flatMap(([test, { channels }]) => channels.map((one) => [test, one]));
  const drawn = await curvesOf(folder, name, best.per_test, { height: quality.length > 4 ? 140 : quality.length > 2 ? 165 : 230 });
  put(curves, drawn.slice(0, most.curves));
  return [el("p", { class: "verdict" }, `${run.model ? plain(run.model) : "layers"}, ${plain(run.optimizer)}: `, size ? (size.rms === 0 ? "misses nothing but noise" : `misses by ${percent(size.rms)} of the range beyond noise`) : `objective ${number(best.objective, 5)}`,
    ` · ${best.stable === false ? "unstable" : best.stable ? "stable" : "stability not judged"}`), curves, more(drawn, most.curves, "curves"),
  el("div", { class: "two tables" }, el("div", {}, el("h2", {}, "Parameters"), parametersOf(best)), el("div", {}, el("h2", {}, "Agreement"), el("table", {}, head(["Test", "R²", "RMSE"]), el("tbody", {},
    quality.slice(0, 10).map(([test, one]) => el("tr", {}, el("th", { scope: "row" }, `${plain(test)}: ${plain(one.channel)}${one.held_out ? " (held out)" : ""}`), el("td", { class: "n" }, number(one.r2, 4)), el("td", { class: "n" }, `${number(one.rmse, 3)}${unit(one.unit)}`)))))),
  el("div", {}, runsOf(document.runs)))];
}

function ofDiagnosis({ diagnosis }) {
  const causes = diagnosis.causes ?? [], file = asksFile(diagnosis) ? gaining(diagnosis).slice(0, 3) : [];
  return [el("p", { class: "verdict" }, headingOf(diagnosis)), (diagnosis.reasons ?? []).slice(0, 3).map((words) => el("p", {}, capitalised(words))),
    budgetOf(diagnosis.budget, diagnosis.base?.model ?? "the model"),
    causes.length ? [el("h2", {}, "Causes"), el("ul", { class: "plain" }, causes.slice(0, most.causes).map(causeLine)), more(causes, most.causes, "causes")] : "",
    file.length ? [el("h2", {}, "What the file may say that is not so"), el("ul", {}, file.map((one) => el("li", {}, `${one.sentence}: fits ${number(gainOf(diagnosis, one), 2)} times better; write ${one.mend}`)))] : "",
    diagnosis.next_experiment?.description ? [el("h2", {}, "Next experiment"), el("p", {}, diagnosis.next_experiment.description)] : ""];
}

/** CSS pixels of a sheet of A4 within its margins. What is taller gets smaller. */
const tallest = 1000;
const fit = (sheet) => { sheet.style.zoom = 1; sheet.style.zoom = Math.min(1, tallest / sheet.offsetHeight); };

export async function sheetPage(place, all, folder) {
  const document = await result(folder), sheet = el("article", { class: "sheet" }), { provenance, warnings } = document;
  add(sheet, el("h1", {}, document.name), el("p", { class: "muted" }, [folder, provenance?.date, `tunica ${provenance?.tunica ?? all.version}`].filter(Boolean).join(" · ")),
    document.diagnosis ? ofDiagnosis(document) : document.runs?.length ? await ofRun(folder, document) : el("p", {}, "Nothing of this result fits on a sheet; see its report."),
    warnings?.length ? [el("h2", {}, "Warnings"), el("ul", {}, warnings.slice(0, most.warnings).map((line) => el("li", {}, el("span", { class: "clamp" }, line)))), more(warnings, most.warnings, "warnings")] : "");
  add(place, el("div", { class: "row noprint" }, el("button", { class: "main", onclick: () => print() }, "Print, or save as PDF"), el("a", { href: "#/history" }, "History"),
    el("small", {}, "One page; the browser's print dialogue saves it as PDF.")), sheet, shell(`tunica report ${quoted(folder)}`));
  const printed = () => fit(sheet);
  addEventListener("beforeprint", printed);
  return () => removeEventListener("beforeprint", printed);
}
