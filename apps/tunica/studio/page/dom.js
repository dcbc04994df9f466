// SPDX-License-Identifier: Apache-2.0
// Elements from words. Text of others becomes text nodes and attributes, never markup.
const svg = "http://www.w3.org/2000/svg";

/** Lists within lists, and what is left out as null, false or "". */
const flat = (children) => children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false && child !== "");
export const add = (node, ...children) => { node.append(...flat(children)); return node; };
export const put = (node, ...children) => { node.replaceChildren(...flat(children)); return node; };

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (name in node && typeof value !== "string" && node.namespaceURI !== svg) node[name] = value;
    else node.setAttribute(name, value === true ? "" : value);
  }
  return add(node, children);
}

export const el = (tag, attributes = {}, ...children) => fill(document.createElement(tag), attributes, children);
export const draw = (tag, attributes = {}, ...children) => fill(document.createElementNS(svg, tag), attributes, children);

/** For screen readers only. */
export const unseen = (words) => el("span", { class: "unseen" }, words);

let ids = 0;
export const newId = () => `e${++ids}`;

/** A control under its name, with a hint that screen readers read too. */
export function field(name, control, hint = "") {
  control.id = control.id || newId();
  const about = hint ? el("small", { id: newId() }, hint) : null;
  if (about) control.setAttribute("aria-describedby", about.id);
  return el("div", { class: "field" }, el("label", { for: control.id }, name), control, about);
}

export function choice(options, chosen, attributes = {}) {
  const list = el("select", attributes);
  for (const [value, text] of options) list.append(el("option", { value, selected: value === chosen }, text));
  list.value = chosen;
  return list;
}

export const check = (name, checked, attributes = {}) =>
  el("label", {}, el("input", { type: "checkbox", checked, ...attributes }), name);

/** What the program says, as it says it. */
export const problem = (words) => el("div", { class: "box bad", role: "alert" }, el("pre", {}, words));
export const shell = (command) => el("p", { class: "shell" }, "In a shell: ", el("code", {}, command));
export const panel = (title, ...children) => {
  const head = el("h2", { id: newId() }, title);
  return el("section", { class: "panel", "aria-labelledby": head.id }, head, ...children);
};

let last = 0;
export function notice(words) {
  const place = document.getElementById("notice");
  place.textContent = words;
  clearTimeout(last);
  last = setTimeout(() => (place.textContent = ""), 6000);
}

/** Runs a step of the page; what fails is shown where it was asked for. */
export async function attempt(place, step) {
  place.querySelectorAll(":scope > .box.bad").forEach((box) => box.remove());
  try {
    return await step();
  } catch (error) {
    place.append(problem(error.message));
    return undefined;
  }
}
