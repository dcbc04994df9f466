// SPDX-License-Identifier: Apache-2.0
// What leaves the page when someone saves: a legend for the picture, and the plotted values as a table.
"use strict";
tunicaReport.withLegend = (spec, chart, hidden) => {
  const {colour, dash, shape, themes} = tunicaReport.marks, look = themes.light;
  const shown = [...new Map(chart.series.map((series) => [series.name, series])).values()].filter((series) => !hidden.has(series.name));
  if (chart.kind === "heat" || shown.length < 2) return {...spec, title: {text: chart.title, anchor: "start"}};
  const names = shown.map((series) => series.name);
  const scale = (name, range) => ({name, type: "ordinal", domain: names, range: shown.map(range)});
  return {
    ...spec, title: {text: chart.title, anchor: "start"},
    scales: [...spec.scales, scale("legend_colour", (s) => colour(look, s.style)), scale("legend_dash", (s) => dash(s.style)),
             scale("legend_shape", (s) => ["line", "step", "band", "bars"].includes(s.mark) ? "stroke" : shape(s.style))],
    legends: [...(spec.legends || []), {stroke: "legend_colour", strokeDash: "legend_dash", shape: "legend_shape", orient: "bottom",
                                        direction: "vertical", columns: 2, symbolStrokeWidth: 2, symbolFillColor: "transparent"}],
  };
};

tunicaReport.table = (chart) => {
  // A cell that a spreadsheet would take for a formula gets a quote before it.
  const cell = (value) => {
    if (value === null || value === undefined) return "";
    if (typeof value === "number") return String(value);
    const text = /^[=+\-@\t\r]/.test(value) ? "'" + value : value;
    return /[",\n\r]/.test(text) ? '"' + text.replaceAll('"', '""') + '"' : text;
  };
  const lines = [];
  const put = (...cells) => lines.push(cells.map(cell).join(","));
  if (chart.kind === "heat") {
    put(chart.legend, ...chart.columns);
    chart.values.forEach((row, i) => put(chart.labels[i], ...row));
  } else if (chart.kind === "mesh") {
    put(chart.x.title, chart.y.title, chart.mesh.title);
    for (const cell of tunicaReport.mesh.cells(chart.mesh)) put(cell.x, cell.y, cell.value);
  } else if (chart.kind === "rows") {
    put("row", "series", chart.x.title, "low", "high");
    for (const series of chart.series)
      series.rows.forEach((row, i) => put(chart.labels[i], series.name, row.value, row.low, row.high));
  } else {
    put("series", chart.x.title, chart.y.title, "low", "high");
    for (const series of chart.series)
      series.x.forEach((x, i) => put(series.name + (series.label ? ", " + series.label : ""), x, series.y[i], series.low && series.low[i], series.high && series.high[i]));
  }
  return lines.join("\n") + "\n";
};
