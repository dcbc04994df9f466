// SPDX-License-Identifier: Apache-2.0
// A body in its own shape: coloured quadrilaterals with the outlines of other states over them, one scale both ways.
"use strict";
tunicaReport.mesh = (() => {
  const {text} = tunicaReport.specs;

  /// The largest drawing that fits, in pixels.
  const size = (chart, width) => {
    const [left, right] = chart.x.domain, [low, high] = chart.y.domain;
    const scale = Math.min((width < 400 ? width - 80 : width - 190) / (right - left), 430 / (high - low));
    return {width: Math.max(60, (right - left) * scale), height: Math.max(60, (high - low) * scale), fixed: true};
  };

  const cells = ({points, cells: corners, values}) => values.map((value, k) => {
    const around = [0, 1, 2, 3].map((i) => corners[4 * k + i]).map((n) => [points[2 * n], points[2 * n + 1]]);
    const middle = (i) => around.reduce((sum, point) => sum + point[i] / 4, 0);
    return {around, x: middle(0), y: middle(1), value};
  });

  const spec = (chart, look, wanted, hidden) => {
    const {frame, config, axes, lines, rows} = tunicaReport.specs;
    const [left, right] = chart.x.domain, [low, high] = chart.y.domain;
    const px = (x) => ((x - left) / (right - left) * wanted.width).toFixed(2);
    const py = (y) => ((high - y) / (high - low) * wanted.height).toFixed(2);
    const drawn = cells(chart.mesh).filter((cell) => tunicaReport.specs.finite(cell.value));
    const values = drawn.map((cell) => cell.value);
    const shown = chart.series.map((series, k) => ({series, k})).filter(({series}) => !hidden.has(series.name));
    const linear = (name, domain, range) => ({name, type: "linear", domain, range, zero: false, nice: false});
    return {
      ...frame(chart, wanted), config: config(look),
      data: [{name: "cells", values: drawn.map((cell) => ({value: cell.value, path: "M" + cell.around.map(([x, y]) => px(x) + "," + py(y)).join("L") + "Z"}))},
             ...shown.map(({series, k}) => ({name: "s" + k, values: rows(series, chart)}))],
      scales: [linear("x", chart.x.domain, "width"), linear("y", chart.y.domain, "height"),
               {name: "level", type: "linear", domain: [values.reduce((a, b) => Math.min(a, b), Infinity), values.reduce((a, b) => Math.max(a, b), -Infinity)],
                range: {scheme: "cividis"}, zero: false}],
      axes: axes(chart, wanted),
      // The edges in the colour of the cell, so that no gaps show between neighbours.
      marks: [{type: "path", clip: true, from: {data: "cells"}, encode: {update: {path: {field: "path"},
                fill: {scale: "level", field: "value"}, stroke: {scale: "level", field: "value"}, strokeWidth: {value: 0.4}}}},
              ...shown.flatMap(({series, k}) => lines(series, k, look))],
      legends: [{fill: "level", title: chart.mesh.title, format: ".3~g", gradientLength: Math.min(160, Math.max(80, wanted.height * 0.8)),
                 ...(wanted.width < 300 && document.documentElement.clientWidth < 520 ? {orient: "bottom", direction: "horizontal"} : {})}],
    };
  };

  /// The cell whose middle is nearest, within a twelfth of the drawing.
  const nearest = (figure, at) => {
    const {chart, shown: view} = figure, [left, top] = figure.corner();
    figure.cells = figure.cells || cells(chart.mesh);
    const reach = Math.max(view.signal("width"), view.signal("height")) / 12;
    let best = null, least = reach * reach;
    for (const cell of figure.cells) {
      const away = (view.scale("x")(cell.x) - at.x) ** 2 + (view.scale("y")(cell.y) - at.y) ** 2;
      if (away < least) { least = away; best = cell; }
    }
    figure.tell(best && chart.title + ": " + text(best.value) + " " + chart.mesh.title + "\n" + chart.x.title + ": " + text(best.x) + "\n" + chart.y.title + ": " + text(best.y),
                best && {left: view.scale("x")(best.x) + left, top: view.scale("y")(best.y) + top});
  };

  return {size, cells, spec, nearest};
})();
