// SPDX-License-Identifier: Apache-2.0
// Changes of an experiment file, as a user would type them. Only what is shown changes; the rest of the file stays.

const isObject = (one) => one !== null && typeof one === "object" && !Array.isArray(one);

/** Whoever may own parameters of a run, by what stands before their names: models, tests, and mechanisms of both. */
function* owners(document, run) {
  const withMechanisms = function* (entry, prefix) {
    if (!isObject(entry)) return;
    yield [prefix, entry];
    for (const one of entry.mechanisms ?? []) if (isObject(one)) yield [`${prefix}${one.as ?? one.type}.`, one];
  };
  yield* withMechanisms(document.models?.[run.model], "");
  for (const [name, test] of Object.entries(isObject(run.tests) ? run.tests : document.tests ?? {})) yield* withMechanisms(test, `${name}.`);
  for (const [name, model] of Object.entries(document.models ?? {})) yield* withMechanisms(model, `${name}.`); // of layers
}

/** The place of a parameter's settings: "mu" of the model, "viscoelasticity.tau" of a mechanism, "strip.force_offset.value" of a test's. */
export function settings(document, run, name) {
  const end = name.lastIndexOf(".") + 1, prefix = name.slice(0, end);
  for (const [before, owner] of owners(document, run)) if (before === prefix) return { own: name.slice(end), owner };
  throw new Error(`the page finds no place for '${name}' in the file; write its values there by hand`);
}

/** Bounds and initial values of sliders that differ from what the file says. */
export function setParameters(document, entry, parameters, values) {
  parameters.forEach((p, k) => {
    if (!p.changed && values[k] === p.initial) return;
    const { owner, own } = settings(document, document.runs[entry], p.name), before = owner.parameters?.[own];
    owner.parameters = { ...owner.parameters, [own]: { ...(isObject(before) ? before : {}), ...(p.changed ? { min: p.min, max: p.max } : {}), initial: values[k] } };
  });
}

/** `wished`, or "wished_2" where that is taken, and so on. */
function freeName(entries, wished) {
  let name = wished;
  for (let k = 2; name in entries; k++) name = `${wished}_${k}`;
  return name;
}

/** Another model for one run: one of the file that has this type, else a new one with the mechanisms of the last. */
export function setModel(document, entry, type, options) {
  const run = document.runs[entry], before = run.model;
  if (!before) throw new Error("the tests of this run name their models in \"layers\"; change them in the file");
  let name = Object.keys(document.models).find((key) => document.models[key].type === type);
  if (!name) {
    name = freeName(document.models, type);
    const { mechanisms } = document.models[before];
    document.models[name] = { type, ...options, ...(mechanisms ? { mechanisms: structuredClone(mechanisms) } : {}) };
  }
  run.model = name;
  if (document.diagnosis?.model === before && !document.runs.some((one) => one.model === before)) document.diagnosis.model = name;
}

/** Which tests a run fits; and which are predicted only, and how much they weigh, in every run. */
export function setTests(document, entry, used, heldOut, weights) {
  const run = document.runs[entry], all = Object.keys(document.tests);
  if (run.tests || used.length < all.length) run.tests = used;
  for (const name of all) {
    const test = document.tests[name];
    if (heldOut.has(name)) test.hold_out = true;
    else if (test.hold_out === true) delete test.hold_out;
    if (weights.has(name)) test.weight = weights.get(name);
  }
}

/** A copy with values added as a JSON Patch of "add" has them (RFC 6902). */
export function patched(document, changes) {
  const copy = structuredClone(document);
  for (const { path, value } of changes) {
    const keys = path.slice(1).split("/").map((key) => key.replaceAll("~1", "/").replaceAll("~0", "~")), last = keys.pop();
    const place = keys.reduce((at, key) => (at !== null && typeof at === "object" && Object.hasOwn(at, key) ? at[key] : undefined), copy);
    if (place === undefined || place === null || typeof place !== "object") throw new Error(`the file has no place ${path}; make the change there by hand`);
    if (last === "-") place.push(value); else place[last] = value;
  }
  return copy;
}

/** A run of the first run's model for each optimiser, at one budget; every other run stays. */
export function setRuns(document, optimizers, budget) {
  const first = document.runs?.[0] ?? { model: Object.keys(document.models)[0] };
  document.runs ??= [];
  document.optimizers ??= {};
  for (const [wished, settled] of optimizers) {
    const same = Object.entries(document.optimizers).find(([, one]) => JSON.stringify(one) === JSON.stringify(settled));
    const optimizer = same?.[0] ?? freeName(document.optimizers, wished);
    document.optimizers[optimizer] ??= settled;
    let run = document.runs.find((one) => one.model === first.model && one.optimizer === optimizer);
    if (!run) document.runs.push((run = { ...structuredClone(first), optimizer }));
    run.stop = { ...(run.stop ?? document.stop), max_evaluations: budget };
  }
}
