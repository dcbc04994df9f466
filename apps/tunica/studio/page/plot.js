// SPDX-License-Identifier: Apache-2.0
// What a chart draws on a canvas: scales, axes, lines and points of any number of rows.
import { number } from "./words.js";

export const margin = { left: 66, right: 14, top: 12, bottom: 46 };

/** Smallest and largest value of lists, with some room; of those above 0 for logarithms. */
export function extent(lists, log) {
  let low = Infinity, high = -Infinity;
  for (const values of lists) for (const v of values)
    if (v !== null && Number.isFinite(v) && (!log || v > 0)) { if (v < low) low = v; if (v > high) high = v; }
  if (low > high) return log ? [1, 10] : [0, 1];
  if (low === high) return log ? [low / 2, high * 2] : [low - (Math.abs(low) || 1) / 2, high + (Math.abs(high) || 1) / 2];
  const room = log ? 0 : 0.04 * (high - low);
  return [low - room, high + room];
}

function ticks([low, high], log, most) {
  const list = [];
  if (log) {
    const from = Math.ceil(Math.log10(low) - 1e-9), to = Math.floor(Math.log10(high) + 1e-9), step = Math.max(1, Math.ceil((to - from) / 6));
    for (let k = from; k <= to; k += step) list.push(10 ** k);
    return list.length > 1 ? list : [low, high];
  }
  const raw = (high - low) / most, power = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * (1 - 1e-9));
  for (let v = Math.ceil(low / step) * step; v <= high; v += step) list.push(Math.abs(v) < step * 1e-9 ? 0 : v);
  return list;
}

/** From values to pixels: {x(v), y(v), left, right, top, bottom, xs, ys, log}. */
export function scales(xs, ys, log, width, height, small) {
  const box = small ? { left: 40, right: 6, top: 6, bottom: 20 } : margin;
  const left = box.left, right = width - box.right, top = box.top, bottom = height - box.bottom, f = log ? Math.log : (v) => v;
  const [y0, y1] = ys.map(f), perX = (right - left) / (xs[1] - xs[0]), perY = (bottom - top) / (y1 - y0);
  return { left, right, top, bottom, xs, ys, log, small, x: (v) => left + (v - xs[0]) * perX, y: (v) => bottom - (f(v) - y0) * perY };
}

export function drawAxes(pen, scale, names, colours) {
  const { left, right, top, bottom, xs, ys, log, small } = scale, most = small ? 2 : 5;
  const font = small ? 10 : 12;
  pen.font = `${font}px system-ui, "Segoe UI", "DejaVu Sans", sans-serif`;
  pen.lineWidth = 1;
  pen.strokeStyle = colours.line;
  pen.fillStyle = colours.muted;
  pen.beginPath();
  pen.textAlign = "center";
  for (const v of ticks(xs, false, most)) {
    pen.moveTo(scale.x(v), top);
    pen.lineTo(scale.x(v), bottom);
    pen.fillText(number(v), scale.x(v), bottom + font + 4);
  }
  pen.textAlign = "end";
  for (const v of ticks(ys, log, most)) {
    pen.moveTo(left, scale.y(v));
    pen.lineTo(right, scale.y(v));
    pen.fillText(number(v, 3), left - 5, scale.y(v) + 4);
  }
  pen.stroke();
  pen.strokeStyle = colours.muted;
  pen.beginPath();
  pen.moveTo(left, top);
  pen.lineTo(left, bottom);
  pen.lineTo(right, bottom);
  pen.stroke();
  if (small) return;
  pen.textAlign = "center";
  pen.fillText(names.x, (left + right) / 2, bottom + 38);
  pen.save();
  pen.translate(14, (top + bottom) / 2);
  pen.rotate(-Math.PI / 2);
  pen.fillText(names.y, 0, 0);
  pen.restore();
}

function clip(pen, { left, right, top, bottom }) {
  pen.beginPath();
  pen.rect(left - 4, top - 4, right - left + 8, bottom - top + 8);
  pen.clip();
}

const drawable = (x, y, log) => x !== null && y !== null && Number.isFinite(x) && Number.isFinite(y) && !(log && y <= 0);

/**
 * A line. Rows that follow each other in one column of pixels become its first, lowest, highest and last one, which
 * covers the same pixels.
 */
export function drawLine(pen, scale, { x, y, breaks = [] }, colour, width = 2.2) {
  pen.save();
  clip(pen, scale);
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.lineJoin = "round";
  pen.beginPath();
  let column = NaN, low = 0, high = 0, last = 0, down = false, next = 0;
  const leave = () => {
    if (low === high) return;
    pen.lineTo(column, low);
    pen.lineTo(column, high);
    pen.lineTo(column, last);
  };
  for (let k = 0; k < y.length; ++k) {
    while (next < breaks.length && breaks[next] < k) ++next;
    if (!drawable(x[k], y[k], scale.log)) { if (down) leave(); down = false; continue; }
    const px = scale.x(x[k]), py = Math.min(Math.max(scale.y(y[k]), -2000), 4000);
    if (!down || breaks[next] === k) {
      if (down) leave();
      pen.moveTo(px, py);
      down = true;
    } else if (Math.abs(px - column) < 0.5) {
      if (py < low) low = py;
      if (py > high) high = py;
      last = py;
      continue;
    } else {
      leave();
      pen.lineTo(px, py);
    }
    column = px;
    low = high = last = py;
  }
  if (down) leave();
  pen.stroke();
  pen.restore();
}

/** Points, each pixel once; many of them are smaller. */
export function drawPoints(pen, scale, { x, y }, colour, small) {
  const many = y.length > 2000, radius = small ? 1.6 : many ? 1.5 : 3, wide = Math.ceil(scale.right) + 8, high = Math.ceil(scale.bottom) + 8;
  const taken = many ? new Uint8Array(wide * high) : null;
  pen.save();
  clip(pen, scale);
  pen.fillStyle = colour;
  pen.globalAlpha = 0.6;
  pen.beginPath();
  for (let k = 0; k < y.length; ++k) {
    if (!drawable(x[k], y[k], scale.log)) continue;
    const px = scale.x(x[k]), py = scale.y(y[k]);
    if (!(px > scale.left - 5 && px < scale.right + 5 && py > scale.top - 5 && py < scale.bottom + 5)) continue;
    if (!many) {
      pen.moveTo(px + radius, py);
      pen.arc(px, py, radius, 0, 7);
      continue;
    }
    const pixel = (py | 0) * wide + (px | 0);
    if (taken[pixel]) continue;
    taken[pixel] = 1;
    pen.rect(px - radius, py - radius, 2 * radius, 2 * radius);
  }
  pen.fill();
  pen.restore();
}
