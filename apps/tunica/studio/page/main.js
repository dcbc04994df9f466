// SPDX-License-Identifier: Apache-2.0
// One page a hash: #/, #/history, #/data/FILE, #/model/EXPERIMENT, #/fit/…, #/causes/…, #/file/EXPERIMENT, #/cohort/RESULT, #/sheet/RESULT.
import { causesPage } from "./causes.js";
import { cohortPage } from "./cohort.js";
import { dataPage } from "./data.js";
import { el, problem } from "./dom.js";
import { editorPage } from "./editor.js";
import { fitPage } from "./fit.js";
import { historyPage } from "./history.js";
import { materialPage } from "./material.js";
import { project, unfollow } from "./server.js";
import { sheetPage } from "./sheet.js";
import { startPage } from "./start.js";

const pages = { "": startPage, data: dataPage, model: materialPage, fit: fitPage, causes: causesPage, history: historyPage,
  cohort: cohortPage, sheet: sheetPage, file: editorPage };
const steps = [["model", "Material"], ["fit", "Fit"], ["causes", "What is wrong"]];
let leave = null, before = null;

function stepsOf(kind, name) {
  if (kind === "data") return el("nav", { "aria-label": "Steps" }, el("ol", { class: "steps" }, el("li", {}, el("a", { href: location.hash, "aria-current": "step" }, el("b", {}, "1"), "Data"))));
  if (!name || !steps.some(([step]) => step === kind)) return "";
  return el("nav", { "aria-label": "Steps" }, el("ol", { class: "steps" }, steps.map(([step, title], k) =>
    el("li", {}, el("a", { href: `#/${step}/${encodeURIComponent(name)}`, "aria-current": step === kind ? "step" : null }, el("b", {}, k + 2), title))),
    el("li", {}, el("a", { href: "#/history" }, el("b", {}, "5"), "Compare and take away"))));
}

let turn = 0;
async function show() {
  const mine = ++turn;
  leave?.();
  leave = null;
  unfollow();
  const [, kind = "", coded = ""] = location.hash.match(/^#\/(\w*)\/?(.*)$/) ?? [];
  const name = decodeURIComponent(coded), place = document.getElementById("content");
  const shown = el("div");
  try {
    const all = await project();
    if (mine !== turn) return;
    document.getElementById("where").textContent = `Project ${all.folder} · tunica ${all.version}`;
    document.getElementById("steps").replaceChildren(stepsOf(kind, name));
    document.querySelectorAll("header nav a").forEach((link) =>
      link.toggleAttribute("aria-current", link.getAttribute("href") === (kind === "history" ? "#/history" : kind === "" ? "#/" : "")));
    const left = await (pages[kind] ?? startPage)(shown, all, name);
    if (mine !== turn) return left?.();
    leave = left ?? null;
  } catch (error) {
    shown.append(problem(error.message));
  }
  if (mine !== turn) return;
  place.replaceChildren(shown);
  const head = shown.querySelector("h1");
  if (head && before !== null && before !== location.hash && !shown.contains(document.activeElement)) {
    head.tabIndex = -1;  // a keyboard goes on from here, not from the top of the page
    head.focus({ preventScroll: true });
  }
  before = location.hash;
  document.title = head ? `${head.textContent} – tunica studio` : "tunica studio";
  document.documentElement.dataset.shown = location.hash;
}

addEventListener("hashchange", show);
export const again = show;
show();
