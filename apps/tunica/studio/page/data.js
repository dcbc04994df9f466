// SPDX-License-Identifier: Apache-2.0
// `tunica import` as a form: what was understood of a rig's files, and what they do not say.
import { chart } from "./chart.js";
import { add, attempt, choice, el, field, panel, problem, put, shell } from "./dom.js";
import { columnMeanings, pictured, strainMeasures, stressMeasures } from "./measures.js";
import { ask } from "./server.js";
import { axis, plain, quoted, unit } from "./words.js";

const measures = Object.fromEntries(Object.entries(stressMeasures).map(([code, one]) => [code, one.words]));
const uses = ["force", "displacement", "stretch", "strain", "stress", "time", "pressure", "length", "outer_diameter", "axial_force"];

/** Texts that every file may need; [option, name, hint, choices]. */
const more = [
  ["area", "Area of the section", "in place of width and thickness, as 9 mm2"],
  ["diameter", "Diameter of a cylinder", "in place of width and thickness"],
  ["cycle", "Cycles to use", "last, all, none or a number"],
  ["branch", "Branch of the cycles", "", [["", "as the cycles suggest"], ["none", "both"], ["loading", "loading"], ["unloading", "unloading"]]],
  ["preload", "Preload at which the test begins", "as 0.05 N; cuts a slack beginning off"],
  ["direction", "Direction of the strip", "", [["", "not stated"], ["circumferential", "circumferential"], ["axial", "axial"]]],
  ["decimal", "Decimal mark", "", [["", "found in the file"], [".", "point"], [",", "comma"]]],
  ["skip-lines", "Lines above the header", "found in the file where it is empty"]
];

/** "10,5 mm" is 10.5 mm; "1,500 mm" may be 1.5 or 1500, and is left for the core to refuse. */
const pointed = (text) => text.replace(/^(-?\d+),(\d{1,2}|\d{4,})(?=\D|$)|^(-?0),(\d+)/, (all, a, b, c, d) => `${a ?? c}.${b ?? d}`);

