// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/evidence_json.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "text/escaped.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort_diagnosis {
namespace {

using Json = nlohmann::ordered_json;
using diagnosis::Verdict;

constexpr int record_format = 2;

/// The fault of a record, for the message.
struct NoRecord : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr Verdict verdicts[] = {Verdict::nothing_detected, Verdict::named, Verdict::indistinguishable, Verdict::unknown,
                                Verdict::suspect_data};

Json to_json(const std::optional<Half>& half) {
  if (!half) return nullptr;
  Json json = Json::array({half->t, half->length, half->vector, half->sign, half->refitted, half->apart, half->shown});
  if (half->left) json.push_back(*half->left);
  return json;
}

std::optional<Half> half_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  Half half;
  half.t = json.at(0).get<double>();
  half.length = json.at(1).get<double>();
  half.vector = json.at(2).get<std::size_t>();
  half.sign = json.at(3).get<double>();
  half.refitted = json.at(4).get<bool>();
  half.apart = json.at(5).get<bool>();
  half.shown = json.at(6).get<double>();
  if (json.size() > 7) half.left = json.at(7).get<std::size_t>();
  return half;
}

Json to_json(const Profile& profile) {
  Json json{{"id", profile.id}, {"tests", profile.place.tests}};
  if (!profile.place.channel.empty()) json["channel"] = profile.place.channel;
  if (profile.place.row) json["row"] = {*profile.place.row, profile.place.file_row};
  if (!profile.place.model.empty()) json["model"] = profile.place.model;
  for (const auto& [name, value] : profile.setting) json["setting"].push_back(Json::array({name, value}));
  json["amplitude"] = profile.amplitude;
  json["unit"] = profile.unit;
  json["null"] = profile.null;
  if (profile.even) json["even"] = true;
  json["up"] = to_json(profile.up);
  json["down"] = to_json(profile.down);
  return json;
}

Profile profile_from(const Json& json) {
  Profile profile;
  profile.id = json.at("id").get<std::string>();
  profile.place.tests = json.at("tests").get<std::vector<std::string>>();
  if (json.contains("channel")) profile.place.channel = json.at("channel").get<std::string>();
  if (json.contains("model")) profile.place.model = json.at("model").get<std::string>();
  if (json.contains("row")) {
    profile.place.row = json.at("row").at(0).get<std::size_t>();
    profile.place.file_row = json.at("row").at(1).get<std::size_t>();
  }
  if (json.contains("setting"))
    for (const Json& one : json.at("setting"))
      profile.setting.emplace_back(one.at(0).get<std::string>(), one.at(1).get<double>());
  profile.amplitude = json.at("amplitude").get<std::string>();
  profile.unit = json.at("unit").get<std::string>();
  profile.null = json.at("null").get<double>();
  profile.even = json.contains("even");
  profile.up = half_from(json.at("up"));
  profile.down = half_from(json.at("down"));
  if (!profile.up && !profile.down) throw NoRecord("a profile without a side");
  return profile;
}

diagnosis::Tolerance::Origin origin_from(const std::string& code) {
  if (const auto origin = text::value_of(diagnosis::tolerance_origins, code)) return *origin;
  throw NoRecord("an origin of a tolerance that there is not");
}

/// What later stages index by.
void check(const SpecimenEvidence& specimen) {
  const std::size_t all = specimen.vectors + specimen.shapes.size();
  if (specimen.likeness.triangle().size() != all * (all - (all > 0 ? 1 : 0)) / 2)
    throw NoRecord("another number of cosines than its vectors have");
  for (const Profile& profile : specimen.profiles)
    for (const std::optional<Half>* half : {&profile.up, &profile.down})
      if (*half && ((*half)->vector >= specimen.vectors || !((*half)->length > 0)))
        throw NoRecord("a profile without a vector, or without a length");
      else if (*half && (*half)->left && *(*half)->left >= specimen.left.size())
        throw NoRecord("a profile that leaves what is not there");
  for (const auto& one : specimen.left)
    if (one.size() != all) throw NoRecord("a refit that leaves something along another number of vectors");
}

}  // namespace

