// SPDX-License-Identifier: Apache-2.0
// Changes of an experiment file, as a user would type them.

/** The place of a parameter's settings: "mu" of the model, "mechanism.mu" of one of its mechanisms. None for others. */
export function settings(document, model, name) {
  const entry = document.models?.[model];
  if (!entry) return null;
  const dot = name.lastIndexOf("."), own = dot < 0 ? name : name.slice(dot + 1), prefix = dot < 0 ? "" : name.slice(0, dot);
  const owner = prefix === "" ? entry : (entry.mechanisms ?? []).find((one) => (one.as ?? one.type) === prefix);
  if (!owner || typeof owner !== "object") return null;
  return { own, owner };
}

/** Bounds and initial values of sliders. */
export function setParameters(document, model, parameters, values) {
  parameters.forEach((p, k) => {
    const found = settings(document, model, p.name);
    if (!found) return;
    const { owner, own } = found, before = owner.parameters?.[own] ?? {};
    owner.parameters = { ...owner.parameters, [own]: { ...before, ...(p.changed ? { min: p.min, max: p.max } : {}), initial: values[k] } };
  });
}

/** Another model in place of `name`, under its own name, in all runs and in the diagnosis. */
export function setModel(document, name, type, options) {
  const models = {};
  for (const [key, entry] of Object.entries(document.models)) models[key === name ? type : key] = key === name ? { type, ...options } : entry;
  document.models = models;
  for (const run of document.runs ?? []) if (run.model === name) run.model = type;
  if (document.diagnosis?.model === name) document.diagnosis.model = type;
}

/** Which tests every run fits, and which are predicted only. */
export function setTests(document, used, heldOut, weights) {
  for (const run of document.runs ?? []) run.tests = used;
  for (const name of Object.keys(document.tests)) {
    const test = document.tests[name];
    if (heldOut.has(name)) test.hold_out = true;
    else if (test.hold_out === true) delete test.hold_out;
    if (weights.has(name)) test.weight = weights.get(name);
  }
}

/** What a cause of the group "file" says instead, as its `mend` has it; false where that is no key of the data. */
export function mend(document, cause) {
  const [, measure] = cause.mend.match(/^"stress_measure": "(\w+)"/) ?? [];
  if (measure) {
    for (const test of cause.tests) document.tests[test].data.stress_measure = measure;
    return true;
  }
  const [, mechanisms] = cause.mend.match(/^"mechanisms": (\[.*?\]) into/) ?? [];
  if (!mechanisms) return false;
  for (const test of cause.tests) document.tests[test].mechanisms = [...(document.tests[test].mechanisms ?? []), ...JSON.parse(mechanisms)];
  return true;
}

/** The runs of `model` become one for each optimiser, at one budget. */
export function setRuns(document, model, optimizers, budget) {
  const first = (document.runs ?? []).find((run) => run.model === model) ?? { model };
  document.optimizers = { ...document.optimizers };
  for (const [name, entry] of optimizers) document.optimizers[name] ??= entry;
  document.runs = optimizers.map(([name]) => ({ ...first, optimizer: name }));
  for (const run of document.runs) delete run.stop;
  document.stop = { ...document.stop, max_evaluations: budget };
}
