// SPDX-License-Identifier: Apache-2.0
// What the file may say that is not so, asked before any cause in the material or the rig: another stress measure, a unit,
// a direction. Each with what it gains, and a button that takes it so in a copy of the file.
import { attempt, el, panel, put, shell } from "./dom.js";
import { patched } from "./edits.js";
import { newest, watchJob } from "./jobs.js";
import { picture } from "./measures.js";
import { ask, project, result, save } from "./server.js";
import { number, plain, quoted, verdicts } from "./words.js";

/** The measure that a mend writes, for its picture. */
const measureOf = (one) => one.changes?.find((change) => change.path.endsWith("/stress_measure"))?.value;

/** Whether the diagnosis asks for a mistake of the file before any cause: by its likelihood, or because it takes most of the misfit. */
export const asksFile = ({ file, reason_codes = [] }) =>
  ["near", "ahead"].includes(file?.standing) || reason_codes.some((code) => code === "file_as_likely" || code === "file_suspected");

/** What a page says first of a diagnosis. A tie with the file is a question, and no tie of causes. */
export const headingOf = (diagnosis) =>
  diagnosis.verdict === "indistinguishable" && asksFile(diagnosis) ? "Does the file say what is so?" : verdicts[diagnosis.verdict] ?? plain(diagnosis.verdict);

/** How many times better a diagnosis fits with a mistake mended. */
export const gainOf = (diagnosis, one) => (diagnosis.base?.squares ?? 0) / one.squares;

/** Mistakes of the file that gain something, the likeliest first. */
export const gaining = (diagnosis) =>
  (diagnosis.file?.causes ?? []).filter((one) => one.probability > 0.01 && gainOf(diagnosis, one) > 2 && !one.amplitudes?.every((size) => size === 0));

/** With a button where the diagnosis asks for it. */
function mistake(name, read, diagnosis, one) {
  const place = el("li", { class: "mistake" }, picture(measureOf(one)) ?? "", el("div", {}, el("strong", {}, `If ${one.sentence}, this fits ${number(gainOf(diagnosis, one), 2)} times better`), el("p", {}, el("small", {}, one.mend))));
  if (!one.changes || !asksFile(diagnosis)) return place; // without changes a column has to be changed, by hand
  place.append(el("button", { onclick: () => attempt(place, async () => {
    const { file } = await save(name, read, patched(read.document, one.changes), true);
    await ask("start", { verb: "run", experiment: file });
    location.hash = `#/fit/${encodeURIComponent(file)}`;
  }) }, "Take it so, and fit"));
  return place;
}

/** Those of a diagnosis that gain something, with a heading; nothing where there are none. */
export async function mistakesOf(name, diagnosis) {
  const list = gaining(diagnosis).slice(0, 5);
  if (!list.length) return "";
  const read = await ask("document", { file: name });
  return [el("h3", {}, "What the file may say that is not so"),
    asksFile(diagnosis) ? "" : el("p", { class: "muted" }, "The diagnosis does not ask for these: each leaves more than noise, or another cause is likelier."),
    el("ul", { class: "plain" }, list.map((one) => mistake(name, read, diagnosis, one)))];
}

export function readingsPanel(all, name) {
  const place = panel("Does the file say what is so?"), live = el("div"), found = el("div");
  const watch = (job) => watchJob(live, job, (last) => {
    if (last.state !== "done") return;
    live.replaceChildren();
    attempt(found, async () => {
      await project();
      const { diagnosis } = await result(last.folder), mistakes = await mistakesOf(name, diagnosis);
      put(found, mistakes || el("p", {}, diagnosis.file?.causes?.length ? "No other reading of the file fits twice as well." : "Nothing that the model misses asks for another reading of the file."));
    });
  });
  place.append(el("p", {}, "Nominal stresses taken for true ones, a wrong unit, two directions exchanged: the model is fitted to each reading, before any cause in the material is looked for."),
    el("div", { class: "row" }, el("button", { onclick: () => attempt(found, async () => { found.replaceChildren(); watch(await ask("start", { verb: "diagnose", experiment: name, readings: true })); }) }, "Try other readings")),
    live, found, shell(`tunica diagnose ${quoted(name)} --groups file --quick --no-discovery`));
  const last = newest(all, "diagnose", name, true);
  if (last) watch(last);
  return place;
}
