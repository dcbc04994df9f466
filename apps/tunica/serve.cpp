// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include "answer.hpp"
#include "data/nearest.hpp"
#include "execution/interrupt.hpp"
#include "execution/plan.hpp"
#include "exit_codes.hpp"
#include "http_server.hpp"
#include "listening_socket.hpp"
#include "serving/um_bridge.hpp"
#include "supervisor.hpp"
#include "text/aside.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct ServeOptions {
  std::string file, run, host = "127.0.0.1";
  int port = 4242;
  unsigned threads = static_cast<unsigned>(tbb::info::default_concurrency());
};

const execution::PlannedRun& chosen(const execution::Plan& plan, const std::string& label) {
  if (plan.runs.empty()) throw InputError("the experiment has no runs, so there is nothing to serve");
  if (label.empty()) return plan.runs.front();
  std::vector<std::string> labels;
  for (const auto& run : plan.runs) {
    if (run.label == label) return run;
    labels.push_back(run.label);
  }
  throw InputError(fmt::format("--run: there is no run '{}'. {}", label, data::suggestion(label, labels)));
}

/// The parameters and a vector as long as an output, with room for how a program writes numbers.
std::size_t largest_body(const serving::ServedRun& served) {
  constexpr std::size_t number = 64;  // bytes
  std::size_t longest = 0;
  for (const auto function : {serving::ServedRun::Function::residuals, serving::ServedRun::Function::predictions})
    for (const std::size_t size : served.output_sizes(function)) longest = std::max(longest, size);
  return number * (longest + served.input_size());
}

int serve(const GlobalOptions& global, const ServeOptions& options) {
  const Session session(global);
  const auto experiment = session.read(options.file);
  const auto plan = execution::make_plan(experiment, session.catalogue());
  const auto& run = chosen(plan, options.run);
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const serving::ServedRun served(*run.assembly);
  const execution::InterruptWatch interrupts;
  HttpService service;
  service.host = options.host;
  service.port = options.port;
  service.threads = options.threads;
  service.largest_body = largest_body(served);
  service.got = {"/Info"};
  service.posted = serving::posted_paths();
  service.answer = [&served](const std::string& path, const std::string& body) -> HttpReply {
    serving::Answer answer = serving::answer(served, path, body);
    return {answer.status, std::move(answer.body)};
  };
  service.listening = [&](int port) {
    std::vector<std::string> names;
    for (const auto& parameter : served.layout().parameters) names.push_back(parameter.name);
    if (supervised::successor()) return;  // it is said
    answer("http://{}:{}\n", in_url(options.host), port);
    flush_answer();
    supervised::serves();
    text::aside("{}: objective, residuals and predictions of {}; Ctrl-C ends it\n", run.label, fmt::join(names, ", "));
    std::vector<std::string> others;
    for (const auto& other : plan.runs)
      if (other.label != run.label) others.push_back(other.label);
    if (options.run.empty() && !others.empty())
      text::aside("the first run is served; for {} say --run\n", fmt::join(others, ", "));
  };
  service.over = [] { return execution::InterruptWatch::interrupted(); };
  serve_http(service);
  return done;
}

}  // namespace

void add_serve(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<ServeOptions>();
  auto* verb =
      app.add_subcommand("serve", "Answer questions about a run by HTTP (UM-Bridge), for programs of your own");
  verb->add_option("experiment", options->file, "Experiment file")->required()->type_name("EXP");
  verb->add_option("--run", options->run, "Run of the experiment: MODEL/OPTIMIZER (default: the first)")
      ->type_name("RUN");
  verb->add_option("--port", options->port, "Port; 0 = any that is free (default: 4242)")
      ->check(CLI::Range(0, 65535))
      ->type_name("N");
  verb->add_option("-j,--threads", options->threads,
                   "Threads for requests and what they ask for (default: all of the machine)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_option("--host", options->host, "Address to listen on (default: 127.0.0.1, this machine only)")
      ->type_name("ADDRESS");
  verb->footer(
      "Examples:\n"
      "  tunica serve experiment.json\n"
      "  tunica serve experiment.json --run gho/lm --port 0");
  verb->callback([&global, &action, options] { action = [&global, options] { return serve(global, *options); }; });
}

}  // namespace tunica::app
