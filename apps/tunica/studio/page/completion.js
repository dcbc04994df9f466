// SPDX-License-Identifier: Apache-2.0
// What may stand at a place of an experiment file, by the program's own schema (JSON Schema, draft 7). The text may be half
// written, and may have comments.

const token = /\/\/[^\n]*|\/\*[\s\S]*?(?:\*\/|$)|"(?:[^"\\\n]|\\.)*"|"[^"\\\n,:{}[\]]*|[{}[\],:]|[^\s{}[\],:"/]+|\//g;

/** The structure of a text: nodes {kind, from, to, entries: [{key, keyFrom, keyTo, node}], items}, however broken. */
export function structure(text) {
  const root = { kind: "array", from: 0, to: text.length, items: [] }, stack = [root];
  let entry = null;
  const value = (node) => {
    const top = stack.at(-1);
    if (top.kind === "array") top.items.push(node);
    else if (entry && entry.colon && !entry.node) entry.node = node;
  };
  for (const match of text.matchAll(token)) {
    const [word] = match, from = match.index, to = from + word.length, top = stack.at(-1);
    if (word.startsWith("//") || word.startsWith("/*") || word === "/") continue;
    if (word === "{" || word === "[") {
      const node = word === "{" ? { kind: "object", from, to: text.length + 1, entries: [], above: entry } : { kind: "array", from, to: text.length + 1, items: [], above: entry };
      value(node);
      stack.push(node);
      entry = null;
    } else if (word === "}" || word === "]") {
      if (stack.length > 1) { const closed = stack.pop(); closed.to = to; entry = closed.above; }
    } else if (word === ":") {
      if (entry) { entry.colon = true; entry.colonAt = to; }
    } else if (word === ",") {
      entry = null;
      top.comma = to;
    } else if (top.kind === "object" && !(entry && entry.colon)) {
      entry = { key: word.replace(/^"|"$/g, ""), keyFrom: from, keyTo: to, colon: false, node: null };
      top.entries.push(entry);
    } else value({ kind: "value", from, to, text: word });
  }
  return root.items[0] ?? root;
}

const plainValue = (node) => (node?.kind === "value" ? node.text.replace(/^"|"$/g, "") : undefined);
const member = (node, key) => node?.entries?.find((one) => one.key === key)?.node;

/** Subschemas that hold for a node: references followed, alternatives beside each other, "if" by constants of members. */
function applying(all, schemas, node, depth = 0) {
  if (depth > 12) return [];
  return schemas.flatMap((one) => {
    if (one === true || one === false || !one) return [];
    if (one.$ref) return applying(all, [one.$ref.slice(2).split("/").reduce((at, key) => at?.[key], all)], node, depth + 1);
    const holds = one.if && (one.if.required ?? []).every((key) => member(node, key)) && Object.entries(one.if.properties ?? {}).every(([key, wanted]) => {
      const value = plainValue(member(node, key));
      return value !== undefined && (wanted.const === value || wanted.enum?.includes(value));
    });
    return [one, ...applying(all, [...(one.allOf ?? []), ...(one.anyOf ?? []), ...(one.oneOf ?? []), ...(one.if ? [holds ? one.then : one.else] : [])].filter(Boolean), node, depth + 1)];
  });
}

const below = (schemas, key) => schemas.flatMap((one) => one.properties?.[key] ?? Object.entries(one.patternProperties ?? {}).filter(([pattern]) => new RegExp(pattern, "u").test(key)).map(([, sub]) => sub)
  .concat(one.properties && key in one.properties ? [] : typeof one.additionalProperties === "object" ? [one.additionalProperties] : []));

const inserted = (all, sub) => {
  const kinds = applying(all, [sub], null).flatMap((one) => one.type ?? []);
  return kinds[0] === "object" ? "{}" : kinds[0] === "array" ? "[]" : kinds[0] === "string" ? '""' : "";
};

