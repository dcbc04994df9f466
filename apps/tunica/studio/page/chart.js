// SPDX-License-Identifier: Apache-2.0
// Lines and points in SVG, by hand: a curve that follows a slider is one attribute a frame.
import { draw, el } from "./dom.js";
import { number } from "./words.js";

/** On a narrow screen the picture is smaller, so that its words are not. */
const wide = () => (innerWidth < 600 ? 400 : 640);
let clips = 0;
const size = { height: 380, left: 66, right: 14, top: 12, bottom: 46 };

function extent(lists, log) {
  let low = Infinity, high = -Infinity;
  for (const values of lists) for (const v of values)
    if (v !== null && Number.isFinite(v) && (!log || v > 0)) { if (v < low) low = v; if (v > high) high = v; }
  if (low > high) return log ? [1, 10] : [0, 1];
  if (low === high) return log ? [low / 2, high * 2] : [low - (Math.abs(low) || 1) / 2, high + (Math.abs(high) || 1) / 2];
  const margin = log ? 0 : 0.04 * (high - low);
  return [low - margin, high + margin];
}

function ticks([low, high], log) {
  if (log) {
    const from = Math.ceil(Math.log10(low) - 1e-9), to = Math.floor(Math.log10(high) + 1e-9), step = Math.max(1, Math.ceil((to - from) / 6));
    const list = [];
    for (let k = from; k <= to; k += step) list.push(10 ** k);
    return list.length > 1 ? list : [low, high];
  }
  const raw = (high - low) / 5, power = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw);
  const list = [];
  for (let v = Math.ceil(low / step) * step; v <= high; v += step) list.push(Math.abs(v) < step * 1e-9 ? 0 : v);
  return list;
}

/**
 * series: [{name, x, y, points, colour (0 … 4), breaks: [row at which a new line begins]}]. Returns {node, set(k, y),
 * rescale()}: set() moves a series within the axes as they are.
 */
export function chart({ title, note = "", x, y, series, logY = false, height = size.height }) {
  const box = { ...size, width: wide(), height: Math.min(height, wide()) }, clip = `clip${++clips}`;
  const plot = draw("g", { "clip-path": `url(#${clip})` }), axes = draw("g");
  const picture = draw("svg", { class: "chart", viewBox: `0 0 ${box.width} ${box.height}`, role: "img", "aria-label": `${title}: ${y} over ${x}` }, draw("clipPath", { id: clip }, draw("rect", {
    x: box.left - 4, y: box.top - 4, width: box.width - box.left - box.right + 8, height: box.height - box.top - box.bottom + 8 })), axes, plot);
  let scaleX, scaleY;
  const marks = series.map((one) => draw("path", { class: `${one.points ? "point" : "line"} s${one.colour ?? 0}` }));
  plot.append(...marks);

  function path(one) {
    const parts = [], breaks = new Set(one.breaks ?? []);
    let pen = false;
    for (let k = 0; k < one.x.length; ++k) {
      const value = one.y[k];
      if (value === null || one.x[k] === null || !Number.isFinite(value) || (logY && value <= 0)) { pen = false; continue; }
      const px = scaleX(one.x[k]), py = Math.min(Math.max(scaleY(value), -2000), 4000);
      if (one.points) parts.push(`M${(px - 3).toFixed(1)} ${py.toFixed(1)}a3 3 0 1 0 6 0a3 3 0 1 0 -6 0`);
      else parts.push(`${pen && !breaks.has(k) ? "L" : "M"}${px.toFixed(1)} ${py.toFixed(1)}`);
      pen = true;
    }
    return parts.join("");
  }

  function rescale() {
    const [x0, x1] = extent(series.map((s) => s.x), false), [y0, y1] = extent(series.filter((s) => !s.free).map((s) => s.y), logY);
    const f = logY ? Math.log : (v) => v;
    scaleX = (v) => box.left + ((v - x0) / (x1 - x0)) * (box.width - box.left - box.right);
    scaleY = (v) => box.height - box.bottom - ((f(v) - f(y0)) / (f(y1) - f(y0))) * (box.height - box.top - box.bottom);
    const right = box.width - box.right, bottom = box.height - box.bottom;
    axes.replaceChildren(
      ...ticks([x0, x1], false).map((v) => [draw("line", { class: "grid", x1: scaleX(v), x2: scaleX(v), y1: box.top, y2: bottom }),
        draw("text", { x: scaleX(v), y: bottom + 17, "text-anchor": "middle" }, number(v))]).flat(),
      ...ticks([y0, y1], logY).map((v) => [draw("line", { class: "grid", x1: box.left, x2: right, y1: scaleY(v), y2: scaleY(v) }),
        draw("text", { x: box.left - 7, y: scaleY(v) + 4, "text-anchor": "end" }, number(v, 3))]).flat(),
      draw("path", { class: "axis", d: `M${box.left} ${box.top}V${bottom}H${right}` }),
      draw("text", { x: (box.left + right) / 2, y: box.height - 8, "text-anchor": "middle" }, x),
      draw("text", { x: 14, y: (box.top + bottom) / 2, "text-anchor": "middle", transform: `rotate(-90 14 ${(box.top + bottom) / 2})` }, y));
    series.forEach((one, k) => marks[k].setAttribute("d", path(one)));
  }
  rescale();

  const lines = series.filter((one) => !one.points);
  const node = el("figure", {}, el("figcaption", {}, title, note ? el("small", {}, note) : null), picture,
    lines.length > 1 || series.some((s) => s.points) ? el("div", { class: "legend" }, series.map((one) =>
      el("span", { class: `s${one.colour ?? 0}` }, one.points ? "● " : el("i"), one.name))) : null);
  return {
    node, series, rescale,
    set(k, values, xs) {
      series[k].y = values;
      if (xs) series[k].x = xs;
      marks[k].setAttribute("d", path(series[k]));
    }
  };
}

/** Bars from zero, a share each: [{name, share, note, colour}]. */
export function bars(title, list) {
  const line = 34, width = wide(), name = width > 500 ? 230 : 120;
  const picture = draw("svg", { class: "chart", viewBox: `0 0 ${width} ${line * list.length + 6}`, role: "img",
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
