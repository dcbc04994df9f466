// SPDX-License-Identifier: Apache-2.0
// bench_performance [--only REGEX] [--list] [--quick] [--rounds N] [--bare]: measures rows in this process and prints
// one JSON object a line; --bare leaves floors and peers out. bench/bench.py calls it, adds rows of whole programs and
// peers, and writes the tables.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <regex>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "rows.hpp"

namespace tunica::bench {

std::vector<const floors::Kernels*> levels() {
  std::vector<const floors::Kernels*> found{&floors::baseline()};
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    found.push_back(&floors::avx2());
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
      found.push_back(&floors::avx512());
  }
#endif
  return found;
}

namespace {

struct Scratch {
  std::filesystem::path path;
  Scratch() : path(std::filesystem::temp_directory_path() / fmt::format("tunica_bench_{}", ::getpid())) {
    std::filesystem::create_directories(path);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

using Json = nlohmann::ordered_json;

Json json_of(const Row& row, const Measured& measured) {
  const char* const level = std::getenv("TUNICA_VECTOR_LEVEL");
  Json json{{"name", row.name + (level == nullptr ? "" : fmt::format("@{}", level))},
            {"what", row.what},
            {"unit", row.unit},
            {"size", row.by.empty() ? "" : fmt::format("{} {}", row.sizes.front(), row.by)},
            {"clock", row.clock == Clock::thread ? "thread" : "wall"},
            {"time_s", measured.time.median},
            {"spread", measured.time.spread},
            {"repeats", measured.repeats},
            {"floors", Json::array()},
            {"peers", Json::array()},
            {"growth", nullptr},
            {"facts", Json::object()},
            {"samples_s", measured.samples}};
  const auto add = [&](const char* key, const std::vector<MeasuredFloor>& found) {
    for (const MeasuredFloor& one : found)
      json[key].push_back({{"what", one.what}, {"level", one.level}, {"time_s", one.time}, {"ratio", one.ratio}});
  };
  add("floors", measured.floors);
  add("peers", measured.peers);
  if (measured.growth.size() >= 3) {
    json["growth"] = {
        {"by", row.by}, {"sizes", Json::array()}, {"times_s", Json::array()}, {"exponent", measured.exponent}};
    for (const auto& [size, seconds] : measured.growth) {
      json["growth"]["sizes"].push_back(size);
      json["growth"]["times_s"].push_back(seconds);
    }
  }
  for (const auto& [name, value] : measured.facts) json["facts"][name] = value;
  return json;
}

/// Most memory that this process has had, in bytes.
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::strtod(line.c_str() + 6, nullptr);
  return 0;
}

/// The same of a new process that does the work of a row once.
double peak_memory_of(const Row& row) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe"), answer = scratch() / "peak";
  const std::string command = fmt::format("'{}' --peak-memory '{}' > '{}'", self.string(), row.name, answer.string());
  if (std::system(command.c_str()) != 0) throw std::runtime_error(row.name + " fails in a process of its own");
  double bytes = 0;
  std::ifstream(answer) >> bytes;
  return bytes;
}

int run(std::span<char*> arguments) {
  std::string only = ".*", once;
  bool list = false;
  Effort effort;
  for (std::size_t k = 1; k < arguments.size(); ++k) {
    const std::string_view word = arguments[k];
    const bool has_value = k + 1 < arguments.size();
    if (word == "--list") {
      list = true;
    } else if (word == "--quick") {
      effort = {.rounds = 3, .sample = 2e-4, .most = 0.1, .all_sizes = false};
    } else if (word == "--bare") {
      bare = true;
    } else if (word == "--only" && has_value) {
      only = arguments[++k];
    } else if (word == "--peak-memory" && has_value) {
      once = arguments[++k];
      bare = true;
    } else if (word == "--rounds" && has_value) {
      effort.rounds = std::strtoull(arguments[++k], nullptr, 10);
      effort.all_sizes = false;
    } else {
      fmt::print(stderr, "usage: bench_performance [--only REGEX] [--list] [--quick] [--rounds N] [--bare]\n");
      return 2;
    }
  }
  if (effort.rounds == 0) effort.rounds = 1;
  effort.floors = !bare;
  const std::regex wanted(only);
  for (const auto& rows : {point_rows(), test_rows(), fe_rows(), extension_rows(), search_rows(), journal_rows()})
    for (const Row& row : rows) {
      if (once.empty() ? !std::regex_search(row.name, wanted) : row.name != once) continue;
      if (list) {
        std::cout << row.name << '\n';
      } else if (!once.empty()) {
        row.make(row.sizes.front()).work.call();
        std::cout << peak_memory() << '\n';
      } else {
        Measured measured = measure(row, effort);
        if (row.shows_memory && effort.all_sizes) measured.facts.emplace_back("peak_memory_bytes", peak_memory_of(row));
        std::cout << json_of(row, measured).dump() << std::endl;
      }
    }
  return 0;
}

}  // namespace

const std::filesystem::path& scratch() {
  static const Scratch folder;
  return folder.path;
}

}  // namespace tunica::bench

int main(int count, char** arguments) {
  try {
    return tunica::bench::run({arguments, static_cast<std::size_t>(count)});
  } catch (const std::exception& problem) {
    fmt::print(stderr, "bench_performance: {}\n", problem.what());
    return 1;
  }
}
