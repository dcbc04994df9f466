// SPDX-License-Identifier: Apache-2.0
// Lines and points on two canvases: axes and measured points lie below, curves that follow a slider above. A chart is drawn
// once it is in sight. It is moved by dragging, and zoomed by its buttons, by keys, and by the wheel once it is in focus.
import { el, newId } from "./dom.js";
import { drawAxes, drawLine, drawPoints, extent, scales } from "./plot.js";
import { number } from "./words.js";

const charts = new WeakMap();
const inSight = new IntersectionObserver((entries) => entries.forEach(({ target, isIntersecting }) => charts.get(target)?.seen(isIntersecting)), { rootMargin: "200px" });
const sized = new ResizeObserver((entries) => entries.forEach(({ target }) => charts.get(target)?.draw()));
const all = () => [...document.querySelectorAll(".chart")].map((one) => charts.get(one)).filter(Boolean);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => all().forEach((one) => one.draw()));
let onPaper = false;
const toPaper = (is) => { onPaper = is; document.documentElement.classList.toggle("paper", is); all().forEach((one) => one.draw(true)); };
addEventListener("beforeprint", () => toPaper(true));
addEventListener("afterprint", () => toPaper(false));

let dragged = null;
addEventListener("pointermove", (event) => {
  if (!dragged) return;
  dragged.move(event.clientX - dragged.from[0], event.clientY - dragged.from[1]);
  dragged.from = [event.clientX, event.clientY];
});
addEventListener("pointerup", () => (dragged = null));

function coloursOf(node) {
  const style = getComputedStyle(node), of = (name) => style.getPropertyValue(`--${name}`).trim();
  return { line: of("line"), muted: of("muted"), data: of("data"), series: [0, 1, 2, 3, 4].map((k) => of(`c${k}`)) };
}

