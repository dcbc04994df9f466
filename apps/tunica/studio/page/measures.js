// SPDX-License-Identifier: Apache-2.0
// Pictures of what a stress, a strain or a column means: a strip at rest, dashed, and as it is pulled.
import { draw, el, newId } from "./dom.js";

const text = (x, y, words, anchor = "middle") => draw("text", { x, y, "text-anchor": anchor }, words);
const arrow = (x0, y, x1) => { const d = Math.sign(x1 - x0) * 5; return draw("path", { class: "arrow", d: `M${x0} ${y}H${x1}m${-d} -4l${d} 4l${-d} 4` }); };
const span = (x0, x1, y, words) => [draw("path", { class: "span", d: `M${x0} ${y - 3}v6M${x0} ${y}H${x1}M${x1} ${y - 3}v6` }), text((x0 + x1) / 2, y + 13, words)];
const rest = (x, y, w, h, own = "") => draw("rect", { class: `rest ${own}`, x, y, width: w, height: h });
const pulled = (x, y, w, h, own = "") => draw("rect", { class: `pulled ${own}`, x, y, width: w, height: h });
const svg = (label, height, ...parts) => draw("svg", { class: "meaning", viewBox: `0 0 170 ${height}`, role: "img", "aria-label": label }, parts.flat());

const strip = (...more) => [rest(45, 14, 60, 34), pulled(45, 19, 84, 24), arrow(45, 31, 18), arrow(129, 31, 156), text(12, 24, "F"), text(162, 24, "F"), ...more.flat()];
const section = (x, y, h, words) => [draw("rect", { class: "section", x, y, width: 5, height: h }), text(x + 2, 62, words)];

export const stressMeasures = {
  cauchy: { words: "true stress (Cauchy)", formula: "F / a, the section as it is now", draw: () => svg("True stress: force over the section of the pulled strip", 70, strip(section(92, 19, 24, "a"))) },
  first_piola_kirchhoff: { words: "nominal stress (over the section at rest)", formula: "F / A, the section at rest", draw: () => svg("Nominal stress: force over the section of the strip at rest", 70, strip(section(92, 14, 34, "A"))) },
  second_piola_kirchhoff: { words: "second Piola–Kirchhoff stress", formula: "F / (A λ), with the stretch λ", draw: () => svg("Second Piola–Kirchhoff stress: force over the section at rest times the stretch", 70, strip(section(92, 14, 34, "A λ"))) }
};
export const strainMeasures = {
  engineering: { words: "engineering strain", formula: "ΔL / L = λ − 1", draw: () => svg("Engineering strain: elongation over the length at rest", 78, [strip(span(45, 105, 60, "L")), span(105, 129, 60, "ΔL")]) },
  true: { words: "true strain", formula: "ln λ", draw: () => svg("True strain: logarithm of the length over the length at rest", 78, strip(span(45, 129, 60, "ln (l / L)"))) },
  green: { words: "Green strain", formula: "(λ² − 1) / 2", draw: () => svg("Green strain: half of the squared stretch less one", 78, strip(span(45, 129, 60, "(l² / L² − 1) / 2"))) }
};

/** Of a stress measure by its code; undefined for others. */
export const picture = (measure) => stressMeasures[measure]?.draw();

/** One of several by radio buttons with a picture each. {node, value} as a select has it; "" is the first. */
export function pictured(name, option, first, list, changed) {
  const group = newId(), boxes = new Map();
  const one = (value, words, formula, drawing) => {
    const box = el("input", { type: "radio", name: group, value, checked: value === "", onchange: changed });
    boxes.set(value, box);
    return el("label", { class: "meaning-choice" }, drawing ?? "", el("span", {}, box, words), formula ? el("small", {}, formula) : "");
  };
  const node = el("fieldset", { "data-option": option }, el("legend", {}, name), el("div", { class: "meanings" }, one("", first), Object.entries(list).map(([value, about]) => one(value, about.words, about.formula, about.draw()))));
  return { node, get value() { return [...boxes].find(([, box]) => box.checked)?.[0] ?? ""; } };
}

/** What a column can mean, all in two pictures. */
export const columnMeanings = () => el("details", {}, el("summary", {}, "What a column can mean"), el("div", { class: "meanings" },
  el("figure", {}, svg("A strip: force F, displacement u, length at rest L, length l", 92, [strip(span(45, 105, 60, "L"), span(105, 129, 60, "u"), span(45, 129, 78, "l"))]),
    el("figcaption", {}, el("small", {}, "force F · displacement u · length l · stretch λ = l / L · strain, stress: choose the measure above"))),
  el("figure", {}, svg("A tube: pressure p inside, outer diameter d, axial force F", 92, [
    draw("path", { class: "pulled", d: "M30 20H140V34H30ZM30 58H140V72H30Z" }), draw("path", { class: "rest", d: "M30 20H140V72H30Z" }), text(85, 50, "p"),
    draw("path", { class: "span", d: "M152 20v52M148 20h8M148 72h8" }), text(162, 50, "d"), arrow(30, 46, 8), text(14, 40, "F")]),
    el("figcaption", {}, el("small", {}, "pressure p · outer diameter d · axial force F · time")))));
