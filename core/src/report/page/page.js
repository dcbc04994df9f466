// SPDX-License-Identifier: Apache-2.0
// Draws every figure, the first screen first, and follows the theme, the width and the printer.
"use strict";
(() => {
  const root = document.documentElement, began = performance.now();
  const charts = JSON.parse(document.getElementById("charts").textContent);
  const figures = [];
  let vega = null, failed = 0;

  const fail = (element, problem) => {
    ++failed;
    console.error("chart " + element.dataset.chart + ": " + problem);
    element.querySelector(".plot").textContent = "This chart could not be drawn (" + problem + "); its values are in the tables beside the report.";
  };
  // The page stays alive while many charts are drawn; a pause for each would cost more than the charts.
  let rested = performance.now();
  const pause = async () => {
    if (performance.now() - rested < 60) return;
    await new Promise((resolve) => setTimeout(resolve));
    rested = performance.now();
  };

  const all = async (look) => {
    figures.forEach((figure) => figure.legend(look));
    for (const figure of figures) {
      await figure.draw(look).catch((problem) => fail(figure.element, problem));
      if (!look) await pause();
    }
  };

  const spent = () => Math.round(performance.now() - began);
  const make = async (element, look) => {
    if (element.dataset.made) return;
    element.dataset.made = "yes";
    try {
      vega = vega || tunicaReport.vega();
      const figure = new tunicaReport.Figure(element, charts[Number(element.dataset.chart)], vega);
      await figure.draw(look);
      figures.push(figure);
    } catch (problem) {
      fail(element, problem);
    }
  };
  const count = () => {
    root.dataset.drawn = figures.length;
    root.dataset.failed = failed;
  };
  // Charts in a fold that waits are drawn when someone opens it.
  for (const fold of document.querySelectorAll("details.waits"))
    fold.addEventListener("toggle", async () => {
      if (!fold.open || fold.dataset.drawn) return;
      fold.dataset.drawn = "yes";
      for (const element of fold.querySelectorAll("figure[data-chart]")) {
        await make(element);
        await pause();
      }
      count();
    });
  const start = async () => {
    for (const element of document.querySelectorAll("figure[data-chart]")) {
      if (element.closest("details.waits:not([open])")) continue;
      await make(element);
      if (!root.dataset.first && element.getBoundingClientRect().top > innerHeight) root.dataset.first = spent();
      await pause();
    }
    count();
    root.dataset.milliseconds = spent();
  };

  document.getElementById("theme").addEventListener("click", () => {
    root.dataset.theme = tunicaReport.marks.theme() === tunicaReport.marks.themes.dark ? "light" : "dark";
    all();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => all());
  let width = innerWidth, waiting = 0;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    clearTimeout(waiting);
    waiting = setTimeout(() => all(), 150);
  });
  // On paper: light, and nothing folded away or still to come. The printer waits for what is done without a pause.
  const opened = [];
  addEventListener("beforeprint", () => {
    const light = tunicaReport.marks.themes.light;
    for (const fold of document.querySelectorAll("details:not([open])")) { fold.open = true; opened.push(fold); }
    const waiting = [...document.querySelectorAll("figure[data-chart]")].filter((element) => !element.dataset.made);
    all(light);
    Promise.all(waiting.map((element) => make(element, light))).then(count);
  });
  addEventListener("afterprint", () => { opened.splice(0).forEach((fold) => { fold.open = false; }); all(); });

  globalThis.tunicaFigures = figures;
  start();
})();
