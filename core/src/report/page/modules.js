// SPDX-License-Identifier: Apache-2.0
// Debian packages Vega as the CommonJS modules it is made of, without the file that joins them. Each is wrapped in
// tunicaReport.define at build time; this runs them on first use and joins what the charts need.
"use strict";
globalThis.tunicaReport = (() => {
  const bodies = new Map(), loaded = new Map();
  const load = (name) => {
    if (loaded.has(name)) return loaded.get(name);
    const module = {exports: {}};
    loaded.set(name, module.exports);
    // What has no body is a neighbour that no chart uses (map projections).
    if (bodies.has(name)) bodies.get(name)(module.exports, load, module);
    return module.exports;
  };
  return {
    define: (name, body) => bodies.set(name, body),
    vega: () => {
      const {extend} = load("vega-util"), {transforms} = load("vega-dataflow");
      for (const name of ["vega-transforms", "vega-view-transforms", "vega-encode", "vega-geo"])
        extend(transforms, load(name));
      const {expressionInterpreter} = load("vega-interpreter");
      return {View: load("vega-view").View, parse: load("vega-parser").parse, expressionInterpreter};
    },
  };
})();
