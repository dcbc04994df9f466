// SPDX-License-Identifier: Apache-2.0
export const number = (value, digits = 4) =>
  value === null || value === undefined || !Number.isFinite(value) ? "–"
  : value !== 0 && (Math.abs(value) >= 1e6 || Math.abs(value) < 1e-3) ? value.toExponential(digits - 1)
  : String(Number(value.toPrecision(digits)));

export const percent = (share) =>
  share === null || share === undefined ? "–" : `${Number((100 * share).toPrecision(2))} %`;

/** What a fit misses beyond noise. */
export const missed = (share) => (share === 0 ? "noise only" : percent(share));

export const unit = (text) => (!text || text === "1" ? "" : ` ${text}`);
export const axis = (name, text) => `${name.replaceAll("_", " ")}${!text || text === "1" ? "" : ` (${text})`}`;
export const when = (seconds) => new Date(1000 * seconds).toLocaleString([], { dateStyle: "medium", timeStyle: "short" });
export const plain = (name) => name.replaceAll("_", " ");
export const counted = (count, name) => `${count} ${name}${count === 1 ? "" : "s"}`;
export const capitalised = (words) => words.charAt(0).toUpperCase() + words.slice(1);

/** A word as a shell reads it back. */
export const quoted = (word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

export const states = { running: "running", done: "done", not_converged: "ended without a fit", failed: "failed",
  stopped: "stopped, saved", interrupted: "interrupted" };

export const verdicts = {
  nothing_detected: "Nothing beyond noise was detected", named: "One cause is named",
  indistinguishable: "Several causes explain it equally well", unknown: "The model misses the data, and no cause is known",
  suspect_data: "The data are suspect", discovered: "The energy lacks terms, and these are found", leading: "One cause leads"
};
