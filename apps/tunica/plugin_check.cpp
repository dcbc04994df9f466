// SPDX-License-Identifier: Apache-2.0
#include "conformance/plugin_check.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "answer.hpp"
#include "exit_codes.hpp"
#include "finite_range.hpp"
#include "messages.hpp"
#include "plugin.hpp"
#include "plugins/loader.hpp"
#include "results/keys.hpp"
#include "text/escaped.hpp"
#include "text/lists.hpp"
#include "text/wrapping.hpp"
#include "tunica/error.hpp"

namespace tunica::app {

namespace key = results::key;

namespace {

namespace fs = std::filesystem;
using conformance::Finding;
using text::hanging;
using json = nlohmann::ordered_json;

struct Asked {
  std::string file, experiment;
  std::uint64_t seed = conformance::CheckSettings().seed;
  std::vector<std::string> only;
  double time_limit = conformance::CheckSettings().time_limit;
  bool as_json = false;
};

/// The plugin under check before all others, so that its names are its own; the others are its partners.
struct CheckedPlugin {
  plugins::Catalogue catalogue;
  plugins::LoadedPlugin loaded;
  conformance::Contents contents;

  CheckedPlugin(const GlobalOptions& global, const fs::path& file) {
    const bool trusting = global.allow_world_writable_plugins;
    if (!fs::exists(file)) throw InputError(fmt::format("{}: no such file; expected a plugin to check", file.string()));
    try {
      loaded = plugins::load_file(file, catalogue, trusting);
    } catch (const plugins::LoadError& refused) {
      throw PluginRefused(fmt::format("{}: {}", file.string(), refused.what()));
    }
    contents = conformance::contents_of(catalogue);
    std::vector<fs::path> folders;
    for (const fs::path path : global.plugin_paths) {
      if (fs::is_directory(path))
        folders.push_back(path);
      else
        load_partner(path, trusting);
    }
    auto search = plugins::default_search_path(folders);
    search.allow_world_writable = trusting;
    for (const auto& refusal : plugins::load_all(search, catalogue).refused) warn(refusal.file, refusal.reason);
  }

 private:
  void load_partner(const fs::path& path, bool trusting) {
    try {
      plugins::load_file(path, catalogue, trusting);
    } catch (const plugins::LoadError& refused) {
      warn(path, refused.what());
    }
  }
  void warn(const fs::path& file, const std::string& reason) const {
    // The plugin itself, met again on the search path.
    std::error_code error;
    if (fs::equivalent(file, loaded.file, error)) return;
    say_wrapped_warning(fmt::format("plugin {} was refused: {}", file.string(), reason));
  }
};

const char* outcome(const Finding& finding) {
  if (!finding.verdict.skipped.empty()) return "not checked";
  if (finding.verdict.counter_example.empty()) return "ok";
  return finding.advisory ? "noted" : "FAILED";
}

/// One line a property, worst error beside its tolerance; below it what went wrong.
class Table {
 public:
  void add(const Finding& finding) {
    const std::string head = finding.kind + " " + finding.name + (finding.with.empty() ? "" : ", " + finding.with);
    if (head != head_) answer("{}{}\n", head_.empty() ? "" : "\n", hanging("", head));
    head_ = head;
    const conformance::Verdict& verdict = finding.verdict;
    std::string figures;
    if (verdict.skipped.empty() && (verdict.worst > 0 || verdict.tolerance > 0))
      figures = fmt::format("{:.1e} of {:.0e}", verdict.worst, verdict.tolerance);
    std::string line = fmt::format("  {:<11} {}", outcome(finding), finding.property);
    if (!figures.empty()) line = text::pad(line, 64) + " " + figures;
    answer("{}\n", line);
    constexpr const char* indent = "              ";
    if (!verdict.skipped.empty()) answer("{}\n", hanging(indent, verdict.skipped));
    if (verdict.counter_example.empty()) {
      if (!verdict.note.empty() && finding.advisory) answer("{}\n", hanging(indent, verdict.note));
    } else {
      if (!verdict.compared.empty()) answer("{}\n", hanging(indent, "Compared: " + verdict.compared + "."));
      answer("{}\n", hanging(indent, verdict.counter_example));
    }
    flush_answer();
  }