/** "0.1 … 3" of the values of a list. */
function range(values) {
  let low = Infinity, high = -Infinity;
  for (const v of values) if (v !== null && Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
  return low > high ? "" : `${number(low)} to ${number(high)}`;
}

/**
 * series: [{name, x, y, points, colour (0 … 4; of points only where they are tinted), breaks: [row at which a new line begins], free: does not stretch the axes}].
 * Returns {node, series, set(k, y, xs), rescale()}: set() moves a series within the axes as they are.
 */
export function chart({ title, note = "", x, y, series, logY = false, height = 380, small = false }) {
  const below = el("canvas"), above = el("canvas"), back = below.getContext("2d"), front = above.getContext("2d");
  const measured = series.find((one) => one.points) ?? series[0];
  const place = el("div", { class: `chart${small ? " small" : ""}`, role: "img", id: newId(), tabindex: small ? null : "0",
    "aria-label": `${title ? `${title}: ` : ""}${y} over ${x}${measured ? `; ${measured.name}, ${measured.y.length} rows, ${range(measured.x)} and ${range(measured.y)}` : ""}` }, below, above);
  place.style.setProperty("--height", `${height}px`);
  let whole, view = null, scale = null, seen = false, stale = true, queued = false;

  const measure = () => { whole = [extent(series.map((s) => s.x), false), extent(series.filter((s) => !s.free).map((s) => s.y), logY)]; };
  function fit(canvas, pen, width, tall) {
    const ratio = (onPaper ? 3 : devicePixelRatio) || 1;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(tall * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(tall * ratio);
    }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, tall);
  }
  function lines(colours) {
    fit(above, front, place.clientWidth, place.clientHeight);
    series.forEach((one) => { if (!one.points) drawLine(front, scale, one, colours.series[one.colour ?? 0], small ? 1.5 : 2.2); });
  }
  function draw(now = false) {
    if (!seen && !now) { stale = true; return; }
    const width = place.clientWidth, tall = place.clientHeight;
    if (!width) return;
    stale = false;
    const colours = coloursOf(place), [xs, ys] = view ?? whole;
    scale = scales(xs, ys, logY, width, tall, small);
    fit(below, back, width, tall);
    drawAxes(back, scale, { x, y }, colours);
    series.forEach((one) => { if (one.points) drawPoints(back, scale, one, one.tinted ? colours.series[one.colour ?? 0] : colours.data, small); });
    lines(colours);
  }
  const soon = () => {
    if (queued) return;
    queued = true;
    requestAnimationFrame(() => { queued = false; draw(); });
  };
  measure();
  charts.set(place, { draw, seen(is) { seen = is; if (is && stale) draw(); } });
  inSight.observe(place);
  sized.observe(place);

  /** Keeps the values under a pixel, or in the middle, where they are. */
  function zoom(factor, px, py) {
    if (!scale) return;
    const [xs, ys] = view ?? whole, f = logY ? Math.log : (v) => v, back = logY ? Math.exp : (v) => v;
    const shareX = px === undefined ? 0.5 : (px - scale.left) / (scale.right - scale.left), shareY = py === undefined ? 0.5 : (scale.bottom - py) / (scale.bottom - scale.top);
    const about = ([low, high], share) => { const at = low + share * (high - low); return [at + (low - at) * factor, at + (high - at) * factor]; };
    const next = [about(xs, shareX), about(ys.map(f), shareY).map(back)];
    const wide = (next[0][1] - next[0][0]) / (whole[0][1] - whole[0][0]);
    if (wide < 1e-6) return;
    view = wide >= 1 ? null : next;
    place.classList.toggle("zoomed", view !== null);
    soon();
  }
  function move(dx, dy) {
    if (!view || !scale) return;
    const [xs, ys] = view, f = logY ? Math.log : (v) => v, back = logY ? Math.exp : (v) => v, [y0, y1] = ys.map(f);
    const byX = (-dx * (xs[1] - xs[0])) / (scale.right - scale.left), byY = (dy * (y1 - y0)) / (scale.bottom - scale.top);
    view = [xs.map((v) => v + byX), [y0 + byY, y1 + byY].map(back)];
    soon();
  }
  const reset = () => { view = null; place.classList.remove("zoomed"); soon(); };
  function interact() {
    place.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && document.activeElement !== place) return;
      event.preventDefault();
      const box = place.getBoundingClientRect();
      zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY / 200))), event.clientX - box.left, event.clientY - box.top);
    }, { passive: false });
    place.addEventListener("pointerdown", (event) => { dragged = { move, from: [event.clientX, event.clientY] }; });
    place.addEventListener("dblclick", reset);
    place.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] }[event.key];
      if (event.key === "+" || event.key === "=") zoom(0.7);
      else if (event.key === "-") zoom(1 / 0.7);
      else if (event.key === "0") reset();
      else if (step && view) move(...step);
      else return;
      event.preventDefault();
    });
  }
  const button = (sign, words, act) => el("button", { type: "button", "aria-label": `${words}: ${title}`, title: words, onclick: act }, sign);
  if (!small) interact();
  const many = series.filter((one) => !one.points).length > 1 || series.some((s) => s.points);
  const node = el("figure", {}, title ? el("figcaption", {}, title, note ? el("small", {}, note) : null) : null, place,
    small ? null : el("div", { class: "under" },
      many ? el("div", { class: "legend" }, series.map((one) => el("span", { class: `s${one.colour ?? 0}` }, one.points ? "● " : el("i"), one.name))) : el("span"),
      el("div", { class: "zoom" }, button("+", "Zoom in", () => zoom(0.6)), button("−", "Zoom out", () => zoom(1 / 0.6)), button("⤢", "Whole curve", reset))));
  return {
    node, series,
    rescale() { measure(); soon(); },
    set(k, values, xs) {
      series[k].y = values;
      if (xs) series[k].x = xs;
      if (seen && scale && !stale) lines(coloursOf(place)); else stale = true;
    }
  };
}
