// SPDX-License-Identifier: Apache-2.0
// A cohort: a small picture of each specimen, drawn once it is in sight, sorted by misfit, and filtered by what became of it.
import { curvesOf, table } from "./curves.js";
import { add, choice, el, field, panel, put, shell } from "./dom.js";
import { reportLink } from "./jobs.js";
import { file, result } from "./server.js";
import { number, plain, quoted, unit } from "./words.js";

const outcomes = { fitted: "fitted", no_result: "no fit found", unreadable: "not readable", failed: "ended with an error" };
const contradictions = { not_seen: "lacks the common effect", other_size: "effect of another size", other_cause: "another cause", rest_is_left: "the cause leaves a rest", shows_effect: "wrong in this one only" };

/** {id, folder, row of specimens.csv, tags: [[code, words, bad]]} of each specimen, for one run. */
function specimensOf(document, rows, run) {
  const { diagnosis } = document, alarms = new Map((diagnosis?.specimens ?? []).map((id, k) => [id, diagnosis.p_values[k]]));
  const said = new Map((diagnosis?.contradictions ?? []).map((one) => [one.specimen, one]));
  const of = new Map(rows.filter((row) => row.run === run || row.run === "").map((row) => [row.specimen, row]));
  return document.cohort.specimens.map((one) => {
    const row = of.get(one.id) ?? {}, tags = [[one.outcome, outcomes[one.outcome] ?? plain(one.outcome), one.outcome !== "fitted"]];
    if (row.stable === "0") tags.push(["unstable", "unstable", true]);
    if (one.warnings.length) tags.push(["warnings", "with warnings", false]);
    if (alarms.has(one.id)) tags.push(alarms.get(one.id) < diagnosis.alpha ? ["alarm", "misses more than noise", true] : ["quiet", "misses noise only", false]);
    const other = said.get(one.id);
    if (other) tags.push([other.code, contradictions[other.code] ?? plain(other.code), true]);
    return { ...one, row, tags, misfit: row.misfit === "" || row.misfit === undefined ? null : Number(row.misfit), rest: row.least_r2 ? 1 - Number(row.least_r2) : null };
  });
}

/** Worst first; those without a number come first of all, for something is wrong with them. */
const worst = (key) => (a, b) => (b[key] ?? Infinity) - (a[key] ?? Infinity) || a.id.localeCompare(b.id);
const orders = { misfit: ["misfit over noise, worst first", worst("misfit")], rest: ["1 − R², worst first", worst("rest")], id: ["name", (a, b) => a.id.localeCompare(b.id, undefined, { numeric: true })] };

/** Tests and channels of a run, of the first specimen that has a fit of it: all have the same ones. */
export function testsOf(run) {
  let known, last = Promise.resolve();
  const own = async (folder) => (await result(folder)).runs.find((entry) => entry.run === run)?.best?.per_test;
  return (folder) => {
    const mine = last.then(async () => (known ??= await own(folder)));
    last = mine.catch(() => {}); // the next one asks for itself
    return mine;
  };
}

function tile(one, folder, run, tests) {
  const place = el("div", { class: "tile-curve" }), own = `${folder}/${one.folder}`;
  const node = el("li", { class: "tile", id: `specimen-${one.id}` }, el("h3", {}, one.outcome === "fitted" ? el("a", { href: `#/sheet/${encodeURIComponent(own)}` }, one.id) : one.id), place,
    el("p", {}, one.misfit !== null ? [el("strong", {}, number(one.misfit, 3)), " times the noise"] : one.rest !== null ? `R² ${number(1 - one.rest, 4)}` : ""),
    el("p", {}, one.tags.filter(([code]) => code !== "fitted").map(([, words, bad]) => [el("span", { class: `tag ${bad ? "bad" : ""}` }, words), " "])), one.reason ? el("p", { class: "reason" }, one.reason) : "");
  node.begin = async () => {
    node.begin = null;
    if (one.outcome !== "fitted") return;
    try {
      put(place, (await curvesOf(own, run, await tests(own), { small: true, height: 130 }))[0] ?? el("small", {}, "no fit of this run"));
    } catch (error) {
      put(place, el("small", {}, error.message));
    }
  };
  return node;
}

