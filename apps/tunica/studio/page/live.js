// SPDX-License-Identifier: Apache-2.0
// Predictions: over one connection that stays open, for a request a move costs a browser more than the answer does.
import { post, refusal } from "./server.js";

/** Bytes of Workbench::simulate(): a length, JSON, and a float a row. */
export function decoded(buffer) {
  const length = new Uint32Array(buffer, 0, 1)[0], head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  let at = 4 + length;
  head.channels = (head.rows ?? []).map((rows) => {
    const values = new Float32Array(buffer, at, rows);
    at += 4 * rows;
    return values;
  });
  return head;
}

const simulated = async (question) => decoded(await (await post("simulate", question)).arrayBuffer());

/** After a refused connection the next one is tried later, ms: the server holds a few only. */
const patience = 10000;
let live = null, next = 0;

/** {socket, asked(question)}: a connection with its own questions, which become requests where it ends before. */
function connection() {
  const socket = new WebSocket(`ws://${location.host}/api/live`), waiting = [];
  let opened = false;
  socket.binaryType = "arraybuffer";
  socket.addEventListener("open", () => { opened = true; });
  socket.addEventListener("message", ({ data }) => {
    const one = waiting.shift();
    try {
      if (typeof data === "string") throw refusal(data);
      one?.done(decoded(data));
    } catch (error) {
      one?.fail(error);
    }
  });
  socket.addEventListener("close", () => {
    if (!opened) next = Date.now() + patience;
    waiting.splice(0).forEach((one) => simulated(one.question).then(one.done, one.fail));
  });
  return { socket, asked: (question) => new Promise((done, fail) => {
    waiting.push({ question, done, fail });
    socket.send(JSON.stringify(question));
  }) };
}

/** Answers come in the order of the questions. While the connection is being made, and where there is none, it is a request. */
export function simulate(question) {
  const state = live?.socket.readyState;
  if (state === WebSocket.OPEN) return live.asked(question);
  if (state !== WebSocket.CONNECTING && Date.now() >= next) live = connection();
  return simulated(question);
}
