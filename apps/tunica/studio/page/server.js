// SPDX-License-Identifier: Apache-2.0
// What the page asks of the server. Errors carry the words of the program.
let viewed = "/";

/** What a refusal says: the "error" of JSON, or a plain text as it is. */
export function refusal(text) {
  let words = text;
  try {
    words = JSON.parse(text).error ?? text;
  } catch {} // it is plain text
  return new Error(typeof words === "string" ? words : words.message ?? text);
}

async function whole(response) {
  if (response.ok) return response;
  throw refusal(await response.text());
}

async function reach(path, options) {
  try {
    return await fetch(path, options);
  } catch {
    throw new Error("the server does not answer; it was ended, or the machine slept. Start `tunica studio` again and open its address");
  }
}

export const post = async (what, question) => whole(await reach(`/api/${what}`, { method: "POST", body: JSON.stringify(question) }));
export const ask = async (what, question = {}) => (await post(what, question)).json();

/** Writes a change of what `document` has answered; refused where the file is another one meanwhile. */
export const save = (file, read, document, as_new = false) => ask("save", { file, hash: read.hash, document, as_new });

export const upload = async (file) =>
  (await whole(await reach(`/api/upload?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file }))).json();

export async function project() {
  const all = await ask("project");
  viewed = all.view;
  return all;
}

/** The address of a file of the project, for links. */
export const view = (name) => viewed + name.split("/").map(encodeURIComponent).join("/");

async function shown(name) {
  if (viewed === "/") await project();
  return whole(await reach(view(name)));
}
/** A file of the project, as text. */
export const file = async (name) => (await shown(name)).text();
export const result = async (folder) => (await shown(`${folder}/result.json`)).json();

const followed = new Set();

/** Listens to a job until its end; `lost()` where the server does not answer. Returns a function that stops listening. */
export function follow(id, { begin, progress, end, lost }) {
  const source = new EventSource(`/api/events?name=${encodeURIComponent(id)}`);
  followed.add(source);
  source.addEventListener("begin", () => begin?.());
  source.addEventListener("error", () => lost?.());
  source.addEventListener("progress", (event) => progress?.(JSON.parse(event.data)));
  const leave = () => { source.close(); followed.delete(source); };
  source.addEventListener("end", (event) => {
    leave();
    end?.(JSON.parse(event.data));
  });
  return leave;
}

/** Stops listening to every job, whoever follows it: another page is shown. */
export function unfollow() {
  followed.forEach((source) => source.close());
  followed.clear();
}
