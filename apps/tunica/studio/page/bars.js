// SPDX-License-Identifier: Apache-2.0
import { draw, el } from "./dom.js";

/** Bars from zero, a share each: [{name, share, note, colour, from}]. */
export function bars(title, list) {
  const line = 34, width = innerWidth < 600 ? 400 : 640, name = width > 500 ? 230 : 120;
  const picture = draw("svg", { class: "bars", viewBox: `0 0 ${width} ${line * list.length + 6}`, role: "img",
    "aria-label": `${title}: ${list.map((one) => `${one.name} ${one.note}`).join("; ")}` });
  const largest = Math.max(...list.map((one) => Math.max(one.share + (one.from ?? 0), 0)), 1e-12);
  list.forEach((one, k) => {
    const scale = (width - name - (width > 500 ? 190 : 150)) / largest, from = name + (one.from ?? 0) * scale, long = Math.max(one.share * scale, 2);
    picture.append(draw("text", { x: name - 10, y: k * line + 22, "text-anchor": "end" }, one.name),
      draw("rect", { class: `bar s${one.colour ?? 1}`, x: from, y: k * line + 6, width: long, height: line - 12, rx: 3 }),
      draw("text", { x: from + long + 8, y: k * line + 22 }, one.note));
  });
  return el("figure", {}, el("figcaption", {}, title), picture);
}