 private:
  std::string head_;
};

json as_json(const Finding& finding) {
  const conformance::Verdict& verdict = finding.verdict;
  json one{{key::kind, finding.kind},         {key::name, finding.name},        {key::with, finding.with},
           {key::property, finding.property}, {key::outcome, outcome(finding)}, {key::compared, verdict.compared}};
  // JSON has no number for an infinite error.
  one[key::worst] = verdict.worst;
  one[key::tolerance] = verdict.tolerance;
  if (!verdict.counter_example.empty()) one[key::counter_example] = verdict.counter_example;
  if (!verdict.skipped.empty()) one[key::reason] = verdict.skipped;
  if (!verdict.note.empty()) one[key::note] = verdict.note;
  one[key::seconds] = finding.seconds;
  return one;
}

int check_plugin(const GlobalOptions& global, const Asked& asked) {
  const CheckedPlugin bench(global, asked.file);
  const std::string plugin = fmt::format("{} {}", bench.loaded.name, bench.loaded.version);
  if (bench.contents.empty())
    throw InputError(
        fmt::format("{}: the plugin '{}' registers nothing; add a factory to the registry in "
                    "TUNICA_PLUGIN",
                    asked.file, plugin));
  conformance::CheckSettings settings{.seed = asked.seed, .only = asked.only, .time_limit = asked.time_limit};
  std::optional<experiment::Experiment> experiment;
  if (!asked.experiment.empty()) {
    experiment = experiment::read_experiment(asked.experiment, bench.catalogue);
    settings.experiment = &*experiment;
  }
  if (!asked.as_json) answer("plugin {} from {}, seed {}\n\n", plugin, asked.file, asked.seed);
  Table table;
  const auto findings = conformance::check_plugin(bench.contents, bench.catalogue, settings, [&](const Finding& one) {
    if (!asked.as_json) table.add(one);
  });
  std::size_t failed = 0, skipped = 0;
  for (const Finding& one : findings) {
    failed += one.failed();
    skipped += !one.verdict.skipped.empty();
  }
  if (asked.as_json) {
    json all{{key::plugin, plugin}, {key::file, asked.file}, {key::seed, asked.seed}, {key::passed, failed == 0}};
    for (const Finding& one : findings) all[key::findings].push_back(as_json(one));
    answer("{}\n", text::plain_json(all.dump(2, ' ', false, json::error_handler_t::replace)));
    return failed == 0 ? done : not_converged;
  }
  const std::string checked = fmt::format("{} of {} held", findings.size() - failed - skipped, findings.size()) +
                              (skipped > 0 ? fmt::format(", {} not checked", skipped) : std::string());
  if (failed == 0)
    answer("\n{}\n", hanging("", fmt::format("In order: {}. Next: an experiment of your own with it, beside a "
                                             "built-in one; put the plugin on TUNICA_PLUGIN_PATH.",
                                             checked)));
  else
    answer("\n{}\n",
           hanging("", fmt::format("NOT in order: {}. Mend the first that failed, since others may "
                                   "follow from it, and check again with --only NAME; what each "
                                   "property means is in docs/plugin-check.md.",
                                   text::counted(failed, "property failed", "properties failed") + ", " + checked)));
  return failed == 0 ? done : not_converged;
}

}  // namespace

void add_plugin_check(CLI::App& plugin, GlobalOptions& global, Action& action) {
  auto asked = std::make_shared<Asked>();
  auto* verb = plugin.add_subcommand("check", "Check every property of a plugin that tunica relies on");
  verb->add_option("file", asked->file, "The plugin, a shared library")->required()->type_name("FILE");
  verb->add_option("--seed", asked->seed, "Seed of the states, parameters and searches that are tried")
      ->check(seed_number())
      ->type_name("S");
  verb->add_option("--only", asked->only, "Check only this property, or this part of the plugin; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME");
  verb->add_option("--experiment", asked->experiment, "Check tests and their mechanisms as they stand in this file")
      ->type_name("EXP");
  verb->add_option("--time-limit", asked->time_limit,
                   fmt::format("Seconds that one property may take; {:g} unless given", asked->time_limit))
      ->check(FiniteRange(1e-6, 86400))
      ->type_name("S");
  verb->add_flag("--json", asked->as_json, "Print the verdicts as JSON");
  verb->footer(
      "Examples:\n  tunica plugin check build/my_model.so\n  tunica plugin check build/my_model.so --only "
      "concurrent_calls_agree\n  tunica plugin check build/my_test.so --experiment experiment.json\n\nExit code 0: "
      "every property holds; 1: one failed; 3: the plugin was refused. Each property is\nchecked in a process of its "
      "own, so a crash is a finding.");
  verb->callback([&global, &action, asked] { action = [&global, asked] { return check_plugin(global, *asked); }; });
}

}  // namespace tunica::app
