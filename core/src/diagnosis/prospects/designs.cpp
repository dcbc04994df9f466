// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/designs.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include <fmt/format.h>

#include "plugins/default_options.hpp"
#include "plugins/guarded.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t design_rows = 20;
constexpr double relative_noise = 0.015;

/// The columns of a planned test; a TestSetup looks into them.
struct Plan {
  std::string description, type;
  Options options;
  std::vector<std::pair<std::string, std::vector<double>>> abscissae;
  std::vector<double> time;
  std::vector<std::string> channels;
  std::vector<double> angle = {};  ///< the first parameter of the test, deg
};

std::vector<double> ramp(double from, double to, std::size_t count = design_rows) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(from + (to - from) * static_cast<double>(i + 1) / static_cast<double>(count));
  return values;
}

/// σ_Cauchy = λ P = λ² S of a face that is stretched by λ: by how much the Cauchy stress is larger than the measured
/// one.
double cauchy_factor(const std::string& measure, double stretch) {
  if (measure == "first_piola_kirchhoff") return stretch;
  return measure == "second_piola_kirchhoff" ? stretch * stretch : 1;
}

/// Noise of an observable: the smallest at this value that the data state for it; none where it was not measured.
/// Stresses are Cauchy stresses here, at this stretch.
std::optional<double> known_sd(const Evidence& evidence, const std::string& observable, double value, double stretch) {
  std::optional<double> sd;
  for (const Curve& curve : evidence.curves) {
    if (curve.channel != observable) continue;
    const double factor = cauchy_factor(evidence.experiment.test(curve.test).data.stress_measure, stretch);
    const data::Noise& noise = curve.noise.noise;
    const double own = factor * std::hypot(noise.absolute, noise.relative * value / factor);
    if (own > 0) sd = std::min(sd.value_or(own), own);
  }
  return sd;
}

double shortest_time(const Evidence& evidence, const plugins::Catalogue& catalogue, double& longest) {
  double shortest = 0;
  for (const std::string& name : evidence.run.tests) {
    const auto& entry = evidence.experiment.test(name);
    const auto data = data::read_dataset(entry.data, catalogue.tests().find(entry.type)->second.factory.observables);
    if (data.time.size() < 2) continue;
    const double duration = data.time.back() - data.time.front();
    longest = std::max(longest, duration);
    shortest = shortest == 0 ? duration : std::min(shortest, duration);
  }
  return shortest;
}

std::vector<Plan> plans(const Evidence& evidence, const plugins::Catalogue& catalogue) {
  std::vector<Plan> found;
  const double reach = std::clamp(evidence.base->models().largest_stretch(), 1.15, 8.0);
  const auto uniaxial = catalogue.tests().find("uniaxial");
  const Options of_strip =
      uniaxial != catalogue.tests().end() ? plugins::default_options(uniaxial->second.factory.options) : Options{};
  const auto strip = [&](std::string description, const char* direction, std::vector<double> stretch,
                         std::vector<double> time) -> Plan& {
    Plan plan{std::move(description), "uniaxial", of_strip, {{"stretch", std::move(stretch)}},
              std::move(time),        {"stress"}};
    plan.options.set("direction", std::string(direction));
    found.push_back(std::move(plan));
    return found.back();
  };
  for (const char* direction : {"circumferential", "axial"})
    strip(fmt::format("a strip pulled along the {} direction to a stretch of {:.3g}, its width measured too", direction,
                      reach),
          direction, ramp(1, reach), {})
        .channels.push_back("transverse_stretch");
  strip(fmt::format("a strip cut at 45° between the axes, pulled to {:.3g}", reach), "axial", ramp(1, reach), {})
      .angle = {45};
  double longest = 0;
  if (const double shortest = shortest_time(evidence, catalogue, longest); shortest > 0) {
    std::vector<double> up = ramp(1, reach, design_rows / 2),
                        down = ramp(reach, 1 + 0.1 * (reach - 1), design_rows / 2);
    up.insert(up.end(), down.begin(), down.end());
    strip(fmt::format("one slow cycle of a strip, to {:.3g} and back in {:.3g} s", reach, 10 * longest),
          "circumferential", up, ramp(0, 10 * longest));
    std::vector<double> hold = ramp(1, reach, 4), time = ramp(0, shortest / 20, 4);
    for (std::size_t i = 0; i < design_rows - 4; ++i) {
      hold.push_back(reach);
      time.push_back(time[3] + longest * static_cast<double>(i + 1) / (design_rows - 4));
    }
    strip(fmt::format("a strip pulled to {:.3g} within {:.3g} s and held for {:.3g} s", reach, shortest / 20, longest),
          "circumferential", hold, time);
  }
  if (const auto biaxial = catalogue.tests().find("biaxial"); biaxial != catalogue.tests().end()) {
    const auto sheet = [&](const char* words, const char* protocol,
                           std::vector<std::pair<std::string, std::vector<double>>> stretches,
                           std::vector<std::string> channels) {
      Plan plan{
          words, "biaxial",          plugins::default_options(biaxial->second.factory.options), std::move(stretches),
          {},    std::move(channels)};
      plan.options.set("protocol", std::string(protocol));
      found.push_back(std::move(plan));
    };
    const double edge = 1 + 0.7 * (reach - 1);
    const std::vector<std::string> both{"stress_circumferential", "stress_axial"};
    sheet("a sheet stretched equally in both directions", "general",
          {{"stretch_circumferential", ramp(1, edge)}, {"stretch_axial", ramp(1, edge)}}, both);
    sheet("a sheet stretched twice as far along the circumference as along the axis", "general",
          {{"stretch_circumferential", ramp(1, edge)}, {"stretch_axial", ramp(1, 1 + (edge - 1) / 2)}}, both);
    sheet("a sheet stretched twice as far along the axis as along the circumference", "general",
          {{"stretch_circumferential", ramp(1, 1 + (edge - 1) / 2)}, {"stretch_axial", ramp(1, edge)}}, both);
  }
  for (const std::string& name : evidence.run.tests) {
    const auto& entry = evidence.experiment.test(name);
    if (entry.type != "thick_wall_pressurisation" || !entry.layers.empty()) continue;
    double highest = 0;
    for (const Curve& curve : evidence.curves)
      if (curve.test == name)
        highest = std::max(highest, *std::max_element(curve.abscissa.begin(), curve.abscissa.end()));
    for (const double change : {-0.1, 0.1}) {
      Plan plan{{},
                entry.type,
                entry.options,
                {{"pressure", ramp(0, highest)}},
                {},
                {"outer_diameter_stretch", "axial_force"}};
      if (!plan.options.has("axial_stretch") || highest <= 0) continue;
      const double stretch = plan.options.number("axial_stretch") + change;
      if (stretch < 1) continue;
      plan.options.set("axial_stretch", stretch);
      plan.description = fmt::format("the tube of '{}' inflated at an axial stretch of {:.3g}", name, stretch);
      found.push_back(std::move(plan));
    }
  }
  return found;
}

}  // namespace