function populationTable(population) {
  const rows = Object.entries(population?.parameters?.of ?? {}).flatMap(([name, one]) => Object.entries(one.means).map(([group, mean]) => [name, group, mean, one.unit]));
  if (!rows.length) return "";
  return el("details", {}, el("summary", {}, "What they have in common"), el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Typical values" }, el("table", {}, el("thead", {}, el("tr", {},
    ["Parameter", "Group", "Typical value", "95 % interval"].map((text) => el("th", { scope: "col" }, text)))), el("tbody", {}, rows.map(([name, group, mean, own]) => el("tr", {}, el("th", { scope: "row" }, name), el("td", {}, group),
    el("td", { class: "n" }, `${number(mean.value)}${unit(own)}`), el("td", { class: "n" }, mean.ci95 ? `${number(mean.ci95[0])} … ${number(mean.ci95[1])}` : "–")))))));
}

export async function cohortPage(place, all, folder) {
  const [document, text] = await Promise.all([result(folder), file(`${folder}/specimens.csv`)]);
  if (!document.cohort) throw new Error(`${folder} holds no cohort; open it from the history`);
  const rows = table(text), runs = document.cohort.populations.map((one) => one.run), grid = el("ul", { class: "grid" }), common = el("div"), count = el("p", { role: "status" });
  const inSight = new IntersectionObserver((entries) => entries.forEach((entry) => entry.isIntersecting && entry.target.begin?.()), { rootMargin: "300px" });
  const known = specimensOf(document, rows, runs[0]).some((one) => one.misfit !== null);
  const run = choice(runs.map((one) => [one, one]), runs[0], { onchange: () => made() });
  const order = choice(Object.entries(orders).filter(([key]) => known || key !== "misfit").map(([key, [words]]) => [key, words]), known ? "misfit" : "rest", { onchange: () => arrange() });
  const filter = el("select", { onchange: () => arrange() });
  let specimens = [], tiles = new Map();
  function made() {
    specimens = specimensOf(document, rows, run.value);
    inSight.disconnect();
    const tests = testsOf(run.value);
    tiles = new Map(specimens.map((one) => [one, tile(one, folder, run.value, tests)]));
    tiles.forEach((node) => inSight.observe(node));
    put(common, populationTable(document.cohort.populations.find((one) => one.run === run.value)));
    const codes = new Map(specimens.flatMap((one) => one.tags).map(([code, words]) => [code, words])), chosen = filter.value;
    put(filter, el("option", { value: "" }, `all ${specimens.length}`), [...codes].map(([code, words]) =>
      el("option", { value: code }, `${words} (${specimens.filter((one) => one.tags.some(([own]) => own === code)).length})`)));
    if (codes.has(chosen)) filter.value = chosen;
    arrange();
  }
  function arrange() {
    const shown = specimens.filter((one) => !filter.value || one.tags.some(([code]) => code === filter.value)).sort(orders[order.value][1]);
    put(grid, shown.map((one) => tiles.get(one)));
    count.textContent = `${shown.length} of ${specimens.length} specimens`;
  }
  made();
  const { diagnosis } = document;
  add(place, el("h1", {}, `${document.name}: ${specimens.length} specimens`),
    document.warnings.length ? el("details", { class: "box bad" }, el("summary", {}, `${document.warnings.length} warnings`), el("ul", {}, document.warnings.map((line) => el("li", {}, line)))) : "",
    diagnosis ? panel("What the model gets wrong in all of them", diagnosis.sentences.map((words, k) => el("p", k ? {} : { class: "verdict" }, words))) : "",
    panel("Specimens", el("div", { class: "row" }, runs.length > 1 ? field("Run", run) : "", field("Sorted by", order), field("Show", filter), reportLink(folder, "Report of the cohort")), count, grid,
      common, shell(`tunica report ${quoted(folder)}`)));
  return () => inSight.disconnect();
}
