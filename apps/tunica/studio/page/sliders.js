// SPDX-License-Identifier: Apache-2.0
// Parameters as sliders. The curve is asked for only when the last answer has come.
import { el, newId } from "./dom.js";
import { number, unit } from "./words.js";

const steps = 1000;
const isLog = (p) => p.scale === "log" && p.min > 0;
const place = (p, value) => steps * (isLog(p) ? Math.log(value / p.min) / Math.log(p.max / p.min) : (value - p.min) / (p.max - p.min));
const value = (p, at) => isLog(p) ? p.min * (p.max / p.min) ** (at / steps) : p.min + (at / steps) * (p.max - p.min);
const clamp = (p, v) => Math.min(Math.max(v, p.min), p.max);

/** Sliders for `parameters`; `moved(values)` after every change. Returns {node, values, set(values), bounds()}. */
export function sliders(parameters, moved) {
  const values = parameters.map((p) => p.initial);
  const list = parameters.map((p, k) => {
    const id = newId();
    const range = el("input", { type: "range", id, min: "0", max: String(steps), step: "1", value: String(place(p, values[k])), "data-parameter": p.name });
    const typed = el("input", { type: "number", step: "any", class: "number", value: String(Number(values[k].toPrecision(5))), "aria-label": `Value of ${p.name}` });
    const low = el("input", { type: "number", step: "any", value: String(p.min), "aria-label": `Lower bound of ${p.name}` });
    const high = el("input", { type: "number", step: "any", value: String(p.max), "aria-label": `Upper bound of ${p.name}` });
    const show = () => {
      typed.value = String(Number(values[k].toPrecision(5)));
      range.value = String(place(p, values[k]));
      range.setAttribute("aria-valuetext", `${number(values[k])}${unit(p.unit)}`);
    };
    const bound = (input, key) => input.addEventListener("change", () => {
      const wanted = Number(input.value);
      const fits = input.value !== "" && Number.isFinite(wanted) && (key === "min" ? wanted < p.max : wanted > p.min) && !(p.scale === "log" && wanted <= 0);
      if (fits) p[key] = wanted;
      input.value = String(p[key]);
      p.changed = p.changed || fits;
      values[k] = clamp(p, values[k]);
      show();
      moved(values);
    });
    bound(low, "min");
    bound(high, "max");
    range.addEventListener("input", () => { values[k] = value(p, Number(range.value)); show(); moved(values); });
    typed.addEventListener("change", () => { if (typed.value !== "") values[k] = clamp(p, Number(typed.value)); show(); moved(values); });
    show();
    return { show, node: el("div", { class: "slider" }, el("label", { for: id }, p.name, el("small", {}, p.unit === "1" ? "" : p.unit, isLog(p) ? " · logarithmic" : "")),
      range, typed, el("div", { class: "ends" }, low, high)) };
  });
  return {
    node: el("div", {}, list.map((one) => one.node)), values,
    set(wanted) {
      parameters.forEach((p, k) => { if (Number.isFinite(wanted[p.name])) values[k] = clamp(p, wanted[p.name]); });
      list.forEach((one) => one.show());
      moved(values);
    }
  };
}

/** Calls `step(values)` once the values have rested for a while, ms. */
export function rested(step, patience = 250) {
  let timer = 0;
  return (values) => { clearTimeout(timer); timer = setTimeout(() => step([...values]), patience); };
}

/**
 * Calls `ask(values)` for the newest values only, one at a time, and `shown(answer)` in the next frame. Times are kept where
 * somebody measures: ms from the move to the drawn frame, to the answer, of the drawing, and of the prediction.
 */
export function latest(ask, shown, failed) {
  let wanted = null, busy = false, come = null;
  const draw = () => {
    const { answer, begun, at } = come, from = performance.now();
    come = null;
    shown(answer);
    const now = performance.now();
    window.tunicaFrames?.push({ frame: now - begun, answer: at - begun, drawing: now - from, server: answer.milliseconds });
  };
  const next = async () => {
    if (busy || wanted === null) return;
    busy = true;
    const [values, begun] = wanted;
    wanted = null;
    try {
      const answer = await ask(values);
      if (!come) requestAnimationFrame(draw);
      come = { answer, begun, at: performance.now() };
    } catch (error) {
      failed(error);
    }
    busy = false;
    next();
  };
  return (values) => { wanted = [[...values], performance.now()]; next(); };
}