bool predict(const Design& design, const assembly::Assembly& assembly, std::span<const double> free,
             std::vector<double>& values) {
  const std::vector<double> parameters = assembly.models().parameters(0, free);
  values.assign(design.test->rows().count * design.test->rows().channels.size(), 0.0);
  try {
    return design.test->predict({assembly.models().model(0), parameters, design.parameters}, {values, {}, {}, {}}).ok();
  } catch (const std::exception&) {
    return false;
  }
}

std::vector<Design> designs(const Inquiry& inquiry, const Evidence& evidence, const assembly::Assembly& scale,
                            std::span<const double> free) {
  const plugins::Catalogue& catalogue = inquiry.catalogue;
  std::vector<Design> library;
  for (const Plan& plan : plans(evidence, catalogue)) {
    const auto type = catalogue.tests().find(plan.type);
    if (type == catalogue.tests().end()) continue;
    TestSetup setup{plan.options, {plan.abscissae.front().second.size(), {}, plan.channels, plan.time}, "cauchy"};
    for (const auto& [name, column] : plan.abscissae) setup.rows.abscissae.push_back({name, column});
    Design design{plan.description, {}, {}, {}};
    try {
      design.test = plugins::create(type->second, setup);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception&) {
      continue;  // a type that wants more than this library knows of
    }
    const TestDescription& description = design.test->describe();
    for (std::size_t k = 0; k < description.parameters.size(); ++k)
      design.parameters.push_back(std::isnan(description.nulls[k]) ? description.parameters[k].initial
                                                                   : description.nulls[k]);
    if (!plan.angle.empty() && !design.parameters.empty()) design.parameters[0] = plan.angle[0];
    std::vector<double> values;
    if (!predict(design, scale, free, values)) continue;
    const std::size_t n = setup.rows.count;
    for (std::size_t k = 0; k < plan.channels.size(); ++k) {
      double largest = 0;
      for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(values[k * n + i]));
      const bool plain_stretch = plan.channels[k] == "transverse_stretch";
      // Relative noise alone would make rows near zero exact: no row is known better than one of a tenth of the
      // largest.
      for (std::size_t i = 0; i < n; ++i) {
        const double value = std::max(std::abs(values[k * n + i]), 0.1 * largest);
        const auto& [along, stretches] = plan.abscissae[std::min(k, plan.abscissae.size() - 1)];
        const bool stress = plan.channels[k].starts_with("stress") && along.starts_with("stretch");
        const auto known = known_sd(evidence, plan.channels[k], value, stress ? stretches[i] : 1);
        design.sd.push_back(std::max(known.value_or(plain_stretch ? 0.005 : relative_noise * largest), 1e-12));
      }
    }
    library.push_back(std::move(design));
  }
  return library;
}

}  // namespace tunica::diagnosis
