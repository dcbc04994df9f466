// SPDX-License-Identifier: Apache-2.0
// What is under the pointer, what the keys reach, and the axes' part of a zoom.
"use strict";
tunicaReport.pointer = (() => {
  const {usable, text} = tunicaReport.specs;

  const words = (figure, series, row) => {
    const {chart} = figure;
    const name = series.name + (series.label ? ", " + series.label : "") + "\n";
    return name + chart.x.title + ": " + text(series.x[row]) + "\n" + chart.y.title + ": " + text(series.y[row]) +
        (series.low && usable(series.low[row]) ? "\n" + text(series.low[row]) + " … " + text(series.high[row]) : "");
  };

  const visible = (figure) => figure.chart.series.filter((series) => !figure.hidden.has(series.name) && !["band", "bars", "range"].includes(series.mark));

  const point = (figure, series, row) => {
    const view = figure.shown, [left, top] = figure.corner();
    const x = view.scale("x")(series.x[row]), y = view.scale("y")(series.y[row]);
    return {x, y, left: x + left, top: y + top, datum: {x: series.x[row], y: series.y[row]}};
  };

  const category = (figure, at) => {
    const {chart, shown: view} = figure, [left, top] = figure.corner();
    const band = view.scale("y"), step = view.signal("height") / chart.labels.length;
    const row = Math.floor(at.y / step);
    if (row < 0 || row >= chart.labels.length || !band) return figure.tell(null);
    let said = chart.labels[row];
    if (chart.kind === "heat") {
      const column = Math.floor(at.x / (view.signal("width") / chart.columns.length));
      if (column < 0 || column >= chart.columns.length) return figure.tell(null);
      said += " · " + chart.columns[column] + "\n" + chart.legend + ": " + text(chart.values[row][column]);
    } else {
      for (const series of visible(figure)) {
        const it = series.rows[row];
        if (it && it.note) said += "\n" + it.note;
        else if (it) said += "\n" + series.name + ": " + text(it.value) +
            (typeof it.low === "number" && !chart.bars ? " (" + text(it.low) + " … " + text(it.high) + ")" : "");
      }
    }
    figure.tell(said, {left: at.x + left, top: at.y + top});
  };

  const nearest = (figure, at) => {
    if (figure.chart.kind === "mesh") return tunicaReport.mesh.nearest(figure, at);
    if (figure.chart.kind !== "xy") return category(figure, at);
    let best = null, least = 40 * 40;
    for (const series of visible(figure))
      for (let row = 0; row < series.x.length; ++row) {
        if (!usable(series.x[row], figure.chart.x) || !usable(series.y[row], figure.chart.y)) continue;
        const there = point(figure, series, row), away = (there.x - at.x) ** 2 + (there.y - at.y) ** 2;
        if (away < least) { least = away; best = {series, row, there}; }
      }
    figure.tell(best && words(figure, best.series, best.row), best && best.there);
  };

  const invert = (figure, axis, pixels) => figure.shown.scale(axis).invert(pixels);

  const zoomTo = (figure, from, to) => figure.setZoom({
    xdom: [Math.min(from.x, to.x), Math.max(from.x, to.x)].map((p) => invert(figure, "x", p)),
    ydom: [Math.max(from.y, to.y), Math.min(from.y, to.y)].map((p) => invert(figure, "y", p))});

  /// In pixels, so that it does the same on a logarithmic axis.
  const zoomBy = (figure, factor) => {
    const width = figure.shown.signal("width"), height = figure.shown.signal("height"), k = (1 - factor) / 2;
    return zoomTo(figure, {x: k * width, y: k * height}, {x: (1 - k) * width, y: (1 - k) * height});
  };

  const step = (figure, series, row) => {
    const all = visible(figure);
    if (!all.length) return;
    figure.at.series = (series + all.length) % all.length;
    const chosen = all[figure.at.series];
    figure.at.row = Math.min(Math.max(row, 0), chosen.x.length - 1);
    if (usable(chosen.y[figure.at.row], figure.chart.y))
      figure.tell(words(figure, chosen, figure.at.row), point(figure, chosen, figure.at.row));
  };

  const key = (figure, event) => {
    if (figure.chart.kind !== "xy" || event.ctrlKey || event.metaKey || event.altKey) return;
    const {at} = figure;
    const actions = {
      ArrowRight: () => step(figure, at.series, at.row + 1), ArrowLeft: () => step(figure, at.series, at.row - 1),
      ArrowUp: () => step(figure, at.series - 1, at.row), ArrowDown: () => step(figure, at.series + 1, at.row),
      Home: () => step(figure, at.series, 0), End: () => step(figure, at.series, Infinity), Escape: () => figure.tell(null),
      ...(figure.zoomable() ? {"+": () => zoomBy(figure, 0.7), "-": () => zoomBy(figure, 1.4), 0: () => figure.reset()} : {}),
    };
    if (!Object.hasOwn(actions, event.key)) return;
    event.preventDefault();
    actions[event.key]();
  };

  return {nearest, zoomTo, key};
})();
