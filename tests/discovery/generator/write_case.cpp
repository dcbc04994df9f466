// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "oracle.hpp"
#include "seal.hpp"
#include "sealed_case.hpp"

namespace blind {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

Json parameters() {
  const auto& b = bounds();
  const auto log = [](const Bounds& of) { return Json{{"min", of.low}, {"max", of.high}, {"scale", "log"}}; };
  return {{"mu", log(b[0])}, {"k1", log(b[1])}, {"k2", log(b[2])}, {"theta", {{"min", b[3].low}, {"max", b[3].high}}}};
}

/// What the file says of the noise of some channels; nothing where it is to be learned from replicates.
Json stated_noise(const SealedCase& made, std::size_t first, std::size_t count) {
  const auto layout = channels(made.specimen.protocol);
  Json all;
  for (std::size_t k = first; k < first + count; ++k) {
    Json& one = all[layout[k].name];
    one["absolute"] = std::hypot(made.noise.absolute[k], made.noise.step[k] / std::sqrt(12.0));
    if (made.noise.relative[k] > 0) one["relative"] = made.noise.relative[k];
  }
  return all;
}

Json data(const SealedCase& made, const std::string& test, Json columns, std::size_t first, std::size_t count) {
  Json entry;
  if (made.noise.replicates == 1) {
    entry["file"] = test + ".csv";
  } else {
    for (std::size_t r = 1; r <= made.noise.replicates; ++r)
      entry["files"].push_back(fmt::format("{}_{}.csv", test, r));
  }
  entry["columns"] = std::move(columns);
  if (made.noise.kind != "ar1") entry["noise"] = stated_noise(made, first, count);
  return entry;
}

Json experiment(const SealedCase& made, const std::string& name) {
  Json tests;
  for (std::size_t i = 0; i < strip_count; ++i) {
    const Strip& strip = made.specimen.protocol.strips[i];
    const bool around = strip.direction == Material::First::circumferential;
    tests[strip_names()[i]] = {
        {"type", "uniaxial"},
        {"direction", around ? "circumferential" : "axial"},
        {"data", data(made, strip_names()[i], {{"time", "time"}, {"stretch", "stretch"}, {"stress", "stress"}}, i, 1)}};
  }
  for (std::size_t i = 0; i < tube_count; ++i) {
    const Tube& tube = made.specimen.protocol.tubes[i];
    const Json columns{{"time", "time"},
                       {"pressure", "pressure"},
                       {"outer_diameter_stretch", "outer_diameter_stretch"},
                       {"axial_force", "axial_force"}};
    tests[tube_names()[i]] = {{"type", "thick_wall_pressurisation"},
                              {"inner_radius", tube.inner_radius},
                              {"thickness", tube.thickness},
                              {"axial_stretch", tube.axial_stretch},
                              {"data", data(made, tube_names()[i], columns, strip_count + 2 * i, 2)}};
  }
  return {{"format", 1},
          {"name", name},
          {"seed", 1},
          {"models", {{"hgo", {{"type", "hgo"}, {"parameters", parameters()}}}}},
          {"tests", tests},
          {"objective", "least_squares"},
          {"optimizers", {{"lm", {{"type", "ceres_lm"}, {"starts", 4}}}}},
          {"stop", {{"max_evaluations", 2000}}},
          {"runs", {{{"model", "hgo"}, {"optimizer", "lm"}}}},
          {"diagnosis", {{"model", "hgo"}, {"optimizer", "lm"}, {"alpha", 0.05}, {"mechanisms", "all"}}}};
}

void write_data(const SealedCase& made, const fs::path& folder) {
  const Protocol& protocol = made.specimen.protocol;
  const auto layout = channels(protocol);
  for (std::size_t r = 0; r < made.noise.replicates; ++r) {
    const std::vector<double>& y = made.records.replicates[r];
    const auto file = [&](const std::string& test) {
      return folder / (made.noise.replicates == 1 ? test + ".csv" : fmt::format("{}_{}.csv", test, r + 1));
    };
    for (std::size_t i = 0; i < strip_count; ++i) {
      const Strip& strip = protocol.strips[i];
      std::string text = "time [s],stretch [-],stress [kPa]\n";
      for (std::size_t row = 0; row < strip.stretch.size(); ++row)
        text += fmt::format("{:.9g},{:.9g},{:.9g}\n", strip.time[row], strip.stretch[row], y[layout[i].first + row]);
      write_text(file(strip_names()[i]), text);
    }
    for (std::size_t i = 0; i < tube_count; ++i) {
      const Tube& tube = protocol.tubes[i];
      const std::size_t diameter = layout[strip_count + 2 * i].first, force = layout[strip_count + 2 * i + 1].first;
      std::string text = "time [s],pressure [kPa],outer_diameter_stretch [-],axial_force [mN]\n";
      for (std::size_t row = 0; row < tube.pressure.size(); ++row)
        text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", tube.time[row], tube.pressure[row], y[diameter + row],
                            y[force + row]);
      write_text(file(tube_names()[i]), text);
    }
  }
}

