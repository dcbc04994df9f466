// SPDX-License-Identifier: Apache-2.0
// From what the program says of a chart (kind, axes, series) to a Vega specification.
"use strict";
tunicaReport.specs = (() => {
  const {colour, dash, shape} = tunicaReport.marks;

  const finite = (value) => typeof value === "number" && Number.isFinite(value);
  const usable = (value, axis) => finite(value) && !(axis && axis.log && value <= 0);
  const text = (value) => {
    if (!finite(value)) return "–";
    const size = Math.abs(value);
    return size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(3) : String(Number(value.toPrecision(5)));
  };

  /// The range of the values with a margin, or what the axis asks for.
  const span = (values, axis) => {
    const seen = values.filter((value) => usable(value, axis));
    for (const value of axis.include || []) seen.push(value);
    if (axis.domain) return axis.domain;
    if (!seen.length) return axis.log ? [0.1, 10] : [0, 1];
    let low = Infinity, high = -Infinity;
    for (const value of seen) { low = Math.min(low, value); high = Math.max(high, value); }
    if (axis.log) return low === high ? [low / 2, high * 2] : [low / (high / low) ** 0.04, high * (high / low) ** 0.04];
    const margin = low === high ? Math.abs(low) * 0.1 || 1 : (high - low) * 0.04;
    return [low - margin, high + margin];
  };

  /// Text in lines of at most `most` characters, broken after spaces, underscores and commas; nothing is cut off.
  const wrapped = (label, most) => {
    const lines = [""];
    for (let piece of String(label).split(/(?<=[ _,./-])/)) {
      if (lines[lines.length - 1] && (lines[lines.length - 1] + piece).trimEnd().length > most) lines.push("");
      for (; piece.length > most; piece = piece.slice(most)) lines.splice(-1, 1, lines[lines.length - 1] + piece.slice(0, most), "");
      lines[lines.length - 1] += piece;
    }
    return lines.map((line) => line.trimEnd()).filter((line) => line);
  };
  const letter = 6.6;  // pixels of a character of a label at most, on average
  const title = (label, room) => { const lines = wrapped(label || "", Math.max(16, Math.floor(room / 7.4))); return lines.length > 1 ? lines : lines[0] || ""; };
  /// Labels of rows take at most 38 % of the width, in as many lines as they need.
  const labelLines = (labels, width) => labels.map((label) => wrapped(label, Math.floor(Math.min(300, Math.max(110, width * 0.38)) / letter)));
  const longest = (labels) => labels.reduce((most, label) => Math.max(most, label.length), 0);
  const most = (counts) => counts.reduce((a, b) => Math.max(a, b), 1);
  /// The axis takes its labels from the signal "lines", by the full label.
  const inLines = {labelLimit: 0, labelOverlap: false, encode: {labels: {update: {lineHeight: {value: 13},
    text: {signal: "lines[datum.value] || datum.value"}, dy: {signal: "lines[datum.value] ? -6.5 * (length(lines[datum.value]) - 1) : 0"}}}}};
  const linesSignal = (labels, lines) => ({name: "lines", value: Object.fromEntries(labels.map((label, i) => [label, lines[i]]))});
  /// Height of a row of labels, and of a chart that has one row for each.
  const rowHeight = (labels, width, least) => Math.max(least, 13 * most(labelLines(labels, width).map((lines) => lines.length)) + 7);
  /// Slanted labels under a chart stand in full up to this length; longer ones are replaced by numbers, which stand before the rows too.
  const slanted = 34;
  const headings = (chart) => longest(chart.columns) <= slanted ? {columns: chart.columns, labels: chart.labels}
      : {columns: chart.columns.map((name, i) => String(i + 1)), labels: chart.labels.map((name) => (chart.columns.includes(name) ? chart.columns.indexOf(name) + 1 + "  " : "") + name)};

  const config = (look) => ({
    background: look.background,
    axis: {domainColor: look.muted, tickColor: look.muted, gridColor: look.grid, labelColor: look.text,
           titleColor: look.text, labelFontSize: 12, titleFontSize: 13, titleFontWeight: 500, titlePadding: 8,
           labelFont: "sans-serif", titleFont: "sans-serif", labelOverlap: "greedy"},
    legend: {labelColor: look.text, titleColor: look.text, labelFontSize: 12, titleFontSize: 12, labelFont: "sans-serif",
             titleFont: "sans-serif", labelLimit: 400},
    title: {color: look.text, font: "sans-serif"},
    text: {font: "sans-serif"},
  });

  const frame = (chart, size) => ({
    $schema: "https://vega.github.io/schema/vega/v5.json", description: chart.about, width: size.width,
    height: size.height, padding: 4, autosize: {type: size.fixed ? "pad" : "fit", contains: "padding"},
  });

  const axes = (chart, size, more = {}) => [
    {orient: "bottom", scale: "x", title: title(chart.x.title, size.width - 60), grid: true, tickCount: Math.max(3, Math.round(size.width / 110)),
     ...(chart.x.log ? {format: "~g"} : {}), ...more.x},
    {orient: "left", scale: "y", title: title(chart.y.title, size.height - 60), grid: true, tickCount: 6,
     ...(chart.y.log ? {format: "~g"} : {}), ...more.y},
  ];

  const lines = (series, k, look) => {
    const scaled = {x: {scale: "x", field: "x"}, y: {scale: "y", field: "y"}, defined: {signal: "isValid(datum.y)"}};
    const ink = {value: colour(look, series.style)}, faint = series.faint ? 0.35 : 1;
    const made = [];
    // A band, alone or about a line; of a range only the edges, so that both can be seen at once.
    if (series.mark === "bars")
      made.push({type: "rule", clip: true, from: {data: "s" + k}, encode: {update: {
        x: scaled.x, y: {scale: "y", field: "low"}, y2: {scale: "y", field: "high"}, stroke: ink, strokeWidth: {value: 3}, strokeOpacity: {value: 0.4}}}});
    else if (series.low && series.mark !== "range")
      made.push({type: "area", clip: true, from: {data: "s" + k}, encode: {update: {
        x: scaled.x, y: {scale: "y", field: "low"}, y2: {scale: "y", field: "high"}, fill: ink,
        defined: {signal: "isValid(datum.low)"}, fillOpacity: {value: 0.2}}}});
    if (series.mark === "range")
      for (const edge of ["low", "high"])
        made.push({type: "line", clip: true, from: {data: "s" + k}, encode: {update: {
          x: scaled.x, y: {scale: "y", field: edge}, stroke: ink, strokeWidth: {value: 0.8}, strokeDash: {value: dash(series.style)},
          defined: {signal: "isValid(datum." + edge + ")"}}}});
    if (["line", "step", "both"].includes(series.mark))
      made.push({type: "line", clip: true, from: {data: "s" + k}, encode: {update: {
        ...scaled, stroke: ink, strokeOpacity: {value: faint}, strokeWidth: {value: series.faint ? 1.2 : 2},
        strokeDash: {value: dash(series.style)}, interpolate: {value: series.mark === "step" ? "step-after" : "linear"}}}});
    if (["points", "both"].includes(series.mark))
      made.push({type: "symbol", clip: true, from: {data: "s" + k}, encode: {update: {
        x: scaled.x, y: scaled.y, size: {value: series.x.length > 150 ? 18 : 34}, shape: {value: shape(series.style)},
        stroke: ink, strokeWidth: {value: 1.2}, fill: {value: series.style < 0 ? "transparent" : colour(look, series.style)},
        fillOpacity: {value: series.style < 0 ? 0 : 0.75}}}});
    return made;
  };

  /// Rows without a place on the axes leave a gap.
  const rows = (series, chart) => series.x.map((x, i) => {
    const row = {x, y: usable(series.y[i], chart.y) ? series.y[i] : null};
    if (series.low && usable(series.low[i], chart.y) && usable(series.high[i], chart.y))
      Object.assign(row, {low: series.low[i], high: series.high[i]});
    return row;
  }).filter((row) => usable(row.x, chart.x) && (!["band", "bars"].includes(series.mark) || finite(row.low)));

  /// Of bands about curves no more than half as much again as the curves take: a wide one is cut, not the curves squeezed.
  const seenAlong = (shown, axis) => {
    const points = shown.filter(({series}) => !["band", "bars", "range"].includes(series.mark)).flatMap(({series}) => series.y)
        .filter((value) => usable(value, axis));
    const edges = shown.flatMap(({series}) => [...(series.low || []), ...(series.high || [])]).filter((value) => usable(value, axis));
    if (!points.length || axis.log) return [...points, ...edges];
    const low = points.reduce((a, b) => Math.min(a, b)), high = points.reduce((a, b) => Math.max(a, b)), room = (high - low) / 2;
    return [...points, ...edges.map((value) => Math.min(Math.max(value, low - room), high + room))];
  };

  const reference = (chart, look) => {
    const made = [];
    (chart.bands || []).forEach((band) => {
      const along = band.axis || "x", other = along === "x" ? {y: {value: 0}, y2: {signal: "height"}} : {x: {value: 0}, x2: {signal: "width"}};
      made.push({type: "rect", clip: true, encode: {update: {...other, [along]: {scale: along, value: band.from, offset: -3},
        [along + "2"]: {scale: along, value: band.to, offset: 3}, fill: {value: look.band}, fillOpacity: {value: 0.14}}}});
    });
    (chart.rules || []).forEach((rule) => {
      const across = rule.axis === "x" ? {x: {scale: "x", value: rule.at}, y: {value: 0}, y2: {signal: "height"}}
                                       : {y: {scale: "y", value: rule.at}, x: {value: 0}, x2: {signal: "width"}};
      made.push({type: "rule", clip: true, encode: {update: {...across, stroke: {value: look.muted}, strokeDash: {value: [4, 3]}}}});
      // Near the right edge the label stands on the left.
      const near_edge = `scale('x', ${rule.at}) > 0.8 * width`;
      if (rule.label) made.push({type: "text", clip: true, encode: {update: {
        ...(rule.axis === "x" ? {x: {signal: `scale('x', ${rule.at}) + (${near_edge} ? -4 : 4)`}, y: {value: 12},
                                 align: {signal: `${near_edge} ? 'right' : 'left'`}}
                              : {x: {value: 6}, y: {scale: "y", value: rule.at, offset: -5}}),
        text: {value: rule.label}, fill: {value: look.muted}, fontSize: {value: 11}}}});
    });
    return made;
  };

  /// The tags of curves where they end on the right, moved apart where they would lie on each other.
  const tags = (shown, look, size, xdom, ydom) => {
    const far = 34, apart = 11, placed = [];
    const ends = shown.filter(({series}) => series.tag).map(({series}) => {
      const last = series.x.reduce((best, x, i) => (usable(series.y[i]) && x >= series.x[best] ? i : best), 0);
      const x = series.x[last], y = series.y[last];
      return {x, y, text: series.tag, px: (x - xdom[0]) / (xdom[1] - xdom[0]) * size.width, py: -(y - ydom[0]) / (ydom[1] - ydom[0]) * size.height};
    }).sort((a, b) => a.py - b.py);
    for (const end of ends) {
      const above = placed.filter((other) => Math.abs(other.px - end.px) < far).map((other) => other.py + apart);
      placed.push({...end, py: Math.max(end.py, ...above), from: end.py});
    }
    // Half of what they were moved goes back up, so that the bundle stays beside its curves.
    const back = placed.reduce((most, tag) => Math.max(most, tag.py - tag.from), 0) / 2;
    return placed.map((tag) => ({type: "text", interactive: false, encode: {update: {
      x: {scale: "x", value: tag.x, offset: 6}, y: {scale: "y", value: tag.y, offset: tag.py - tag.from - back},
      baseline: {value: "middle"}, text: {value: tag.text}, fill: {value: look.text}, fontSize: {value: 11}, fontWeight: {value: 600},
      opacity: {signal: `inrange(${tag.x}, xdom) && inrange(${tag.y}, ydom) ? 1 : 0`}}}}));
  };

  const xy = (chart, look, size, hidden) => {
    const shown = chart.series.map((series, k) => ({series, k})).filter(({series}) => !hidden.has(series.name));
    const signals = [{name: "xdom", value: span(shown.flatMap(({series}) => series.x), chart.x)},
                     {name: "ydom", value: span(seenAlong(shown, chart.y), chart.y)}];
    const scale = (name, axis) => ({name, type: axis.log ? "log" : "linear", range: name === "x" ? "width" : "height",
                                    domain: {signal: name + "dom"}, zero: false, nice: false});
    const sources = shown.map(({series, k}) => ({name: "s" + k, values: rows(series, chart)}));
    const scales = [scale("x", chart.x), scale("y", chart.y)];
    const marks = [...reference(chart, look), ...shown.flatMap(({series, k}) => lines(series, k, look)),
                   ...tags(shown, look, size, signals[0].value, signals[1].value),
                   {type: "symbol", clip: true, from: {data: "cursor"}, encode: {update: {
                     x: {scale: "x", field: "x"}, y: {scale: "y", field: "y"}, size: {value: 130}, fill: {value: "transparent"},
                     stroke: {value: look.text}, strokeWidth: {value: 2}}}}];
    const contours = chart.field ? field(chart, look, size) : null;
    if (contours) { sources.unshift(...contours.data); scales.push(...contours.scales); marks.unshift(...contours.marks); }
    return {...frame(chart, size), config: config(look), signals, scales, marks, data: [...sources, {name: "cursor", values: []}],
            axes: axes(chart, size), ...(contours ? {legends: contours.legends} : {})};
  };

  /// Isocontours of a square grid of values. Vega counts grid cells from the corner, half a cell outside the nodes.
  const field = (chart, look, size) => ({
    data: [{name: "grid", values: [{width: chart.field.columns, height: chart.field.rows, values: chart.field.values}]},
           {name: "contours", source: "grid", transform: [{type: "isocontour", as: "contour",
             thresholds: chart.field.levels, scale: {expr: "width / " + chart.field.columns}}]}],
    scales: [{name: "level", type: "log", domain: [chart.field.levels[0], chart.field.levels[chart.field.levels.length - 1]],
              range: {scheme: "cividis"}}],
    marks: [{type: "path", clip: true, from: {data: "contours"}, transform: [{type: "geopath", field: "datum.contour"}],
             encode: {update: {fill: {scale: "level", field: "contour.value"}, fillOpacity: {value: 0.55},
                               stroke: {value: look.background}, strokeWidth: {value: 0.7}}}}],
    legends: [{fill: "level", title: chart.field.title, format: ".2~r", gradientLength: 160,
               ...(size.width < 400 ? {orient: "bottom", direction: "horizontal"} : {})}],
  });

  /// The series whose intervals would lie on each other; none where there is one only.
  const sideBySide = (chart, series) => {
    const found = series.filter((one) => one.rows.some((row) => usable(row.low, chart.x) && usable(row.high, chart.x)));
    return chart.bars || found.length < 2 ? [] : found;
  };

  /// One row a category: a bar or an interval, and values on it. Several intervals of a category lie side by side.
  const rowsSpec = (chart, look, size, hidden) => {
    const shown = chart.series.filter((series) => !hidden.has(series.name));
    const points = [], bars = [];
    const beside = sideBySide(chart, shown);
    for (const series of shown)
      series.rows.forEach((row, i) => {
        const place = beside.includes(series) ? (beside.indexOf(series) + 1) / (beside.length + 1) : 0.5;
        const at = {...row, label: chart.labels[i], style: series.style, place};
        if (usable(row.value, chart.x)) points.push(at);
        if (usable(row.low, chart.x) && usable(row.high, chart.x)) bars.push(at);
      });
    const reach = span([...points.map((p) => p.value), ...bars.flatMap((b) => [b.low, b.high])], chart.x);
    const paint = (channel) => shown.map((series) => ({test: "datum.style === " + series.style, [channel]: series})).map(
        ({test}, k) => ({test, value: channel === "shape" ? shape(shown[k].style) : colour(look, shown[k].style)}));
    const middle = {signal: "scale('y', datum.label) + datum.place * bandwidth('y')"};
    return {
      ...frame(chart, size), config: config(look), signals: [{name: "xdom", value: reach}, linesSignal(chart.labels, labelLines(chart.labels, size.width))],
      data: [{name: "points", values: points}, {name: "bars", values: bars}],
      scales: [{name: "x", type: chart.x.log ? "log" : "linear", domain: {signal: "xdom"}, range: "width", zero: false},
               {name: "y", type: "band", domain: chart.labels, range: "height", padding: 0.2}],
      axes: axes(chart, size, {y: {...inLines, grid: false}}),
      marks: [
        ...reference(chart, look),
        {type: "rule", clip: true, from: {data: "bars"}, encode: {update: {
          x: {scale: "x", field: "low"}, x2: {scale: "x", field: "high"}, y: middle, strokeWidth: {value: chart.bars ? 9 : 3},
          strokeOpacity: {value: chart.bars ? 0.55 : 0.8}, stroke: paint("stroke")}}},
        {type: "symbol", clip: true, from: {data: "points"}, encode: {update: {
          x: {scale: "x", field: "value"}, y: middle, size: {value: 60}, shape: paint("shape"), fill: paint("fill"),
          stroke: {value: look.background}, strokeWidth: {value: 0.8}}}}],
    };
  };

  const heat = (chart, look, size) => {
    const cells = [], {columns, labels} = chart.numeric ? chart : headings(chart), lines = labelLines(labels, size.width);
    chart.values.forEach((row, i) => row.forEach((value, j) => {
      if (finite(value)) cells.push({x: columns[j], y: labels[i], value});
    }));
    const room = size.width / columns.length > 58 && labels.length <= 12;
    const upright = columns !== chart.columns;
    return {
      ...frame(chart, size), config: config(look), data: [{name: "cells", values: cells}],
      ...(chart.numeric ? {} : {signals: [linesSignal(labels, lines)]}),
      scales: [{name: "x", type: "band", domain: columns, range: "width"},
               {name: "y", type: "band", domain: labels, range: "height"},
               {name: "heat", type: "linear", domain: chart.domain, range: {scheme: "cividis"}, clamp: true}],
      axes: [{orient: "bottom", scale: "x", title: chart.x.title, labelLimit: 300, labelOverlap: chart.numeric ? "greedy" : false,
              ...(upright ? {labelFontSize: 9} : {labelAngle: -60, labelAlign: "right", labelBaseline: "middle"})},
             {orient: "left", scale: "y", title: chart.y.title, ...(chart.numeric ? {labelOverlap: "greedy"} : inLines)}],
      marks: [{type: "rect", from: {data: "cells"}, encode: {update: {x: {scale: "x", field: "x"}, y: {scale: "y", field: "y"},
                width: {scale: "x", band: 1}, height: {scale: "y", band: 1}, fill: {scale: "heat", field: "value"}}}},
              ...(room ? [{type: "text", from: {data: "cells"}, encode: {update: {
                x: {scale: "x", field: "x", band: 0.5}, y: {scale: "y", field: "y", band: 0.5}, align: {value: "center"},
                baseline: {value: "middle"}, text: {signal: "format(datum.value, '.2f')"}, fontSize: {value: 11},
                fill: {signal: "datum.value > " + (chart.domain[0] + 0.55 * (chart.domain[1] - chart.domain[0])) + " ? '#000' : '#fff'"}}}}] : [])],
      legends: [{fill: "heat", title: chart.legend, gradientLength: Math.min(200, size.height * 0.7),
                 ...(size.width < 800 && !chart.numeric ? {orient: "top", direction: "horizontal"} : {})}],
    };
  };

  const make = (chart, look, size, hidden) => {
    if (chart.kind === "heat") return heat(chart, look, size);
    if (chart.kind === "mesh") return tunicaReport.mesh.spec(chart, look, size, hidden);
    return (chart.kind === "rows" ? rowsSpec : xy)(chart, look, size, hidden);
  };
  return {make, usable, text, finite, frame, config, axes, lines, rows, rowHeight, sideBySide, headings, longest};
})();