export async function dataPage(place, all, name) {
  const files = name.split("\n"), catalogue = await ask("catalogue");
  const texts = new Map(), asked = new Map(), used = new Map(), units = new Map();
  const questions = el("div"), meanings = el("div"), columns = el("div", { class: "scroll" }), pictures = el("div"), understood = el("div"), command = el("div"), failed = el("div");

  const request = () => ({
    files,
    answers: {
      ...Object.fromEntries([...texts].map(([option, control]) => [option, control.value.trim()]).filter(([, text]) => text)),
      column: [...used].filter(([, control]) => control.value).map(([column, control]) => `${control.value}=${column}`),
      unit: [...units].filter(([, control]) => control.value.trim()).map(([column, control]) => `${column}=${control.value.trim()}`),
      compression: compression.value ? [compression.value] : []
    },
    asked: Object.fromEntries([...asked].filter(([, one]) => one.shown && one.control.value.trim()).map(([option, one]) => [option, pointed(one.control.value.trim())])),
    output: output.value.trim()
  });

  function showQuestions(all) {
    const list = all.filter((one) => !/^--str(ess|ain)-measure/.test(one.option)); // they have pictures
    for (const one of asked.values()) one.shown = false;
    for (const question of list) {
      if (!asked.has(question.option)) {
        const control = el("input", { type: "text", value: question.likely ? question.example : "", placeholder: question.example, oninput: soon, "data-option": question.option });
        const sentence = question.text.replace(/;[^;]*--.*$/, "").replace(", with its unit", "");
        asked.set(question.option, { control, node: field(sentence, control, question.length ? `with its unit, as ${question.example}` : "") });
      }
      asked.get(question.option).shown = true;
    }
    const nodes = [...asked.values()].filter((one) => one.shown).map((one) => one.node);
    if (nodes.some((node, k) => questions.children[k] !== node) || questions.children.length !== nodes.length) {
      const focused = document.activeElement;
      questions.replaceChildren(...nodes);
      if (questions.contains(focused)) focused.focus();
    }
    if (!nodes.length) questions.replaceChildren(list.length < all.length ? el("p", {}, "Say which one the file holds:") : el("p", { class: "muted" }, "The files say everything that is needed."));
  }

  function showColumns(list) {
    if (columns.firstChild || !list) return;
    columns.append(el("table", {}, el("thead", {}, el("tr", {}, ["Column", "First cells", "Taken for", "Use as", "Unit"].map((text) => el("th", { scope: "col" }, text)))),
      el("tbody", {}, list.map((one) => {
        used.set(one.name, choice([["", "as found"], ...uses.map((use) => [use, plain(use)])], "", { "aria-label": `Use ${one.title} as`, onchange: soon }));
        units.set(one.name, el("input", { type: "text", size: 6, placeholder: one.unit, "aria-label": `Unit of ${one.title}`, oninput: soon }));
        return el("tr", {}, el("th", { scope: "row" }, one.title), el("td", {}, el("small", {}, one.preview.join("  "))), el("td", {}, one.kind || "–"), el("td", {}, used.get(one.name)), el("td", {}, units.get(one.name)));
      }))));
  }

  /** What a file holds is asked where it holds it: a stress, or a strain. */
  function showMeanings({ columns: list }) {
    const holds = (what) => list?.some((one) => (used.get(one.name)?.value || one.quantity || one.kind).includes(what));
    const wanted = [holds("stress") ? stress.node : null, holds("strain") ? strain.node : null].filter(Boolean);
    if (wanted.length !== meanings.children.length || wanted.some((node, k) => meanings.children[k] !== node)) put(meanings, wanted);
  }

  function draw(look) {
    const curves = look.curves.map((one) => chart({
      title: plain(one.test), note: `${one.measure ? measures[one.measure] : plain(one.observable)}${look.provisional ? " · with example sizes until you give yours" : ""}`,
      x: axis(one.over, ""), y: axis(one.observable, one.unit), series: [{ name: "measured", x: one.x, y: one.y, points: true }] }).node);
    const raw = look.signals.map((signal) => el("details", {}, el("summary", {}, `As it stands in ${signal.file}`), signal.columns.map((column) => chart({
      title: column.title, x: signal.clock.title, y: column.title, height: 240,
      series: [{ name: column.title, x: signal.clock.values, y: column.values, colour: 1 }] }).node)));
    put(pictures, curves, raw);
    put(understood, look.last_cycle_only ? cycles() : "",
      look.understood?.length ? el("ul", {}, look.understood.map((line) => el("li", {}, line))) : "",
      look.warnings?.length ? el("div", { class: "box bad" }, el("ul", {}, look.warnings.map((line) => el("li", {}, line)))) : "",
      look.notes?.length ? el("details", {}, el("summary", {}, "Notes on the files"), el("ul", {}, look.notes.map((line) => el("li", {}, line)))) : "");
    failed.replaceChildren(look.problem ? problem(look.problem) : "");
    command.replaceChildren(shell(look.command + (output.value.trim() ? ` -o ${quoted(output.value.trim())}` : "")));
    write.disabled = Boolean(look.problem);
    document.documentElement.dataset.looked = String(Number(document.documentElement.dataset.looked ?? 0) + 1);
  }

  /** Rows that were left out because they are other cycles: what they could show, and a way to take them. */
  function cycles() {
    const control = texts.get("cycle");
    if (control.value.trim()) return "";
    return el("div", { class: "box" }, el("p", {}, "The file has several cycles, and the last loading is taken. Softening, viscosity and a set that stays show in the whole history only: without it, the diagnosis may take them for faults of the rig."),
      el("button", { type: "button", onclick: () => { control.value = "all"; look(); } }, "Take all cycles"));
  }

  let timer = 0, turn = 0;
  const look = () => attempt(failed, async () => {
    const mine = ++turn, seen = await ask("look", request());
    if (mine !== turn) return;
    showColumns(seen.columns);
    showMeanings(seen);
    showQuestions(seen.questions);
    draw(seen);
  });
  function soon() { clearTimeout(timer); timer = setTimeout(look, 250); }

  const option = ([key, title, hint, choices]) => {
    const control = choices ? choice(choices, "", { onchange: soon }) : el("input", { type: "text", oninput: soon });
    control.dataset.option = key;
    texts.set(key, control);
    return field(title, control, hint);
  };
  const stress = pictured("Stresses in the file are", "stress-measure", "as the file says", stressMeasures, soon);
  const strain = pictured("Strains in the file are", "strain-measure", "as the file says", strainMeasures, soon);
  texts.set("stress-measure", stress);
  texts.set("strain-measure", strain);
  const compression = choice([["", "negative, or not stated"], ["positive", "positive"]], "", { onchange: soon });
  const output = el("input", { type: "text", placeholder: files[0].replace(/\.[^.]*$/, ".json"), oninput: soon });
  const write = el("button", { class: "main", onclick: () => attempt(failed, async () => {
    const { file } = await ask("import", request());
    location.hash = `#/model/${encodeURIComponent(file)}`;
  }) }, "Write the experiment");
  const kinds = (what) => [["", "as the columns suggest"], ...catalogue[what].map((one) => [one.name, plain(one.name)])];

  add(place, el("h1", {}, files.join(", ")), el("div", { class: "wide" },
    el("div", {}, panel("What the file does not say", questions, meanings,
        el("details", {}, el("summary", {}, "Section, stress, cycles, preload"), more.map(option), field("Sign of compression in the file", compression)),
        option(["test", "Test", "", kinds("tests")]), option(["model", "Model to begin with", "", kinds("models")]),
        field("Name of the experiment file", output), write, failed, command)),
    el("div", {}, panel("What was understood", pictures, understood), panel("Columns", columns, columnMeanings()))));
  await look();
}
