// SPDX-License-Identifier: Apache-2.0
#include "discovery/kinds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tunica::discovery {
namespace {

constexpr double least_reach = 1e-3;  ///< of an invariant; less is no test of it

/// How strongly a law bends over the range X of its invariant: from a straight line to a steep wall.
constexpr double gentle = 0.05, steep = 25;

Shape within(Shape shape, double least, double most) {
  shape.low = std::clamp(shape.low, least, most);
  shape.high = std::clamp(shape.high, least, most);
  for (double& start : shape.starts) start = std::clamp(start, shape.low, shape.high);
  shape.starts.erase(std::unique(shape.starts.begin(), shape.starts.end()), shape.starts.end());
  return shape;
}

/// The parameters of a law over an invariant from 0 to X, within the bounds that `composed` declares.
std::vector<Shape> shapes_of(const std::string& law, double X) {
  if (law == "ogden") return {{"beta", -20, 20, Scale::linear, {-4, 4, 10}}};
  if (law == "power") return {{"m", 2, 12, Scale::linear, {2.5, 5}}};
  if (law == "exponential")
    return {within({"b", gentle / X, steep / X, Scale::log, {0.5 / X, 2 / X, 6 / X}}, 1e-3, 100)};
  if (law == "exponential_square")
    return {within({"k2", gentle / X / X, steep / X / X, Scale::log, {0.5 / X / X, 3 / X / X, 9 / X / X}}, 1e-3, 100)};
  if (law == "gent") return {within({"Jm", 1.002 * X, 50 * X, Scale::log, {1.1 * X, 2 * X, 8 * X}}, 0.01, 1e4)};
  if (law == "inverse_langevin")
    return {
        within({"N", 1 + 1.002 * X / 3, 1 + 50 * X / 3, Scale::log, {1 + 1.1 * X / 3, 1 + 2 * X / 3, 1 + 8 * X / 3}},
               1.05, 1e4)};
  return {};
}

/// Of diagonal families. Closer to an axis they are that axis's.
Shape angle() { return {"theta", 15, 75, Scale::linear, {30, 45, 60}}; }

/// Exponents with which the largest stretch says something.
Shape exponent(const Reach& logarithms, bool negative) {
  const double wide = std::clamp(15 / std::max(logarithms.high, -logarithms.low), 3.0, 30.0);
  if (negative) return within({"alpha", -wide, -0.2, Scale::linear, {-8, -3, -1}}, -30, 30);
  return within({"alpha", 0.2, wide, Scale::linear, {1.4, 3, 6, 12}}, -30, 30);
}

const std::vector<std::string> of_isotropic{"linear", "quadratic",        "cubic",    "power", "exponential",
                                            "gent",   "inverse_langevin", "logarithm"};
const std::vector<std::string> of_volume{"quadratic", "power", "exponential_square", "logarithmic", "simo", "ogden"};
const std::vector<std::string> of_products{"linear"};
const std::vector<std::string> of_fibres{"quadratic", "cubic", "power", "exponential_square"};

Reach reach_of(const std::string& words, const States& states) {
  if (words == "I1") return reach_of_first(states);
  if (words == "I2") return reach_of_second(states);
  if (words == "stretches") return reach_of_stretches(states);
  if (words == "J") return reach_of_volume(states);
  if (words == "I1bar") return reach_of_first(at_constant_volume(states));
  if (words == "I2bar") return reach_of_second(at_constant_volume(states));
  if (words == "I1*I2") return reach_of_product(states, 1, 1);
  if (words == "I1^2*I2") return reach_of_product(states, 2, 1);
  if (words == "I1*I2^2") return reach_of_product(states, 1, 2);
  if (words.starts_with("fibrebar"))
    return reach_of("fibre" + words.substr(words.find(' ')), at_constant_volume(states));
  static const std::map<std::string, double> along_axes{{"fibre axial", 0}, {"fibre circumferential", 90}};
  if (const auto axis = along_axes.find(words); axis != along_axes.end()) return reach_of_fibre(states, axis->second);
  Reach widest;  // of a family whose angle is not known
  for (const double angle : {20., 30., 40., 50., 60., 70.}) {
    const Reach one = reach_of_fibre(states, angle);
    widest.high = std::max(widest.high, one.high);
    widest.low = std::min(widest.low, one.low);
  }
  return widest;
}

/// As a part of names of parameters and files: "I1squared_I2" of "I1^2*I2".
std::string plain(const std::string& invariant) {
  std::string name;
  for (const char c : invariant) {
    if (c == '*')
      name += '_';
    else if (c == '^')
      name += "squared";
    else if (!name.ends_with("squared"))
      name += c;
  }
  return name;
}

/// Whether terms of this invariant are considered by default.
bool suits(const std::string& words, bool has_directions, bool sees_volume) {
  if (words == "J" || words.find("bar") != std::string::npos) {
    if (!sees_volume) return false;
    if (words.starts_with("I") || words == "J") return true;
  }
  if (words.starts_with("fibre")) return has_directions;
  return words.find('*') == std::string::npos;
}

Kind kind_of(const std::string& words, const std::string& law, const Reach& reach) {
  const auto blank = words.find(' ');
  Kind kind{words.substr(0, blank), blank == std::string::npos ? "" : words.substr(blank + 1), law, {}};
  kind.name = fmt::format("{}{}{}_{}", plain(kind.invariant), kind.family.empty() ? "" : "_", kind.family, law);
  kind.reach = reach;
  kind.shapes = shapes_of(law, std::max(reach.high, -kind.least()));
  if (kind.family == "diagonal") kind.shapes.push_back(angle());
  return kind;
}

const std::vector<std::string>& laws_of(const std::string& words) {
  if (words.starts_with("fibre")) return of_fibres;
  if (words == "J") return of_volume;
  return words.find('*') == std::string::npos ? of_isotropic : of_products;
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return words.empty() || std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::string Kind::amplitude() const {
  static const std::map<std::string, std::string> names{
      {"quadratic", "k"}, {"cubic", "k"}, {"power", "k"}, {"exponential_square", "k1"}};
  if (invariant == "stretches") return "mu";
  if (of_volume()) return law == "exponential_square" ? "k1" : "K";
  if (law == "spline") return isotropic() ? "slope" : "c_1";
  const auto found = names.find(law);
  return found == names.end() ? "mu" : found->second;
}

Options Kind::options() const {
  Options options;
  options.set("invariant", invariant);
  options.set("law", invariant == "stretches" ? "power" : law);
  options.set("family", family.empty() ? "axial" : family);
  options.set("dispersion", std::string("none"));
  options.set("fibre_switch", std::string("strain"));
  options.set("knots", fmt::format("[{}]", fmt::join(knots, ", ")));
  return options;
}

std::vector<Kind> kinds_of(const Request& request, const States& states, bool has_directions, bool sees_volume) {
  std::vector<Kind> kinds;
  for (const std::string& words : experiment::discovery_invariants) {
    if (!holds(request.invariants, words)) continue;
    if (request.invariants.empty() && !suits(words, has_directions, sees_volume)) continue;
    const Reach reach = reach_of(words, states);
    const bool falls = words == "stretches" || words == "J";
    if (std::max(reach.high, falls ? -reach.low : 0.0) < least_reach) continue;
    if (words == "stretches") {
      for (const bool negative : {false, true}) {
        if (!holds(request.laws, "power")) continue;
        Kind kind{words, {}, "power", negative ? "stretches_falling" : "stretches_rising"};
        kind.negative = negative;
        kind.reach = reach;
        kind.shapes = {exponent(reach, negative)};
        kinds.push_back(std::move(kind));
      }
    } else {
      for (const std::string& law : laws_of(words))
        if (holds(request.laws, law)) kinds.push_back(kind_of(words, law, reach));
    }
  }
  constexpr double unusual = 0.2;  ///< the prior weight of an unusual combination of law and invariant
  double all = 0;
  const auto weight = [](const Kind& kind) {
    const bool odd = (kind.invariant.starts_with("I1") && kind.law == "logarithm") ||
                     (kind.invariant.starts_with("I2") && kind.law == "inverse_langevin");
    return odd ? unusual : 1.0;
  };
  for (const Kind& kind : kinds) all += weight(kind);
  for (Kind& kind : kinds) kind.log_prior = std::log(weight(kind) / all);
  return kinds;
}

Kind curve_of(const Kind& kind, std::size_t pieces) {
  Kind curve{kind.invariant, kind.family, "spline", {}};
  curve.name = fmt::format("{}{}{}_curve", kind.invariant, kind.family.empty() ? "" : "_", kind.family);
  curve.reach = kind.reach;
  curve.log_prior = kind.log_prior;
  // Denser near rest, where most rows are.
  for (std::size_t j = 0; j <= pieces; ++j) {
    const double t = static_cast<double>(j) / static_cast<double>(pieces);
    curve.knots.push_back(kind.reach.high * std::pow(t, 1.5));
  }
  for (std::size_t j = curve.isotropic() ? 0 : 1; j <= pieces; ++j) curve.heights.push_back(fmt::format("c_{}", j + 1));
  if (kind.family == "diagonal") curve.shapes.push_back(angle());
  return curve;
}

}  // namespace tunica::discovery
