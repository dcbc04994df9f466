// SPDX-License-Identifier: Apache-2.0
// The project: what lies in the folder, and a place to drop files.
import { chart } from "./chart.js";
import { add, attempt, el, notice, panel, put, shell } from "./dom.js";
import { jobLine } from "./jobs.js";
import { ask, upload } from "./server.js";
import { axis, percent, plain, quoted, when } from "./words.js";

const to = (kind, name) => `#/${kind}/${encodeURIComponent(name)}`;

function dropZone() {
  const place = el("section", { class: "drop", "aria-label": "Files of a rig" });
  const take = (files) => attempt(place, async () => {
    const names = [];
    for (const file of files) names.push((await upload(file)).file);
    if (names.length === 0) return;
    notice(`${names.length === 1 ? names[0] : `${names.length} files`} saved in the project`);
    location.hash = to("data", names.join("\n"));
  });
  const input = el("input", { type: "file", multiple: true, id: "files", onchange: () => take(input.files) });
  place.append(el("p", {}, el("strong", {}, "Drop the files of your testing machine here")),
    el("p", { class: "muted" }, "Header lines, decimal commas and any units are fine. Several files become several tests."),
    el("p", {}, el("label", { for: "files" }, "or choose them: "), input));
  place.addEventListener("dragover", (event) => { event.preventDefault(); place.classList.add("over"); });
  place.addEventListener("dragleave", () => place.classList.remove("over"));
  place.addEventListener("drop", (event) => { event.preventDefault(); place.classList.remove("over"); take(event.dataTransfer.files); });
  return place;
}

const list = (items, empty) => items.length ? el("ul", { class: "plain" }, items) : el("p", { class: "muted" }, empty);

function resultLine(one) {
  const best = one.summary?.runs?.[0], rms = best?.rms ?? one.summary?.rms;
  return el("li", {}, el("a", { href: one.kind === "cohort" ? to("cohort", one.folder) : ["run", "diagnosis"].includes(one.kind) ? to("sheet", one.folder) : "#/history" }, one.folder), el("span", { class: "tag" }, one.kind),
    el("small", {}, rms === null || rms === undefined ? "" : rms === 0 ? "misses noise only · " : `misses by ${percent(rms)} of the range · `, when(one.written)));
}

const inSight = new IntersectionObserver((entries) => entries.forEach(({ target, isIntersecting }) => isIntersecting && target.begin?.()), { rootMargin: "300px" });

/** A worked case: what was measured, and what there is to learn. Its picture is drawn once it is in sight. */
function example(one, panel) {
  const place = el("div", { class: "tile-curve" });
  const node = el("li", { class: "tile" }, place, el("h3", {}, el("button", { class: "link", onclick: () => attempt(panel, async () => {
    const { file } = await ask("example", { name: one.name });
    location.hash = to("model", file);
  }) }, one.title)), el("p", {}, one.learnt));
  node.begin = async () => {
    node.begin = null;
    try {
      const curves = await ask("example_curves", { name: one.name }), first = curves[0], alike = curves.filter((curve) => curve.over === first.over && curve.observable === first.observable);
      put(place, chart({ title: "", x: axis(first.over), y: axis(first.observable, first.unit), height: 130, small: true,
        series: alike.map((curve, k) => ({ name: plain(curve.test), x: curve.x, y: curve.y, colour: k, points: true, tinted: true })) }).node);
    } catch {} // it has no picture then
  };
  inSight.observe(node);
  return node;
}

export async function startPage(place, all) {
  const interrupted = all.jobs.filter((job) => job.state === "running" || job.resumable);
  const examples = panel("Worked examples");
  add(examples, all.examples.length ? el("ul", { class: "grid gallery" }, all.examples.map((one) => example(one, examples))) : el("p", { class: "muted" }, "The examples of this installation were not found."));
  add(place, el("h1", {}, all.folder), dropZone(),
    interrupted.length ? panel("Running and interrupted", el("ul", { class: "plain" }, interrupted.map(jobLine))) : "",
    el("div", { class: "two" },
        panel("Experiments", list(all.experiments.map((name) => el("li", {}, el("a", { href: to("model", name) }, name))),
          "None yet. Drop files above, or open an example.")),
        el("div", {}, panel("Results", list(all.results.slice(0, 12).map(resultLine), "None yet.")),
          panel("Files of rigs", list(all.data.map((name) => el("li", {}, el("a", { href: to("data", name) }, name))), "None yet.")))),
    examples,
    all.complete ? "" : el("p", { class: "box bad" }, "The folder has more files than are listed here."),
    shell(`tunica studio ${quoted(all.path)}`));
}
