// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "bases.hpp"
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

Json parameters(const Tissue& tissue) {
  Json all;
  for (const BaseParameter& one : fitted(tissue.base)) {
    all[one.name] = {{"min", one.low}, {"max", one.high}};
    if (one.logarithmic) all[one.name]["scale"] = "log";
  }
  for (const BaseParameter& one : held(tissue.base)) all[one.name]["fixed"] = tissue.*one.member;
  return all;
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

/// Without the order of rows there is no time.
Json data(const SealedCase& made, const std::string& test, std::vector<std::string> columns, std::size_t first,
          std::size_t count) {
  Json entry;
  if (made.noise.replicates == 1) {
    entry["file"] = test + ".csv";
  } else {
    for (std::size_t r = 1; r <= made.noise.replicates; ++r)
      entry["files"].push_back(fmt::format("{}_{}.csv", test, r));
  }
  if (made.order.order_recorded) entry["columns"]["time"] = "time";
  for (const std::string& name : columns) entry["columns"][name] = name;
  if (made.noise.kind != "ar1" && made.order.noise_stated) entry["noise"] = stated_noise(made, first, count);
  return entry;
}

Json experiment(const SealedCase& made, const std::string& name) {
  const Protocol& protocol = made.specimen.protocol;
  Json tests;
  std::size_t channel = 0;
  for (const Strip& strip : protocol.strips) {
    const bool around = strip.direction == Material::First::circumferential;
    tests[strip.name] = {{"type", "uniaxial"},
                         {"direction", around ? "circumferential" : "axial"},
                         {"data", data(made, strip.name, {"stretch", "stress"}, channel, 1)}};
    channel += 1;
  }
  for (const Tube& tube : protocol.tubes) {
    tests[tube.name] = {
        {"type", "thick_wall_pressurisation"},
        {"inner_radius", tube.inner_radius},
        {"thickness", tube.thickness},
        {"axial_stretch", tube.axial_stretch},
        {"data", data(made, tube.name, {"pressure", "outer_diameter_stretch", "axial_force"}, channel, 2)}};
    channel += 2;
  }
  for (const Sheet& sheet : protocol.sheets) {
    using enum Sheet::Kind;
    const std::size_t count = sheet.channel_count();
    Json& test = tests[sheet.name];
    test["type"] = "biaxial";
    test["protocol"] = sheet.kind == general ? "general" : sheet.kind == equibiaxial ? "equibiaxial" : "pure_shear";
    if (sheet.kind == general)
      test["data"] =
          data(made, sheet.name, {"stretch_circumferential", "stretch_axial", "stress_circumferential", "stress_axial"},
               channel, count);
    else
      test["data"] = data(made, sheet.name, {"stretch", "stress"}, channel, count);
    channel += count;
  }
  const Tissue& tissue = made.specimen.tissue;
  const std::string& base = name_of(tissue.base);
  Json model{{"type", base}, {"parameters", parameters(tissue)}};
  if (tissue.base == Base::ogden) model["terms"] = 2;
  return {{"format", 1},
          {"name", name},
          {"seed", 1},
          {"models", {{base, model}}},
          {"tests", tests},
          {"objective", "least_squares"},
          {"optimizers", {{"lm", {{"type", "ceres_lm"}, {"starts", fitted(tissue.base).size() > 4 ? 12 : 4}}}}},
          {"stop", {{"max_evaluations", 2000}}},
          {"runs", {{{"model", base}, {"optimizer", "lm"}}}},
          {"diagnosis", {{"model", base}, {"optimizer", "lm"}, {"alpha", 0.05}, {"mechanisms", "all"}}}};
}

/// One column of a file: its heading, and what stands in it.
struct Column {
  std::string heading;
  const double* values;
};

void write_columns(const SealedCase& made, const fs::path& folder, const std::string& test, std::size_t replicate,
                   std::vector<Column> columns, const std::vector<double>& time) {
  if (made.order.order_recorded) columns.insert(columns.begin(), {"time [s]", time.data()});
  std::string text;
  for (const Column& column : columns) text += (text.empty() ? "" : ",") + column.heading;
  text += "\n";
  const auto mixed = made.rows.find(test);
  for (std::size_t k = 0; k < time.size(); ++k) {
    const std::size_t row = mixed == made.rows.end() ? k : mixed->second[k];
    for (std::size_t j = 0; j < columns.size(); ++j)
      text += fmt::format("{}{:.9g}", j == 0 ? "" : ",", columns[j].values[row]);
    text += "\n";
  }
  write_text(folder / (made.noise.replicates == 1 ? test + ".csv" : fmt::format("{}_{}.csv", test, replicate + 1)),
             text);
}

void write_data(const SealedCase& made, const fs::path& folder) {
  const Protocol& protocol = made.specimen.protocol;
  for (std::size_t r = 0; r < made.noise.replicates; ++r) {
    const double* y = made.records.replicates[r].data();
    const auto measured = [&y](std::size_t count) {
      const double* const begin = y;
      y += count;
      return begin;
    };
    for (const Strip& strip : protocol.strips)
      write_columns(made, folder, strip.name, r,
                    {{"stretch [-]", strip.stretch.data()}, {"stress [kPa]", measured(strip.time.size())}}, strip.time);
    for (const Tube& tube : protocol.tubes) {
      const double *diameter = measured(tube.time.size()), *force = measured(tube.time.size());
      write_columns(made, folder, tube.name, r,
                    {{"pressure [kPa]", tube.pressure.data()},
                     {"outer_diameter_stretch [-]", diameter},
                     {"axial_force [mN]", force}},
                    tube.time);
    }
    for (const Sheet& sheet : protocol.sheets) {
      const double* const first = measured(sheet.time.size());
      if (sheet.kind != Sheet::Kind::general) {
        write_columns(made, folder, sheet.name, r, {{"stretch [-]", sheet.around.data()}, {"stress [kPa]", first}},
                      sheet.time);
        continue;
      }
      const double* const second = measured(sheet.time.size());
      write_columns(made, folder, sheet.name, r,
                    {{"stretch_circumferential [-]", sheet.around.data()},
                     {"stretch_axial [-]", sheet.along.data()},
                     {"stress_circumferential [kPa]", first},
                     {"stress_axial [kPa]", second}},
                    sheet.time);
    }
  }
}

/// Where a row stands in the file.
std::size_t written_row(const SealedCase& made, const std::string& test, std::size_t row) {
  const auto mixed = made.rows.find(test);
  if (mixed == made.rows.end()) return row;
  return static_cast<std::size_t>(std::find(mixed->second.begin(), mixed->second.end(), row) - mixed->second.begin());
}

/// Test and channel as files call them; null: the material, or all tubes.
Json target(const Target& of, const SealedCase& in) {
  const Protocol& protocol = in.specimen.protocol;
  Json made{{"test", nullptr}, {"channel", nullptr}};
  if (of.strip) made["test"] = protocol.strips[*of.strip].name;
  if (of.tube) made["test"] = protocol.tubes[*of.tube].name;
  if (of.channel) {
    const Channel channel = channels(protocol)[*of.channel];
    made["test"] = channel.test;
    made["channel"] = channel.name;
  }
  if (of.row) made["row"] = written_row(in, channels(protocol)[*of.channel].test, *of.row);
  return made;
}

Json parameters_of(const Tissue& tissue) {
  Json all;
  for (const auto* list : {&fitted(tissue.base), &held(tissue.base)})
    for (const BaseParameter& one : *list) all[one.name] = tissue.*one.member;
  return all;
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
                       {"target", target(one.hidden.target, made)},
                       {"amplitude", one.hidden.amplitude()},
                       {"null", effect.null},
                       {"even", effect.even},
                       {"unit", unit},
                       {"nuisance", one.hidden.nuisance},
                       {"lambda", one.lambda},
                       {"reached", one.reached}});
  }
  Json noise{{"kind", made.noise.kind}, {"correlation", made.noise.correlation}, {"replicates", made.noise.replicates}};
  for (std::size_t k = 0; k < layout.size(); ++k)
    noise["channels"].push_back({{"test", layout[k].test},
                                 {"channel", layout[k].name},
                                 {"absolute", made.noise.absolute[k]},
                                 {"relative", made.noise.relative[k]},
                                 {"step", made.noise.step[k]}});
  Json gross = Json::array();
  for (const GrossError& shift : made.records.gross)
    gross.push_back({{"test", layout[shift.channel].test},
                     {"channel", layout[shift.channel].name},
                     {"row", written_row(made, layout[shift.channel].test, shift.row)},
                     {"value", shift.value}});
  Json all{{"format", 1},
           {"case", name},
           {"seed", made.order.seed},
           {"set", made.order.set},
           {"index", made.order.index},
           {"lambda_asked", made.order.lambda},
           {"lambda", made.lambda},
           {"class",
            {{"base", name_of(base.base)},
             {"protocol", made.order.protocol},
             {"noise_stated", made.order.noise_stated},
             {"order_recorded", made.order.order_recorded}}},
           {"stated_twin", made.order.noise_stated ? "" : made.order.stated().name()},
           {"base", parameters_of(base)},
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

std::string truth_of(const SealedCase& made, const std::string& name) { return sealed(made, name).dump(1) + "\n"; }

void write_measured(const SealedCase& made, const std::string& name, const fs::path& folder) {
  fs::create_directories(folder);
  write_text(folder / "experiment.json", experiment(made, name).dump(1) + "\n");
  write_data(made, folder);
}

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
  const std::string text = truth_of(made, name);
  write_text(truth, text);
  write_text(unfinished / "truth.sha256", sha256(text) + "\n");
  write_measured(made, name, unfinished);
  fs::rename(unfinished, place);
  return true;
}

}  // namespace blind
