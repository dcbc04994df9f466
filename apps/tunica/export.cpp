// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cards/card.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "exporting/fitted_material.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct ExportOptions {
  std::string result, target, run, model, name, units = "mm-N-MPa", file;
  std::optional<double> bulk_ratio;
};

/// The model's name as a card can have it.
std::string card_name(const std::string& model) {
  std::string name;
  for (const char c : model) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  if (name.empty() || !std::isalpha(static_cast<unsigned char>(name.front()))) name = "M_" + name;
  return name.substr(0, 40);
}

int export_card(const ExportOptions& options) {
  const cards::Target target = cards::target_of(options.target);
  const cards::UnitSystem units = cards::unit_system(options.units);
  const auto fitted = exporting::fitted_material({options.result, options.run, options.model});
  const std::string card = cards::write_card(target, fitted.material,
                                             {.name = options.name.empty() ? card_name(fitted.name) : options.name,
                                              .units = units,
                                              .bulk_ratio = options.bulk_ratio,
                                              .remarks = fitted.remarks});
  if (options.file.empty()) {
    fmt::print("{}", card);
    return done;
  }
  const std::filesystem::path file = options.file;
  if (std::filesystem::exists(file))
    throw InputError(fmt::format("-o {}: is there already; name a new file", file.string()));
  execution::write_atomically(file, card);
  fmt::print("{}\n", file.string());
  return done;
}

}  // namespace

void add_export(CLI::App& app, GlobalOptions&, Action& action) {
  auto options = std::make_shared<ExportOptions>();
  auto* verb = app.add_subcommand("export", "Write the material card of a fit for a finite-element program");
  verb->add_option("result", options->result, "Folder that `tunica run` has written")->required()->type_name("RESULT");
  verb->add_option("--to", options->target, "The program that reads the card")
      ->required()
      ->type_name("calculix|abaqus");
  verb->add_option("--run", options->run, "A run of the result (default: the best-ranked one)")->type_name("RUN");
  verb->add_option("--model", options->model, "A model of the run, where layers have several")->type_name("M");
  verb->add_option("--units", options->units, "Consistent units of the card: length-force-stress")
      ->capture_default_str()
      ->type_name("UNITS");
  verb->add_option("--name", options->name, "Name of the material (default: the model's)")->type_name("NAME");
  verb->add_option("--bulk-ratio", options->bulk_ratio,
                   "Bulk modulus over the stiffness at rest; 0 = incompressible (default: 0 for abaqus, else 10000)")
      ->type_name("NUMBER");
  verb->add_option("-o,--output", options->file, "New file for the card (default: stdout)")->type_name("FILE");
  verb->footer(
      "Examples:\n"
      "  tunica export results/a --to calculix\n"
      "  tunica export results/a --to abaqus --run gho/lm --units mm-mN-kPa -o wall.inp\n\n"
      "The card says where its numbers come from, over which range they were fitted, and\n"
      "how sure they are. What a program cannot express is refused with the reason.\n"
      "docs/export.md derives every number.");
  verb->callback([&action, options] { action = [options] { return export_card(*options); }; });
}

}  // namespace tunica::app
