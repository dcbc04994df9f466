// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "answer.hpp"
#include "cards/card.hpp"
#include "cards/card_name.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "exporting/fitted_material.hpp"
#include "finite_range.hpp"
#include "session.hpp"
#include "tunica/error.hpp"
#include "unfinished_results.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct ExportOptions {
  std::string result, target, run, model, name, units = "mm-N-MPa", density, subroutine, file;
  std::optional<double> bulk_ratio;
};

int export_card(const GlobalOptions& global, const ExportOptions& options) {
  const cards::Target target = cards::target_of(options.target);
  const cards::UnitSystem units = cards::unit_system(options.units);
  const Session session(global);
  const auto fitted = exporting::fitted_material({options.result, options.run, options.model}, session.catalogue());
  std::optional<double> density;
  if (!options.density.empty()) density = cards::density_of(options.density);
  for (const auto& [option, file] : {std::pair("-o", options.file), std::pair("--subroutine", options.subroutine)})
    if (!file.empty() && std::filesystem::exists(file))
      throw InputError(fmt::format("{} {}: is there already; name a new file", option, file));
  const std::string card =
      cards::write_card(target, fitted.material,
                        {.name = options.name.empty() ? cards::card_name(fitted.name) : options.name,
                         .units = units,
                         .bulk_ratio = options.bulk_ratio,
                         .density = density,
                         .subroutine = !options.subroutine.empty(),
                         .remarks = fitted.remarks});
  UnfinishedResults files({options.subroutine, options.file}, "interrupted; nothing is left behind\n");
  if (!options.subroutine.empty()) execution::write_atomically(options.subroutine, cards::uanisohyper_inv());
  if (options.file.empty()) {
    files.keep();
    answer("{}", card);
    return done;
  }
  execution::write_atomically(options.file, card);
  files.keep();
  answer("{}\n", options.file);
  if (!options.subroutine.empty()) answer("{}\n", options.subroutine);
  return done;
}

}  // namespace

void add_export(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<ExportOptions>();
  auto* verb = app.add_subcommand("export", "Write the material card of a fit for a finite-element program");
  verb->add_option("result", options->result, "Folder that `tunica run` has written")->required()->type_name("RESULT");
  verb->add_option("--to", options->target, "The program that reads the card")
      ->required()
      ->type_name("febio|abaqus|ansys|calculix|lsdyna");
  verb->add_option("--run", options->run, "A run of the result (default: the best-ranked one)")->type_name("RUN");
  verb->add_option("--model", options->model, "A model of the run, where layers have several")->type_name("M");
  verb->add_option("--units", options->units, "Consistent units of the card: length-force-stress")
      ->capture_default_str()
      ->type_name("UNITS");
  verb->add_option("--name", options->name, "Name of the material (default: the model's)")->type_name("NAME");
  verb->add_option("--bulk-ratio", options->bulk_ratio,
                   "Bulk modulus over the stiffness at rest; 0 = incompressible (default: 0 for abaqus and ansys, 1000 "
                   "for lsdyna, else 10000)")
      ->check(FiniteRange(0, 1e9))
      ->type_name("NUMBER");
  verb->add_option("--density", options->density, "Mass density for febio and lsdyna, for example \"1000 kg/m3\"")
      ->type_name("DENSITY");
  verb->add_option("--subroutine", options->subroutine,
                   "Abaqus: write the user subroutine UANISOHYPER_INV to this file, and the card that calls it")
      ->type_name("FILE");
  verb->add_option("-o,--output", options->file, "New file for the card (default: stdout)")->type_name("FILE");
  verb->footer(
      "Examples:\n"
      "  tunica export results/a --to calculix\n"
      "  tunica export results/a --to abaqus --run gho/lm --units mm-mN-kPa -o wall.inp\n"
      "  tunica export results/a --to abaqus --subroutine wall.f -o wall.inp\n\n"
      "The card says where its numbers come from, over which range they were fitted, and\n"
      "how sure they are. What a program cannot express is refused with the reason.\n"
      "docs/export.md derives every number.");
  verb->callback(
      [&global, &action, options] { action = [&global, options] { return export_card(global, *options); }; });
}

}  // namespace tunica::app
