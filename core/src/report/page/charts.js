// SPDX-License-Identifier: Apache-2.0
// One figure: legend with switches, the drawing, values under the pointer or the arrow keys, zoom, and saving.
"use strict";
tunicaReport.Figure = class {
  constructor(element, chart, vega) {
    Object.assign(this, {element, chart, vega, hidden: new Set(chart.series.filter((s) => s.hidden).map((s) => s.name)),
                         zoom: {}, at: {series: 0, row: -1}});
    this.plot = element.querySelector(".plot");
    this.note = this.add("div", "value", this.plot);
    this.canvas = this.add("div", "canvas", this.plot);
    this.brush = this.add("div", "brush", this.plot);
    this.note.setAttribute("role", "status");
    this.plot.setAttribute("tabindex", "0");
    this.plot.setAttribute("role", "group");
    this.plot.setAttribute("aria-label", chart.about);
    this.legend();
    this.buttons();
    this.listen();
  }

  add(kind, style, parent, text) {
    const made = document.createElement(kind);
    made.className = style;
    if (text) made.textContent = text;
    parent.append(made);
    return made;
  }

  legend(look = tunicaReport.marks.theme()) {
    const bar = this.element.querySelector(".legend");
    bar.replaceChildren();
    if (this.chart.kind === "heat") return;
    const names = new Map(this.chart.series.map((series) => [series.name, series]));
    if (names.size < 2 && !this.chart.legend) return;
    for (const series of names.values()) {
      const button = this.add("button", "series", bar);
      button.type = "button";
      button.setAttribute("aria-pressed", String(!this.hidden.has(series.name)));
      const kind = this.chart.kind === "rows" ? {...series, mark: "points"} : series;
      button.append(tunicaReport.marks.swatch(kind, look));
      this.add("span", "", button, series.name);
      button.addEventListener("click", () => {
        if (!this.hidden.delete(series.name)) this.hidden.add(series.name);
        button.setAttribute("aria-pressed", String(!this.hidden.has(series.name)));
        this.draw();
      });
    }
  }

  buttons() {
    const bar = this.element.querySelector(".tools");
    const button = (text, title, action) => {
      const made = this.add("button", "tool", bar, text);
      made.type = "button";
      made.title = title;
      made.setAttribute("aria-label", title + ": " + this.chart.title);
      made.addEventListener("click", action);
    };
    if (this.zoomable()) button("Reset", "Whole range again", () => this.reset());
    button("SVG", "Save as SVG", () => this.save("svg"));
    button("PNG", "Save as PNG", () => this.save("png"));
    button("CSV", "Save the plotted values as CSV", () => this.save("csv"));
  }

  zoomable() { return this.chart.kind === "xy" && !this.chart.field; }

  size(width) {
    const most = Math.max(240, width), {chart} = this;
    if (chart.kind === "rows") return {width: most, height: 64 + tunicaReport.specs.rowHeight(chart.labels, most, 26 + 13 * tunicaReport.specs.sideBySide(chart, chart.series).length) * chart.labels.length};
    if (chart.kind === "heat") {
      const room = 190 + (tunicaReport.specs.longest(chart.columns) > 34 ? 14 : 17) * chart.columns.length;
      const wide = chart.numeric ? Math.min(most, 620) : Math.max(most, room);
      if (chart.numeric) return {width: Math.min(wide, 980), height: 420};
      const {columns, labels} = tunicaReport.specs.headings(chart), under = Math.min(tunicaReport.specs.longest(columns), 34) * 6;
      return {width: Math.min(wide, 980), height: (wide < 800 ? 110 : 60) + under + tunicaReport.specs.rowHeight(labels, Math.min(wide, 980), 20) * labels.length};
    }
    if (chart.kind === "mesh") return tunicaReport.mesh.size(chart, most);
    if (chart.field) { const side = Math.min(most < 520 ? most - 80 : most - 190, 420); return {width: Math.max(side, 180), height: Math.max(side, 180), fixed: true}; }
    return {width: most, height: most < 520 ? 270 : chart.low ? 200 : 320};
  }

  spec(look, width) { return tunicaReport.specs.make(this.chart, look, this.size(width), this.hidden); }

  view(spec, options) {
    const expr = this.vega.expressionInterpreter;
    // Vega only logs what goes wrong while it draws; here it is a failure.
    const view = new this.vega.View(this.vega.parse(spec, null, {ast: true}), {expr, renderer: "svg", ...options});
    const silent = () => logger;
    const logger = {level: () => 1, warn: silent, info: silent, debug: silent,
                    error: (...problem) => { view.problem = problem.join(" "); return logger; }};
    view.logger(logger);
    return view;
  }

  async draw(look) {
    if (this.shown) this.shown.finalize();
    this.canvas.replaceChildren();
    this.look = look || tunicaReport.marks.theme();
    this.shown = this.view(this.spec(this.look, this.plot.clientWidth), {container: this.canvas, hover: false});
    this.shown.tooltip(() => {});
    for (const [name, domain] of Object.entries(this.zoom)) this.shown.signal(name, domain);
    await this.shown.runAsync();
    if (this.shown.problem) throw new Error(this.shown.problem);
    const picture = this.canvas.querySelector("svg");
    if (picture) { picture.setAttribute("role", "img"); picture.setAttribute("aria-label", this.chart.about); }
  }

  setZoom(zoom) {
    this.zoom = zoom;
    for (const [name, domain] of Object.entries(zoom)) this.shown.signal(name, domain);
    return this.shown.runAsync();
  }

  /// Where the axes meet, from the corner of the drawing.
  corner() {
    const [left, top] = this.shown.origin(), padding = this.shown.padding();
    return [left + padding.left, top + padding.top];
  }

  reset() { this.zoom = {}; return this.draw(); }

  listen() {
    const place = (event) => {
      const box = this.canvas.getBoundingClientRect(), [left, top] = this.corner();
      const px = event.clientX - box.left, py = event.clientY - box.top;
      return {x: px - left, y: py - top, px, py};
    };
    let start = null;
    this.plot.addEventListener("pointermove", (event) => {
      if (!this.shown) return;
      const now = place(event);
      if (start) return this.showBrush(start, now);
      tunicaReport.pointer.nearest(this, now);
    });
    this.plot.addEventListener("pointerleave", () => { this.tell(null); });
    this.plot.addEventListener("pointerdown", (event) => {
      if (event.pointerType === "mouse" && event.button === 0 && this.zoomable()) start = place(event);
    });
    addEventListener("pointerup", (event) => {
      if (!start) return;
      const from = start, to = place(event);
      start = null;
      this.brush.style.display = "none";
      if (Math.abs(from.x - to.x) > 8 && Math.abs(from.y - to.y) > 8) tunicaReport.pointer.zoomTo(this, from, to);
    });
    this.plot.addEventListener("dblclick", () => this.zoomable() && this.reset());
    this.plot.addEventListener("keydown", (event) => tunicaReport.pointer.key(this, event));
    this.plot.addEventListener("blur", () => this.tell(null));
  }

  showBrush(from, to) {
    Object.assign(this.brush.style, {display: "block", left: Math.min(from.px, to.px) + "px", top: Math.min(from.py, to.py) + "px",
                                     width: Math.abs(from.px - to.px) + "px", height: Math.abs(from.py - to.py) + "px"});
  }

  /// Puts words beside a place of the drawing, and a ring on it.
  tell(words, place) {
    this.note.textContent = words || "";
    this.note.style.display = words ? "block" : "none";
    if (words) {
      const right = place.left > this.plot.clientWidth / 2;
      this.note.style.left = right ? "auto" : place.left + 14 + "px";
      this.note.style.right = right ? this.plot.clientWidth - place.left + 14 + "px" : "auto";
      this.note.style.top = Math.max(0, place.top - 12) + "px";
    }
    if (this.chart.kind === "xy" && this.shown) {
      this.shown.data("cursor", words && place.datum ? [place.datum] : []);
      this.shown.runAsync();
    }
  }

  name(kind) { return this.chart.id.replace(/[^A-Za-z0-9_-]+/g, "_") + "." + kind; }

  /// Saved in light colours whatever the page shows, and with a legend in the picture.
  async save(kind) {
    const link = document.createElement("a");
    link.download = this.name(kind);
    if (kind === "csv") {
      link.href = URL.createObjectURL(new Blob([tunicaReport.table(this.chart)], {type: "text/csv"}));
    } else {
      const spec = tunicaReport.withLegend(this.spec(tunicaReport.marks.themes.light, 760), this.chart, this.hidden);
      const view = this.view(spec, {renderer: "none"});
      for (const [name, domain] of Object.entries(this.zoom)) view.signal(name, domain);
      await view.runAsync();
      link.href = kind === "svg" ? URL.createObjectURL(new Blob([await view.toSVG()], {type: "image/svg+xml"}))
                                 : (await view.toCanvas(2)).toDataURL("image/png");
      view.finalize();
    }
    document.body.append(link);
    link.click();
    link.remove();
    return link.href;
  }
};
