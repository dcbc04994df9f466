// SPDX-License-Identifier: Apache-2.0
// A job as it goes: objective over evaluations, the best parameters, what the program says, stop and resume.
import { chart } from "./chart.js";
import { attempt, el, shell } from "./dom.js";
import { ask, follow, view } from "./server.js";
import { number, states, when } from "./words.js";

/** The page that shows a job while it runs. */
const pageOf = (job) => (job.verb === "discover" ? "causes" : job.verb !== "diagnose" ? "fit" : job.readings ? "model" : "causes");

export function jobLine(job) {
  const line = el("li", {}, el("code", {}, job.command), el("span", { class: "tag" }, states[job.state]), el("small", {}, when(job.started)));
  const go = (kind) => `#/${kind}/${encodeURIComponent(job.experiment)}`;
  if (job.state === "running" && job.experiment) line.append(el("a", { href: go(pageOf(job)) }, "show"));
  if (job.resumable)
    line.append(el("button", { onclick: () => attempt(line, async () => {
      await ask("start", { verb: "run", resume: job.id });
      location.hash = go("fit");
    }) }, "Resume"));
  return line;
}

function liveChart() {
  const series = [], live = new Map();
  let node = el("div"), current = null;
  return {
    node,
    reset() { series.length = 0; live.clear(); node.replaceChildren(); },
    add(rows) {
      for (const [evaluation, run, objective] of rows) {
        if (!live.has(run)) { live.set(run, { name: run, x: [], y: [], colour: live.size % 5, best: Infinity }); series.push(live.get(run)); current = null; }
        const one = live.get(run);
        one.best = Math.min(one.best, objective);
        one.x.push(evaluation);
        one.y.push(one.best);
      }
      if (!series.length) return;
      if (!current) node.replaceChildren((current = chart({ title: "Best objective so far", x: "evaluations", y: "objective", series, logY: true, height: 300 })).node);
      else current.rescale();
    }
  };
}

/** Shows a job in `place`; `ended(job)` is called when it is over. Returns a function that leaves it. */
export function watchJob(place, job, ended) {
  const live = liveChart(), count = el("span"), best = el("div", { class: "scroll" }), words = el("pre", { "aria-label": "What the program says" });
  const state = el("span", { class: "tag", role: "status" }, states[job.state]);
  const stop = el("button", { onclick: () => attempt(place, () => ask("stop", { id: job.id })) }, job.verb === "run" ? "Pause (saves)" : "Stop");
  const bar = el("progress", { "aria-label": "Progress", max: 100 });
  const all = el("details", { open: true }, el("summary", {}, "What the program says"), words);
  place.replaceChildren(el("div", { class: "row" }, el("strong", {}, job.verb), state, count, stop), bar, el("div", { class: "live-two" }, live.node, best), all, shell(job.command));
  const leave = follow(job.id, {
    begin() {
      live.reset();
      state.textContent = states.running;
      state.classList.remove("bad");
    },
    lost() {
      state.textContent = "the server does not answer; where it was ended, start `tunica studio` again";
      state.classList.add("bad");
    },
    progress(news) {
      if (news.rows) live.add(news.rows);
      if (news.count) count.textContent = `${news.count.toLocaleString()} evaluations`;
      const share = [...news.words.matchAll(/(\d+) %/g)].pop();
      if (share) bar.value = Number(share[1]);
      words.textContent = news.words;
      if (news.best)
        best.replaceChildren(el("table", {}, el("tr", {}, el("th", { scope: "col" }, "Best so far"), el("td", { class: "n" }, number(news.best.objective))),
          Object.entries(news.best.parameters).map(([name, value]) => el("tr", {}, el("th", { scope: "row" }, name), el("td", { class: "n" }, number(value))))));
    },
    end(last) {
      bar.remove();
      all.open = !["done", "not_converged"].includes(last.state);
      stop.remove();
      state.textContent = states[last.state];
      state.classList.remove("bad");
      state.classList.add(last.state === "done" ? "good" : "bad");
      words.textContent = last.words;
      if (last.resumable) place.append(resume(place, last, ended));
      document.documentElement.dataset.ended = last.id;
      ended?.(last);
    }
  });
  return leave;
}

const resume = (place, job, ended) => el("button", { class: "main", onclick: () => attempt(place, async () => {
  watchJob(place, await ask("start", { verb: "run", resume: job.id }), ended);
}) }, "Go on where it stopped");

/** The newest job of an experiment with this verb, if it is not superseded. */
export const newest = (all, verb, experiment, readings = false) => all.jobs.find((job) => job.verb === verb && job.experiment === experiment && job.readings === readings);

/** One page, to print. */
export const sheetLink = (folder) => el("a", { class: "button", href: `#/sheet/${encodeURIComponent(folder)}` }, "One page (PDF)");
export const reportLink = (folder, text = "Report") => el("a", { class: "button", href: view(`${folder}/report.html`), target: "_blank", rel: "noopener" }, text);
