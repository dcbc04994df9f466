// SPDX-License-Identifier: Apache-2.0
// Measured and fitted curves of a result, from the tables fit_<test>.csv in its folder.
import { chart } from "./chart.js";
import { file } from "./server.js";
import { axis, plain } from "./words.js";

/** Cells of a CSV file (RFC 4180): a list of rows. */
export function cells(text) {
  const rows = [[]];
  for (const [, quoted, bare, end] of text.matchAll(/(?:"((?:[^"]|"")*)"|([^",\r\n]*))(,|\r?\n|$)/g)) {
    rows.at(-1).push(quoted === undefined ? bare : quoted.replaceAll('""', '"'));
    if (end === "") break;
    if (end !== ",") rows.push([]);
  }
  return rows.filter((row) => row.length > 1 || row[0] !== "");
}

/** Rows of a table as objects by column. */
export function table(text) {
  const [head = [], ...rows] = cells(text);
  return rows.map((row) => Object.fromEntries(head.map((name, k) => [name, row[k] ?? ""])));
}

const asNumber = (cell) => (cell === "" || cell === undefined ? null : Number(cell));

/** Columns of one channel in the rows of one run: {x, measured, predicted, over, unit}; null where the file has none. */
function channelOf(rows, channel, over) {
  const names = Object.keys(rows[0] ?? {}), of = (name) => names.find((one) => one === name || one.startsWith(`${name} [`));
  const [x, measured, predicted] = [of(over), of(channel), of(`${channel}.predicted`)];
  if (!x || !predicted) return null;
  return { x: rows.map((row) => asNumber(row[x])), measured: measured ? rows.map((row) => asNumber(row[measured])) : [],
    predicted: rows.map((row) => asNumber(row[predicted])), over: x.match(/\[(.*)\]$/)?.[1] ?? "", unit: predicted.match(/\[(.*)\]$/)?.[1] ?? "" };
}

/** Rows at which a family begins anew: back by half of the range in one step. */
function returns(x) {
  const known = x.filter((v) => v !== null), range = Math.max(...known) - Math.min(...known);
  return x.map((v, k) => (k > 0 && v < x[k - 1] - range / 2 ? k : -1)).filter((k) => k > 0);
}

/** A chart for each channel of the tests of a run: {run, per_test} as result.json has it. */
export async function curvesOf(folder, run, perTest, options = {}) {
  const tests = Object.entries(perTest ?? {}).map(async ([test, { channels }]) => {
    const rows = table(await file(`${folder}/fit_${test}.csv`)).filter((row) => row.run === run);
    const seen = new Set(channels.map((one) => one.channel));
    return [...seen].map((channel) => {
      const over = channels.find((one) => one.channel === channel).over, found = channelOf(rows, channel, over);
      if (!found) return null;
      return chart({ title: seen.size > 1 ? `${plain(test)}, ${plain(channel)}` : plain(test), x: axis(over, found.over), y: axis(channel, found.unit), height: 240, ...options,
        series: [{ name: "measured", x: found.x, y: found.measured, points: true }, { name: run, x: found.x, y: found.predicted, colour: 0, breaks: returns(found.x) }] }).node;
    });
  });
  return (await Promise.all(tests)).flat().filter(Boolean);
}
