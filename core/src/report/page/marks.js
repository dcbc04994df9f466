// SPDX-License-Identifier: Apache-2.0
// Colours, dashes and symbols. Colours are Okabe and Ito's, told apart by the colour-blind; dashes and symbols carry
// the same information for grey print.
"use strict";
tunicaReport.marks = (() => {
  const themes = {
    light: {
      background: "#ffffff", text: "#1c2024", muted: "#5b636b", grid: "#e4e7ea", band: "#d55e00", bad: "#d55e00",
      colours: ["#0072b2", "#d55e00", "#009e73", "#b65a92", "#a06800", "#3a93c9", "#5f5f5f"],
    },
    dark: {
      background: "#16191d", text: "#e8eaed", muted: "#a6adb5", grid: "#31363c", band: "#ff8a3d", bad: "#ff8a3d",
      colours: ["#56b4e9", "#ff8a3d", "#2fc79a", "#e59bc6", "#e6b031", "#9fd3f3", "#bdbdbd"],
    },
  };
  const dashes = [[], [7, 3], [2, 2], [9, 3, 2, 3], [14, 4], [5, 2, 1, 2, 1, 2]];
  const shapes = ["circle", "square", "triangle-up", "diamond", "cross", "triangle-down", "triangle-right"];
  const theme = () => {
    const chosen = document.documentElement.dataset.theme;
    if (chosen) return themes[chosen];
    return themes[matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light"];
  };
  // A style is a number; -1 is what was measured.
  const colour = (look, style) => (style < 0 ? look.text : look.colours[style % look.colours.length]);
  // After every colour was used once the dash changes too, so that no two of the first 42 look alike.
  const dash = (style) =>
      (style < 0 ? [] : dashes[(style + Math.floor(style / dashes.length)) % dashes.length]);
  const shape = (style) => (style < 0 ? "circle" : shapes[style % shapes.length]);

  const svg = (name, attributes) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  };
  const outline = {
    circle: "M4 0A4 4 0 1 1-4 0A4 4 0 1 1 4 0Z", square: "M-3.5-3.5h7v7h-7z", "triangle-up": "M0-4.5L4.5 3.5h-9z",
    diamond: "M0-5L4 0 0 5-4 0z", cross: "M-4-1.5h2.5v-2.5h3v2.5h2.5v3h-2.5v2.5h-3v-2.5h-2.5z",
    "triangle-down": "M0 4.5L4.5-3.5h-9z", "triangle-right": "M4.5 0L-3.5 4.5v-9z",
  };
  /// A swatch for the legend: the line and the symbol of a series as the chart draws them.
  const swatch = (series, look) => {
    const picture = svg("svg", {width: 30, height: 12, viewBox: "-15 -6 30 12", "aria-hidden": "true"});
    const ink = colour(look, series.style);
    if (series.mark === "band") picture.append(svg("rect", {x: -13, y: -5, width: 26, height: 10, fill: ink, opacity: 0.25}));
    if (series.mark === "bars") picture.append(svg("path", {d: "M-7-6V6M0-6V6M7-6V6", stroke: ink, "stroke-width": 3, opacity: 0.5}));
    if (["line", "step", "both"].includes(series.mark))
      picture.append(svg("path", {d: "M-14 0H14", stroke: ink, "stroke-width": 2, fill: "none",
                                  "stroke-dasharray": dash(series.style).join(" ")}));
    if (["points", "both"].includes(series.mark)) {
      const filled = series.style >= 0;
      picture.append(svg("path", {d: outline[shape(series.style)], fill: filled ? ink : look.background, stroke: ink,
                                  "stroke-width": 1.2}));
    }
    return picture;
  };
  return {themes, theme, colour, dash, shape, swatch};
})();
