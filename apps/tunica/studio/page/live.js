// SPDX-License-Identifier: Apache-2.0
// Predictions: over one connection that stays open, for a request a move costs a browser more than the answer does.
import { post } from "./server.js";

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

let socket = null, waiting = [];

function open() {
  socket = new WebSocket(`ws://${location.host}/api/live`);
  socket.binaryType = "arraybuffer";
  socket.addEventListener("message", ({ data }) => {
    const one = waiting.shift();
    if (typeof data === "string") one.fail(new Error(JSON.parse(data).error ?? data)); else one.done(decoded(data));
  });
  socket.addEventListener("close", () => {
    const left = waiting;
    waiting = [];
    left.forEach((one) => simulated(one.question).then(one.done, one.fail));
  });
}

const simulated = async (question) => decoded(await (await post("simulate", question)).arrayBuffer());

/** Answers come in the order of the questions. While the connection is being made, and where there is none, it is a request. */
export function simulate(question) {
  if (socket?.readyState === WebSocket.OPEN)
    return new Promise((done, fail) => {
      waiting.push({ question, done, fail });
      socket.send(JSON.stringify(question));
    });
  if (socket?.readyState !== WebSocket.CONNECTING) open();
  return simulated(question);
}
