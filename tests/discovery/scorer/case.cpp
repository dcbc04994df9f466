// SPDX-License-Identifier: Apache-2.0
#include "case.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "seal.hpp"

namespace blind::score {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

Json parsed(const fs::path& file, const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& problem) {
    throw InputError(file.string() + ": " + problem.what());
  }
}

std::string word(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}
std::optional<double> number(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return {};
  return found->get<double>();
}
const Json& part(const Json& object, const char* key) {
  static const Json nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

/// A target that is no single test – null, or a list – is that of a shared effect.
Target target_of(const Json& object) {
  if (!object.is_object()) return {};
  Target target{word(object, "test"), word(object, "channel")};
  if (const auto row = number(object, "row")) target.row = static_cast<std::size_t>(*row);
  return target;
}

Truth read_truth(const Json& from) {
  Truth truth{.set = from.at("set"),
              .noise = from.at("noise").at("kind"),
              .asked = from.at("lambda_asked"),
              .contaminated = !from.at("gross_errors").empty(),
              .effects = {},
              .look_alike = {},
              .nearest = {}};
  for (const Json& one : from.at("effects"))
    truth.effects.push_back({one.at("id"), target_of(one.at("target")), one.at("amplitude"), one.at("null"),
                             one.at("even"), one.at("reached"), !part(one, "nuisance").empty()});
  if (const Json& known = part(from, "class"); known.is_object()) {
    truth.base = known.at("base");
    truth.protocol = known.at("protocol");
    truth.noise_stated = known.at("noise_stated");
    truth.order_recorded = known.at("order_recorded");
    truth.twin = word(from, "stated_twin");
  }
  if (const Json& outside = part(from, "outside"); !outside.is_null()) {
    truth.look_alike = outside.at("look_alike");
    truth.nearest = outside.at("best");
    truth.remainder = outside.at("remainder");
  }
  return truth;
}

Cause read_cause(const Json& from) {
  Cause cause{.id = from.at("id"),
              .target = target_of(part(from, "target")),
              .probability = number(from, "probability"),
              .amplitude = {},
              .low = {},
              .high = {}};
  const Json& amplitude = part(from, "amplitude");
  if (amplitude.is_object()) cause.amplitude = number(amplitude, "value");
  const Json& ci = part(amplitude, "ci95");
  if (ci.is_array() && ci.size() == 2 && ci[0].is_number() && ci[1].is_number()) {
    cause.low = ci[0];
    cause.high = ci[1];
  }
  cause.hedged = word(from, "claim") == "consistent_with";
  return cause;
}

Verdict read_verdict(const Json& from) {
  Verdict verdict{.verdict = from.at("verdict"), .causes = {}, .ambiguity_set = {}, .confusable = {}, .held_out = {}};
  const std::vector<std::string> known{"nothing_detected", "named",        "indistinguishable",
                                       "unknown",          "suspect_data", "leading"};
  if (std::find(known.begin(), known.end(), verdict.verdict) == known.end())
    throw InputError(
        fmt::format("found the verdict '{}', expected one of {}", verdict.verdict, fmt::join(known, ", ")));
  for (const Json& one : part(from, "causes")) verdict.causes.push_back(read_cause(one));
  for (const Json& one : part(from, "ambiguity_set")) verdict.ambiguity_set.push_back(one);
  for (const Json& one : part(from, "alternatives")) verdict.alternatives.push_back(one);
  for (const Json& one : part(from, "confusable")) {
    const std::string a = one.at("id"), b = one.at("with");
    verdict.confusable[{std::min(a, b), std::max(a, b)}] = one.at("correlation");
  }
  for (const Json& one : part(part(from, "gain"), "held_out"))
    if (const auto p = number(one, "p_value")) verdict.held_out.push_back(*p);
  if (const Json& mechanisms = part(part(from, "extension"), "mechanisms"); mechanisms.is_array())
    verdict.together = mechanisms.size();
  return verdict;
}

Verdict read_result(const fs::path& file) {
  const Json result = parsed(file, text_of(file));
  const Json& diagnosis = part(result, "diagnosis");
  if (!diagnosis.is_object())
    throw InputError(file.string() + ": there is no object 'diagnosis'; expected what `tunica diagnose` writes");
  try {
    return read_verdict(diagnosis);
  } catch (const std::exception& problem) {
    throw InputError(file.string() + ": " + problem.what());
  }
}

Truth unseal(const fs::path& file, const fs::path& seal) {
  const std::string text = text_of(file), found = sha256(text);
  std::string expected = text_of(seal);
  expected.erase(expected.find_last_not_of(" \n\r") + 1);
  if (found != expected)
    throw InputError(
        fmt::format("{}: its SHA-256 is {}, and {} was sealed; the truth was changed after the data were "
                    "written, generate the case anew",
                    file.string(), found, expected));
  try {
    return read_truth(parsed(file, text));
  } catch (const Json::exception& problem) {
    throw InputError(file.string() + ": " + problem.what());
  }
}

}  // namespace

OpenedCases open_cases(const fs::path& cases, const fs::path& results, bool partial) {
  std::vector<std::string> names;
  if (!fs::is_directory(cases)) throw InputError(cases.string() + ": is no folder of cases");
  for (const auto& entry : fs::directory_iterator(cases))
    if (entry.is_directory() && fs::exists(entry.path() / "truth.sha256"))
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  if (names.empty())
    throw InputError(cases.string() +
                     ": holds no case, a folder with truth.sha256; give the folder that "
                     "discovery_generator wrote");
  std::vector<std::string> missing;
  OpenedCases opened;
  for (const std::string& name : names) {
    const fs::path result = results / name / "result.json";
    if (!fs::exists(result)) {
      missing.push_back(name);
      continue;
    }
    opened.cases.push_back({name, {}, read_result(result), {}});
  }
  if (!missing.empty() && !partial)
    throw InputError(
        fmt::format("{} of {} cases have no verdict, the first being {}; truths stay sealed until all "
                    "verdicts are there. Diagnose the rest, or score what is there with --partial",
                    missing.size(), names.size(), missing.front()));
  opened.sealed = missing.size();
  for (Case& one : opened.cases) {
    one.truth = unseal(cases / "sealed" / (one.name + ".json"), cases / one.name / "truth.sha256");
    for (const fs::path& file : {results / one.name / "oracle.json", cases / "sealed" / (one.name + ".oracle.json")}) {
      if (!fs::exists(file)) continue;
      const Json oracle = parsed(file, text_of(file));
      one.oracle = Oracle{oracle.at("detected"), word(oracle, "first"), {}};
      if (oracle.contains("likeness"))
        one.oracle->likeness = oracle.at("likeness").get<std::map<std::string, double>>();
      if (oracle.contains("pair"))
        for (std::size_t k = 0; k < 2; ++k)
          one.oracle->pair.push_back({oracle.at("pair").at(k), oracle.at("pair_likeness").at(k)});
      break;
    }
  }
  return opened;
}

void add_seconds(std::vector<Case>& cases, const fs::path& file) {
  const Json seconds = parsed(file, text_of(file));
  if (!seconds.is_object()) throw InputError(file.string() + ": expected {\"case\": seconds, …}");
  for (Case& one : cases) one.seconds = number(seconds, one.name.c_str());
}

LookAlikes read_look_alikes(const fs::path& file) {
  try {
    return parsed(file, text_of(file)).get<LookAlikes>();
  } catch (const Json::exception& problem) {
    throw InputError(file.string() + ": expected {\"id\": [\"look-alike\", …], …}: " + problem.what());
  }
}

}  // namespace blind::score
