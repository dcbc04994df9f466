// SPDX-License-Identifier: Apache-2.0
// The diagnosis: budget, causes on the data, and accepting one.
import { bars } from "./bars.js";
import { add, attempt, check, el, panel, put, shell } from "./dom.js";
import { newest, reportLink, sheetLink, watchJob } from "./jobs.js";
import { asksFile, headingOf, mistakesOf } from "./readings.js";
import { ask, project, result } from "./server.js";
import { capitalised, counted, missed, number, percent, plain, quoted, unit } from "./words.js";

const groups = { material: 2, rig: 3, file: 4 };

export function budgetOf(budget, model) {
  if (!budget) return "";
  let before = budget.rms;
  const list = [{ name: `${plain(model)} alone`, share: budget.rms, note: missed(budget.rms), colour: 0 }];
  for (const step of budget.steps) {
    list.push({ name: `+ ${plain(step.id)}`, from: step.rms, share: Math.max(before - step.rms, 0), note: `−${percent(before - step.rms)} → ${missed(step.rms)}`, colour: groups[step.group] ?? 1 });
    before = step.rms;
  }
  return [budget.steps.length && budget.rms <= budget.tolerance ? el("p", {}, `${capitalised(plain(model))} alone misses less than the tolerance of ${percent(budget.tolerance)}. What follows is more than noise, but small.`) : "",
    bars("How much of the range is missed, and what takes it", list),
    el("p", {}, `Tolerance ${percent(budget.tolerance)} (${budget.tolerance_origin}): `, el("span", { class: `tag ${budget.adequate ? "good" : "bad"}` }, budget.adequate ? "reached" : "not reached"))];
}

export const causeLine = (one) => el("li", {}, el("div", {}, el("strong", {}, plain(one.id)), " ", el("span", { class: "tag" }, `in the ${one.group}`),
  " probability ", el("strong", {}, number(one.probability, 2)),
  one.amplitude ? el("span", {}, ` · ${one.amplitude.name} = ${number(one.amplitude.value)}${unit(one.amplitude.unit)}`, one.amplitude.ci95 ? ` (${number(one.amplitude.ci95[0])} … ${number(one.amplitude.ci95[1])})` : "") : "",
  el("p", {}, one.explanation)));

/** A file that the diagnosis wrote, to go on with. */
function accept(folder, entry, place) {
  const file = `${folder}/${entry.what}.json`, mended = entry.what === "mended";
  const start = (verb, page) => attempt(place, async () => {
    await ask("start", { verb, experiment: file });
    location.hash = `#/${page}/${encodeURIComponent(file)}`;
  });
  return el("div", { class: "row" }, el("button", { class: "main", onclick: () => (mended ? start("diagnose", "causes") : start("run", "fit")) },
    mended ? "Take the file as mended, and diagnose again" : "Accept: fit the extended model"), el("a", { href: `#/model/${encodeURIComponent(file)}` }, file));
}

async function found(folder, entry, name) {
  const { diagnosis, warnings } = await result(folder), place = el("div");
  const likely = diagnosis.causes ?? [], mistakes = await mistakesOf(name, diagnosis), first = asksFile(diagnosis);
  const rivals = likely.length && diagnosis.explanations?.length === 1 ? [] : diagnosis.explanations ?? []; // a single one stands under Causes
  add(place, el("p", { class: "verdict" }, headingOf(diagnosis)), [...(diagnosis.reasons ?? []), ...rivals].map((words) => el("p", {}, capitalised(/^\w+$/.test(words) ? plain(words) : words))),
    first ? mistakes : "", budgetOf(diagnosis.budget, diagnosis.base?.model ?? "the model"),
    diagnosis.admissibility?.where ? el("div", { class: "box bad" }, el("strong", {}, "Stability is lost: "), diagnosis.admissibility.where, diagnosis.admissibility.remedy ? `; ${plain(diagnosis.admissibility.remedy)} restores it` : "") : "",
    likely.length ? [el("h3", {}, "Causes"), el("ul", { class: "plain" }, likely.map(causeLine))] : "",
    first ? "" : mistakes, (entry?.leads_to ?? []).map((one) => accept(folder, one, place)),
    diagnosis.next_experiment?.description ? [el("h3", {}, "Next experiment"), el("p", {}, diagnosis.next_experiment.description)] : "",
    warnings?.length ? el("details", {}, el("summary", {}, counted(warnings.length, "warning")), el("ul", {}, warnings.map((line) => el("li", {}, line)))) : "",
    el("div", { class: "row" }, reportLink(folder), sheetLink(folder)));
  return place;
}

export async function causesPage(place, all, name) {
  const live = el("div", { class: "panel live" }), out = el("div"), said = el("div");
  let leave = null;
  const quick = check("quick: a first answer in a second", false), discover = () => start("discover");
  async function finished(folder) {
    const { results } = await project(), entry = results.find((one) => one.folder === folder);
    put(out, panel("What was found", entry?.kind === "diagnosis" ? await found(folder, entry, name) : [el("div", { class: "row" }, reportLink(folder)), (entry?.leads_to ?? []).map((one) => accept(folder, one, out))]));
  }
  const watch = (job) => {
    leave?.();
    leave = watchJob(live, job, (last) => last.state === "done" && attempt(out, () => finished(last.folder)));
  };
  const start = (verb) => attempt(said, async () => {
    out.replaceChildren();
    watch(await ask("start", { verb, experiment: name, quick: quick.querySelector("input").checked }));
  });
  place.append(el("h1", {}, name), panel("What is wrong", el("p", {}, "The diagnosis fits the model, asks whether the misfit is more than noise, and tries what could cause it: in the material, in the rig, and in what the file says."),
    el("div", { class: "row" }, el("button", { class: "main", onclick: () => start("diagnose") }, "Diagnose"), quick, el("button", { onclick: discover }, "Search for terms of the energy")), said,
    shell(`tunica diagnose ${quoted(name)}`)), live, out);
  const last = [newest(all, "diagnose", name), newest(all, "discover", name)].filter(Boolean).sort((a, b) => b.started - a.started)[0];
  if (last) watch(last);
  return () => leave?.();
}