/** Names that the file itself gives: of models and optimisers in a run, of its tests. */
function namesFor(root, path) {
  const key = path.filter((one) => typeof one === "string").at(-1), list = { model: "models", optimizer: "optimizers", tests: "tests" }[key];
  return list && path.length > 1 && path[0] !== "tests" ? (member(root, list)?.entries ?? []).map((one) => one.key) : [];
}

/** {from, to, options: [{label, insert, about, back: characters from the end where the caret goes}]} at a place of the text. */
export function completions(all, text, caret) {
  const root = structure(text), path = [];
  let node = root, schemas = applying(all, [all], root);
  const none = { from: caret, to: caret, options: [] };
  for (;;) {
    if (node.kind === "array") {
      const inner = node.items.find((one) => one.from <= caret && caret <= one.to), sub = applying(all, schemas.flatMap((one) => one.items ?? []), inner);
      path.push(0);
      if (inner && (inner.kind === "value" || (inner.from < caret && caret < inner.to))) { schemas = sub; node = inner; if (inner.kind === "value") break; continue; }
      schemas = sub;
      node = { kind: "value", from: caret, to: caret, text: "" };
      break;
    }
    if (node.kind !== "object") break;
    const entry = node.entries.find((one) => one.keyFrom <= caret && caret <= one.keyTo);
    const held = node.entries.find((one) => one.node && one.node.from <= caret && caret <= one.node.to && one.node.from < caret + (one.node.kind === "value" ? 1 : 0));
    const open = node.entries.findLast((one) => one.colon && one.colonAt <= caret);
    const isValue = held ?? (open && (!open.node || caret <= open.node.from) && !(node.comma > open.colonAt && caret >= node.comma) ? open : null);
    if (entry || !isValue) {
      const used = new Set(node.entries.filter((one) => one !== entry).map((one) => one.key)), found = new Map();
      for (const one of schemas) for (const [key, sub] of Object.entries(one.properties ?? {})) if (!used.has(key) && !key.startsWith("$")) found.set(key, sub);
      const typed = entry ? text.slice(entry.keyFrom, caret).replace(/^"/, "").toLowerCase() : "";
      return { from: entry?.keyFrom ?? caret, to: entry?.keyTo ?? caret, options: [...found].filter(([key]) => key.toLowerCase().includes(typed)).map(([key, sub]) => {
        const value = entry?.colon ? "" : inserted(all, sub);
        return { label: key, insert: entry?.colon ? `"${key}"` : `"${key}": ${value}`, back: value.length > 1 ? 1 : 0, about: applying(all, [sub], null).find((one) => one.description)?.description ?? "" };
      }) };
    }
    path.push(isValue.key);
    schemas = applying(all, below(schemas, isValue.key), isValue.node);
    if (!isValue.node || isValue.node.from > caret) { node = { kind: "value", from: caret, to: caret, text: "" }; break; }
    node = isValue.node;
    if (node.kind === "value") break;
    if (caret >= node.to) return none;
  }
  if (node.kind !== "value") return none;
  const typed = text.slice(node.from, caret).replace(/^"/, "").toLowerCase(), values = new Map();
  for (const name of namesFor(root, path)) values.set(JSON.stringify(name), "");
  for (const one of schemas) {
    if (one.const !== undefined) values.set(JSON.stringify(one.const), one.description ?? "");
    for (const value of one.enum ?? []) values.set(JSON.stringify(value), one.description ?? "");
    if (one.type === "boolean") for (const value of ["true", "false"]) values.set(value, "");
    if (one.default !== undefined && typeof one.default !== "object") values.set(JSON.stringify(one.default), `the default; ${one.description ?? ""}`);
  }
  return { from: node.from, to: node.to, options: [...values].filter(([value]) => value.replace(/^"/, "").toLowerCase().includes(typed)).map(([value, about]) => ({ label: value, insert: value, back: 0, about })) };
}
