// SPDX-License-Identifier: Apache-2.0
// The experiment file as text: what may stand at the caret, what the program says of it, and saving.
import { completions } from "./completion.js";
import { add, attempt, el, newId, notice, panel, problem, put, shell } from "./dom.js";
import { ask, post } from "./server.js";
import { rested } from "./sliders.js";
import { quoted } from "./words.js";

const lineHeight = 20;
let schema = null;
const schemaOf = async () => (schema ??= await (await post("schema", {})).json());
/** Texts that nobody has saved, by file, with what the file was: they outlive the page of the editor, and come back with it. */
const unsaved = new Map();
addEventListener("beforeunload", (event) => { if (unsaved.size) event.preventDefault(); });

export async function editorPage(place, all, name) {
  const left = unsaved.get(name), read = left?.read ?? await ask("document", { file: name }), rules = await schemaOf();
  const area = el("textarea", { id: "text", spellcheck: false, wrap: "off", rows: 30, "aria-label": `Text of ${name}`, "aria-autocomplete": "list", autocomplete: "off", autocapitalize: "off" });
  const numbers = el("pre", { class: "numbers", "aria-hidden": "true" }), list = el("ul", { class: "options", role: "listbox", id: newId(), hidden: true, "aria-label": "What may stand here" });
  const about = el("p", { class: "muted", role: "status" }), said = el("div", { role: "status" }), failed = el("div");
  let offered = null, chosen = 0, wrong = null;
  area.value = left?.text ?? read.text;
  area.setAttribute("aria-controls", list.id);

  const lineOf = (offset) => { const before = area.value.slice(0, offset).split("\n"); return [before.length, before.at(-1).length]; };
  function goTo(line, column) {
    const lines = area.value.split("\n"), offset = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0) + column - 1;
    area.focus();
    area.setSelectionRange(offset, offset);
    area.scrollTop = Math.max((line - 8) * lineHeight, 0);
  }
  function showNumbers() {
    const count = area.value.split("\n").length;
    put(numbers, Array.from({ length: count }, (_, k) => el("span", { class: k + 1 === wrong ? "wrong" : null }, `${k + 1}\n`)));
    numbers.scrollTop = area.scrollTop;
  }
  const close = () => { list.hidden = true; offered = null; area.removeAttribute("aria-activedescendant"); about.textContent = "Ctrl+Space: what may stand here"; };
  function mark() {
    [...list.children].forEach((one, k) => one.setAttribute("aria-selected", String(k === chosen)));
    const one = list.children[chosen];
    area.setAttribute("aria-activedescendant", one.id);
    one.scrollIntoView({ block: "nearest" });
    about.textContent = offered.options[chosen].about;
  }
  function offer() {
    offered = completions(rules, area.value, area.selectionStart);
    if (!offered.options.length) return close();
    chosen = 0;
    put(list, offered.options.slice(0, 60).map((one, k) => el("li", { role: "option", id: newId(), onpointerdown: (event) => { event.preventDefault(); take(k); } }, one.label)));
    const [line, column] = lineOf(offered.from), pen = document.createElement("canvas").getContext("2d"), style = getComputedStyle(area);
    pen.font = style.font;
    list.style.setProperty("--left", `${Math.max(Math.min(parseFloat(style.paddingLeft) + column * pen.measureText("0").width - area.scrollLeft, area.clientWidth - 240), 0) + area.offsetLeft}px`);
    list.style.setProperty("--top", `${parseFloat(style.paddingTop) + line * lineHeight - area.scrollTop + 2}px`);
    list.hidden = false;
    mark();
  }
  function take(k) {
    const { from, to, options } = offered, one = options[k];
    area.focus();
    area.setSelectionRange(from, to);
    document.execCommand("insertText", false, one.insert); // so that undo knows it
    area.setSelectionRange(from + one.insert.length - one.back, from + one.insert.length - one.back);
    close();
    if (one.back) offer();
  }
  const proved = rested(async () => {
    const text = area.value;
    try {
      const found = await ask("proof", { file: name, text });
      if (text !== area.value) return;
      wrong = found.line;
      put(said, found.error ? el("div", { class: "box bad" }, el("pre", {}, found.error), found.line ? el("button", { onclick: () => goTo(found.line, found.column) }, `Go to line ${found.line}`) : "")
        : el("p", {}, el("span", { class: "tag good" }, "the program can read it")));
    } catch (error) {
      put(said, problem(error.message));
    }
    showNumbers();
  }, 500);

  const note = () => { if (area.value === read.text) unsaved.delete(name); else unsaved.set(name, { text: area.value, read }); };
  area.addEventListener("input", () => {
    note();
    showNumbers();
    proved([]);
    if (offered) offer();
  });
  area.addEventListener("scroll", () => { numbers.scrollTop = area.scrollTop; close(); });
  area.addEventListener("blur", close);
  area.addEventListener("keydown", (event) => {
    if (event.key === " " && event.ctrlKey) { event.preventDefault(); offer(); return; }
    if ((event.ctrlKey || event.metaKey) && event.key === "s") { event.preventDefault(); keep(false); return; }
    const at = area.selectionStart;
    if (event.key === '"' && area.value[at] === '"' && area.selectionEnd === at) { // it is there already
      event.preventDefault();
      area.setSelectionRange(at + 1, at + 1);
      close();
      return;
    }
    if (event.key === '"' && !offered) { // both quotation marks, and what may stand between them
      event.preventDefault();
      document.execCommand("insertText", false, '""');
      area.setSelectionRange(at + 1, at + 1);
      offer();
      return;
    }
    if (event.key === "Enter" && !offered) {
      const before = area.value.slice(0, area.selectionStart), indent = before.slice(before.lastIndexOf("\n") + 1).match(/^\s*/)[0] + (/[{[]\s*$/.test(before) ? "  " : "");
      event.preventDefault();
      document.execCommand("insertText", false, `\n${indent}`);
      return;
    }
    if (!offered) return;
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key], count = list.children.length;
    if (step) { chosen = (chosen + step + count) % count; mark(); event.preventDefault(); }
    else if (event.key === "Enter") { take(chosen); event.preventDefault(); }
    else if (event.key === "Escape") { close(); event.preventDefault(); }
    else if (["ArrowLeft", "ArrowRight", "Home", "End"].includes(event.key)) close();
  });
  const keep = (as_new) => attempt(failed, async () => {
    const text = area.value, { file } = await ask("save", { file: name, hash: read.hash, text, as_new });
    if (area.value === text) unsaved.delete(name);
    notice(file === name ? `${name} is saved` : `saved as ${file}`);
    if (file === name) { Object.assign(read, await ask("document", { file: name })); note(); } else location.hash = `#/file/${encodeURIComponent(file)}`;
  });
  add(place, el("h1", {}, name), panel("The experiment file", el("p", { class: "muted" }, "Comments are kept. Names and values that may stand at the caret come with a quotation mark, or with Ctrl+Space."),
    left ? el("div", { class: "box" }, el("p", {}, "This text was left unsaved."), el("button", { onclick: () => { unsaved.delete(name); dispatchEvent(new HashChangeEvent("hashchange")); } }, "Take the text of the file")) : "",
    el("div", { class: "editor" }, numbers, area, list), about, said, failed,
    el("div", { class: "row" }, el("button", { class: "main", onclick: () => keep(false) }, "Save"), el("button", { onclick: () => keep(true) }, "Save as a copy"), el("a", { class: "button", href: `#/model/${encodeURIComponent(name)}` }, "To the curves")),
    shell(`tunica check ${quoted(name)}`)));
  close();
  showNumbers();
  proved([]);
  return () => { if (unsaved.has(name)) notice(`${name} is not saved; its text is kept while this page is open, and comes back with the editor`); };
}
