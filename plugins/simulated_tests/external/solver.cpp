// SPDX-License-Identifier: Apache-2.0
#include "solver.hpp"

#include <exception>

#include <fmt/format.h>

#include "process.hpp"
#include "program.hpp"
#include "scratch.hpp"

namespace tunica::external {
namespace {

constexpr std::size_t kept_failures = 3, shown_lines = 5;
constexpr const char* failed_folders = "tunica-failed-*";

}  // namespace

std::variant<Numbers, std::string> Solver::solve(
    const std::function<std::string(const TextTemplate::Place&)>& value) const {
  std::vector<std::string> arguments, texts;
  std::string content = settings_.content;
  for (const TextTemplate& argument : settings_.arguments) {
    arguments.push_back(argument.filled(value));
    content += fmt::format("argument {} {}\n", arguments.back().size(), arguments.back());
  }
  for (const auto& [name, text] : settings_.templates) {
    texts.push_back(text.filled(value));
    content += fmt::format("text {} {} {}\n", name, texts.back().size(), texts.back());
  }
  const std::string key = digest(content);
  if (auto numbers = cache_.find(key)) {
    ++cached_;
    return std::move(*numbers);
  }
  if (interrupted()) return std::string("the work was interrupted, or its max_time was over");
  ++runs_;
  auto found = [&]() -> std::variant<Numbers, std::string> {
    try {
      return run_in_scratch(arguments, texts);
    } catch (const std::exception& problem) {
      return std::string(problem.what());
    }
  }();
  if (const auto* numbers = std::get_if<Numbers>(&found))
    cache_.keep(key, *numbers);
  else if (!interrupted())
    ++failed_;
  return found;
}

bool Solver::interrupted() const { return settings_.interrupted && settings_.interrupted(); }

std::variant<Numbers, std::string> Solver::run_in_scratch(const std::vector<std::string>& arguments,
                                                          const std::vector<std::string>& texts) const {
  Scratch scratch(settings_.scratch, settings_.keep == Keep::always);
  for (const auto& [name, file] : settings_.files) std::filesystem::create_symlink(file, scratch.folder() / name);
  for (std::size_t k = 0; k < texts.size(); ++k) scratch.write(settings_.templates[k].first, texts[k]);
  Command command;
  command.words = {settings_.program.string()};
  command.words.insert(command.words.end(), arguments.begin(), arguments.end());
  command.folder = scratch.folder();
  command.output = scratch.folder() / printed;
  command.environment = {{"OMP_NUM_THREADS", std::to_string(settings_.threads)}};
  command.seconds = settings_.time_limit;
  command.mebibytes = settings_.memory_limit;
  command.file_mebibytes = settings_.output_limit;
  if (settings_.keep == Keep::never || settings_.keep == Keep::on_failure) command.discarded = scratch.folder();
  command.interrupted = settings_.interrupted;
  const Ending ending = run(command);
  std::string problem = ending.good() ? "" : ending.words;
  Numbers numbers;
  for (const ResultPlace& place : settings_.results) {
    if (!problem.empty()) break;
    ResultPlace here = place;
    if (here.file == "-") here.file = printed;
    auto found = read_result(here, scratch.folder());
    if (auto* values = std::get_if<std::vector<double>>(&found))
      numbers.push_back(std::move(*values));
    else
      problem = fmt::format("ended well, but {}", std::get<std::string>(found));
  }
  if (problem.empty()) return numbers;
  std::string words = fmt::format("'{}' {}. The last lines of its output: {}", settings_.program.filename().string(),
                                  problem, last_lines(scratch.folder() / printed, shown_lines));
  // Runs that fail in the same way have the same message, so results count them together.
  if (settings_.keep == Keep::never || ending.interrupted) return words;
  if (settings_.keep == Keep::on_failure && failed_ < kept_failures) scratch.keep_as_failed();
  return words + fmt::format(". The files of failed runs are in {}", (settings_.scratch / failed_folders).string());
}

std::vector<Effort> Solver::efforts() const {
  return {{"solver_runs", runs_}, {"failed_runs", failed_}, {"cached_results", cached_}};
}

}  // namespace tunica::external
