// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "answer.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

int write_schema(const GlobalOptions& global, const std::string& file) {
  const Session session(global);
  std::string schema = experiment::compose_schema(session.catalogue());
  if (schema.empty() || schema.back() != '\n') schema += '\n';
  if (file.empty())
    answer("{}", schema);
  else
    execution::write_atomically(file, schema);
  return done;
}

}  // namespace

void add_schema(CLI::App& app, GlobalOptions& global, Action& action) {
  auto file = std::make_shared<std::string>();
  auto* verb =
      app.add_subcommand("schema", "Print the JSON Schema of experiment files, composed from the loaded plugins");
  verb->add_option("-o,--output", *file, "Write to this file instead of stdout")->type_name("FILE");
  verb->footer(
      "Examples:\n  tunica schema > tunica-experiment.schema.json\n"
      "  tunica schema --plugin-path my_plugins -o tunica-experiment.schema.json");
  verb->callback([&global, &action, file] { action = [&global, file] { return write_schema(global, *file); }; });
}

}  // namespace tunica::app