Json to_json(const SpecimenEvidence& specimen) {
  Json json{{"format", record_format},
            {"id", specimen.id},
            {"p_value", specimen.p_value},
            {"alarm", specimen.alarm},
            {"verdict", diagnosis::code_of(specimen.verdict)},
            {"causes", specimen.causes},
            {"ambiguity_set", specimen.ambiguity_set},
            {"pairs", specimen.pairs},
            {"ranking", Json::array()},
            {"p_after", specimen.p_after},
            {"rows", specimen.rows},
            {"squares", specimen.squares},
            {"rms", specimen.rms},
            {"rms_upper", specimen.rms_upper},
            {"tolerance", specimen.tolerance},
            {"tolerance_origin", diagnosis::code_of(specimen.tolerance_origin)},
            {"outlines", Json::array()},
            {"profiles", Json::array()},
            {"shapes", specimen.shapes},
            {"vectors", specimen.vectors},
            {"likeness", specimen.likeness.triangle()},
            {"left", specimen.left}};
  for (const OwnRank& one : specimen.ranking) json["ranking"].push_back(Json::array({one.id, one.probability}));
  for (const Outline& one : specimen.outlines)
    json["outlines"].push_back(
        Json::array({one.test, one.channel, one.rows, one.range, one.rms, one.from, one.to, one.values}));
  for (const Profile& profile : specimen.profiles) json["profiles"].push_back(to_json(profile));
  return json;
}

SpecimenEvidence evidence_from_json(const Json& json, const std::string& where) {
  try {
    if (const int format = json.at("format").get<int>(); format != record_format)
      throw NoRecord("a record of another format");
    SpecimenEvidence found;
    found.id = json.at("id").get<std::string>();
    found.p_value = json.at("p_value").get<double>();
    found.alarm = json.at("alarm").get<bool>();
    const std::string verdict = json.at("verdict").get<std::string>();
    bool known = false;
    for (const Verdict one : verdicts)
      if (verdict == diagnosis::code_of(one)) {
        found.verdict = one;
        known = true;
      }
    if (!known) throw NoRecord("a verdict that there is not");
    found.causes = json.at("causes").get<std::vector<std::string>>();
    found.ambiguity_set = json.at("ambiguity_set").get<std::vector<std::string>>();
    found.pairs = json.at("pairs").get<std::vector<std::vector<std::string>>>();
    for (const Json& one : json.at("ranking"))
      found.ranking.push_back({one.at(0).get<std::string>(), one.at(1).get<double>()});
    found.p_after = json.at("p_after").get<double>();
    found.rows = json.at("rows").get<std::size_t>();
    found.squares = json.at("squares").get<double>();
    found.rms = json.at("rms").get<double>();
    found.rms_upper = json.at("rms_upper").get<double>();
    found.tolerance = json.at("tolerance").get<double>();
    found.tolerance_origin = origin_from(json.at("tolerance_origin").get<std::string>());
    for (const Json& one : json.at("outlines"))
      found.outlines.push_back({one.at(0).get<std::string>(), one.at(1).get<std::string>(),
                                one.at(2).get<std::size_t>(), one.at(3).get<double>(), one.at(4).get<double>(),
                                one.at(5).get<double>(), one.at(6).get<double>(),
                                one.at(7).get<std::vector<double>>()});
    for (const Json& one : json.at("profiles")) found.profiles.push_back(profile_from(one));
    found.shapes = json.at("shapes").get<std::vector<double>>();
    found.vectors = json.at("vectors").get<std::size_t>();
    found.likeness = Likeness(json.at("likeness").get<std::vector<std::int32_t>>());
    found.left = json.at("left").get<std::vector<std::vector<std::int32_t>>>();
    check(found);
    return found;
  } catch (const std::exception& problem) {
    throw InputError(
        fmt::format("{}: found {}, expected the evidence of a specimen as this version writes it. Use the file "
                    "that it wrote, or diagnose the specimen again",
                    where, text::json_problem(problem.what())));
  }
}

}  // namespace tunica::cohort_diagnosis