/// Test and channel as files call them; null: the material, or all tubes.
Json target(const Target& of, const Protocol& protocol) {
  Json made{{"test", nullptr}, {"channel", nullptr}};
  if (of.strip) made["test"] = strip_names()[*of.strip];
  if (of.tube) made["test"] = tube_names()[*of.tube];
  if (of.channel) {
    const Channel channel = channels(protocol)[*of.channel];
    made["test"] = channel.test;
    made["channel"] = channel.name;
  }
  if (of.row) made["row"] = *of.row;
  return made;
}

Json sealed(const SealedCase& made, const std::string& name) {
  const Tissue& base = made.specimen.tissue;
  const auto layout = channels(made.specimen.protocol);
  Json effects = Json::array();
  for (const ScaledEffect& one : made.hidden) {
    const Effect& effect = *one.hidden.effect;
    const std::string unit = one.hidden.target.channel ? layout[*one.hidden.target.channel].unit : effect.unit;
    const bool listed = made.order.set != "outside";
    effects.push_back({{"id", effect.id},
                       {"in_catalogue", listed},
                       {"target", target(one.hidden.target, made.specimen.protocol)},
                       {"amplitude", one.hidden.amplitude()},
                       {"null", effect.null},
                       {"even", effect.even},
                       {"unit", unit},
                       {"nuisance", one.hidden.nuisance},
                       {"lambda", one.lambda},
                       {"reached", one.reached}});
  }
  Json noise{{"kind", made.noise.kind}, {"correlation", made.noise.correlation}, {"replicates", made.noise.replicates}};
  for (std::size_t k = 0; k < channel_count; ++k)
    noise["channels"].push_back({{"test", layout[k].test},
                                 {"channel", layout[k].name},
                                 {"absolute", made.noise.absolute[k]},
                                 {"relative", made.noise.relative[k]},
                                 {"step", made.noise.step[k]}});
  Json gross = Json::array();
  for (const GrossError& shift : made.records.gross)
    gross.push_back({{"test", layout[shift.channel].test},
                     {"channel", layout[shift.channel].name},
                     {"row", shift.row},
                     {"value", shift.value}});
  Json all{{"format", 1},
           {"case", name},
           {"seed", made.order.seed},
           {"set", made.order.set},
           {"index", made.order.index},
           {"lambda_asked", made.order.lambda},
           {"lambda", made.lambda},
           {"base", {{"mu", base.mu}, {"k1", base.k1}, {"k2", base.k2}, {"theta", base.theta}}},
           {"noise", noise},
           {"gross_errors", gross},
           {"effects", effects}};
  if (made.order.set == "pairs") all["correlation"] = made.correlation;
  if (made.order.set == "outside") {
    const double c = made.account.correlation;
    all["outside"] = {{"look_alike", made.hidden[0].hidden.effect->look_alike},
                      {"best", made.account.effect == nullptr ? "" : made.account.effect->id},
                      {"correlation", c},
                      {"remainder", made.lambda * (1 - c * c)}};
  }
  return all;
}

}  // namespace

bool write(const CaseOrder& order, const fs::path& folder, bool oracle) {
  const std::string name = order.name();
  const fs::path place = folder / name, truth = folder / "sealed" / (name + ".json"),
                 known = folder / "sealed" / (name + ".oracle.json");
  const bool written = fs::exists(place) && fs::exists(truth);
  if (written && (!oracle || fs::exists(known))) return false;
  const SealedCase made = make(order);
  fs::create_directories(folder / "sealed");
  if (oracle) {
    const OracleVerdict verdict = ask_oracle(made);
    Json text{{"detected", verdict.detected},
              {"p_value", verdict.p_value},
              {"first", verdict.first},
              {"likeness", verdict.likeness}};
    if (!verdict.pair.empty()) {
      text["pair"] = verdict.pair;
      text["pair_likeness"] = verdict.pair_likeness;
    }
    write_text(known, text.dump() + "\n");
  }
  if (written) return true;
  const fs::path unfinished = folder / fmt::format(".{}-{}", name, ::getpid());
  fs::remove_all(unfinished);
  fs::remove_all(place);
  fs::create_directories(unfinished);
  const std::string text = sealed(made, name).dump(1) + "\n";
  write_text(truth, text);
  write_text(unfinished / "truth.sha256", sha256(text) + "\n");
  write_text(unfinished / "experiment.json", experiment(made, name).dump(1) + "\n");
  write_data(made, unfinished);
  fs::rename(unfinished, place);
  return true;
}

}  // namespace blind
