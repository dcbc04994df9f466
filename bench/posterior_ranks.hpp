// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <unistd.h>

#include "assembly/assembly.hpp"
#include "assembly/curve_shapes.hpp"
#include "assembly/unlisted_prior.hpp"
#include "numerics/distributions.hpp"
#include "posterior/counter_random.hpp"
#include "posterior/posterior.hpp"
#include "tunica/random.hpp"

/// Simulation-based calibration (S. Talts et al., arXiv:1804.06788, 2018): parameters are drawn from the prior, data
/// from the model there, and draws from the posterior of these data. Among independent draws the rank of the truth is
/// then uniform, whatever the model.
namespace tunica::bench {

/// A run whose noise is stated and whose prior is uniform between bounds, so that both can be drawn from. The data of
/// the file say where is measured, and nothing else.
struct Prior {
  /// `tests`: JSON with columns of "rows.csv", whose text is `table`.
  Prior(const plugins::Catalogue& catalogue, const std::string& model, const std::string& tests,
        const std::string& table) {
    std::string pattern = (std::filesystem::temp_directory_path() / "tunica-ranks-XXXXXX").string();
    const std::filesystem::path folder = mkdtemp(pattern.data());
    std::ofstream(folder / "rows.csv") << table;
    std::ofstream(folder / "experiment.json") << fmt::format(
        R"({{"format": 1, "models": {{"m": {}}}, "tests": {}, "objective": "least_squares",
          "optimizers": {{"lm": {{"type": "ceres_lm"}}}}, "runs": [{{"model": "m", "optimizer": "lm"}}]}})",
        model, tests);
    experiment = experiment::read_experiment(folder / "experiment.json", catalogue);
    assembly = std::make_unique<assembly::Assembly>(experiment, experiment.runs.front(), catalogue);
    std::filesystem::remove_all(folder);
  }

  experiment::Experiment experiment;
  std::unique_ptr<assembly::Assembly> assembly;
};

/// 40 stretches up to `to`.
inline std::string stretches(double to) {
  std::string table = "stretch [1],stress [kPa]\n";
  for (int i = 1; i <= 40; ++i) table += fmt::format("{},{}\n", 1 + (to - 1) * i / 40, 1 + i);
  return table;
}

inline std::string test_of(const std::string& name, const std::string& type, double noise) {
  return fmt::format(
      R"("{}": {{{}, "data": {{"file": "rows.csv", "columns": {{"stretch": "stretch", "stress": "stress"}},
    "noise": {{"absolute": {}}}}}}})",
      name, type, noise);
}

/// gho on two strips to stretch 1.4, with a noise that leaves kappa anywhere between its bounds.
inline Prior gho_strips(const plugins::Catalogue& catalogue) {
  const double noise = 0.3;  // kPa; the stress is some 15 kPa
  return {catalogue,
          R"({"type": "gho", "parameters": {"mu": {"min": 9, "max": 36}, "k1": {"min": 12, "max": 48},
              "k2": {"min": 0.1, "max": 0.9}, "kappa": {"max": 0.3}, "theta": {"min": 40, "max": 55}}})",
          fmt::format("{{{}, {}}}", test_of("circ", R"("type": "uniaxial", "direction": "circumferential")", noise),
                      test_of("axial", R"("type": "uniaxial", "direction": "axial")", noise)),
          stretches(1.4)};
}

/// Two terms of Ogden's rubber, in tension along one axis and two; their exponents keep the terms apart.
inline Prior ogden_rubber(const plugins::Catalogue& catalogue) {
  const double noise = 40;  // kPa; the stress is some 5 MPa
  return {catalogue,
          R"({"type": "ogden", "terms": 2, "parameters": {"mu_1": {"min": 200, "max": 800},
              "alpha_1": {"min": 0.5, "max": 3}, "mu_2": {"min": 0.1, "max": 10, "scale": "log"},
              "alpha_2": {"min": 3, "max": 6}}})",
          fmt::format("{{{}, {}}}", test_of("one", R"("type": "uniaxial", "direction": "circumferential")", noise),
                      test_of("two", R"("type": "biaxial", "protocol": "equibiaxial")", noise)),
          stretches(5)};
}

/// A long tube of hgo, whose diameter and axial force are measured at 20 pressures up to 16 kPa.
inline Prior hgo_tube(const plugins::Catalogue& catalogue) {
  std::string table = "pressure [kPa],diameter [1],force [mN]\n";
  for (int i = 1; i <= 20; ++i) table += fmt::format("{},{},{}\n", 0.8 * i, 1 + 0.02 * i, 700 + i);
  return {catalogue,
          R"({"type": "hgo", "parameters": {"mu": {"min": 10, "max": 40}, "k1": {"min": 10, "max": 50},
              "k2": {"min": 0.1, "max": 1}, "theta": {"min": 40, "max": 55}}})",
          R"({"tube": {"type": "thick_wall_pressurisation", "inner_radius": "3.71 mm", "thickness": "2.06 mm",
              "axial_stretch": 1.2, "data": {"file": "rows.csv", "columns": {"pressure": "pressure",
              "outer_diameter_stretch": "diameter", "axial_force": "force"},
              "noise": {"outer_diameter_stretch": {"absolute": 0.01}, "axial_force": {"absolute": "20 mN"}}}}})",
          table};
}

/// Ranks of the truth in 0 … `draws_of_rank`, and how often bands of measurements hold a row that was never fitted.
struct Ranks {
  static constexpr std::size_t draws_of_rank = 39;  ///< that the truth is ranked among, evenly spaced
  std::vector<std::string> names;
  std::vector<std::vector<std::size_t>> of;  ///< by parameter, one a data set
  std::size_t new_rows = 0, inside = 0;
  std::size_t judged_converged = 0, sets = 0;

  /// Counts in bins of equal width, 40 a multiple of their number.
  [[nodiscard]] std::vector<std::size_t> histogram(std::size_t parameter, std::size_t bins) const {
    std::vector<std::size_t> counts(bins, 0);
    for (const std::size_t rank : of[parameter]) ++counts[rank * bins / (draws_of_rank + 1)];
    return counts;
  }
  /// The probability of a χ² of the histogram as large as it is, where ranks are uniform.
  [[nodiscard]] double chance(std::size_t parameter, std::size_t bins) const {
    const double expected = static_cast<double>(sets) / static_cast<double>(bins);
    double chi_squared = 0;
    for (const std::size_t count : histogram(parameter, bins))
      chi_squared += (static_cast<double>(count) - expected) * (static_cast<double>(count) - expected) / expected;
    return numerics::chi_squared_above(chi_squared, static_cast<double>(bins - 1));
  }
};

/// A misfit of the prior of discrepancy.hpp, added to predictions: none with probability ½.
inline void add_misfit(const assembly::Assembly& assembly, posterior::CounterRandom& random,
                       std::vector<double>& predictions) {
  namespace unlisted = assembly::unlisted;
  double all = 0, share = 2 * random.uniform() - 1;
  for (const double size : unlisted::sizes) all += std::exp(unlisted::log_weight(size));
  if (share < 0) return;
  double tau = unlisted::sizes.back();
  for (const double size : unlisted::sizes)
    if ((share -= std::exp(unlisted::log_weight(size)) / all) < 0) {
      tau = size;
      break;
    }
  const auto roughness = static_cast<std::size_t>(static_cast<double>(unlisted::falls.size()) * random.uniform());
  for (const auto& view : assembly.layout().channels) {
    const auto shapes = assembly::curve_shapes(view.abscissa, 14);
    const auto first = predictions.begin() + static_cast<std::ptrdiff_t>(view.offset);
    const auto [low, high] = std::minmax_element(first, first + static_cast<std::ptrdiff_t>(view.count));
    const double range = *high - *low;
    const double highest = shapes.degree.empty() ? 0 : *std::ranges::max_element(shapes.degree);
    const unlisted::Variances variances(roughness, static_cast<unsigned>(highest));
    for (Eigen::Index k = 0; k < shapes.columns.cols(); ++k) {
      const double variance = variances.of(shapes.degree[static_cast<std::size_t>(k)]);
      const double height = tau * range * std::sqrt(variance) * random.normal();
      for (std::size_t i = 0; i < view.count; ++i)
        first[static_cast<std::ptrdiff_t>(i)] += height * shapes.columns(static_cast<Eigen::Index>(i), k);
    }
  }
}

/// Of `draws` from the posterior of each data set. `discrepancy`: data and posterior have one.
inline Ranks ranks(const Prior& prior, std::size_t sets, std::size_t draws, std::uint64_t seed,
                   bool discrepancy = false) {
  const assembly::Assembly& assembly = *prior.assembly;
  const std::size_t n = assembly.layout().parameters.size();
  Ranks found;
  found.sets = sets;
  found.of.assign(n, std::vector<std::size_t>(sets));
  for (const auto& parameter : assembly.layout().parameters) found.names.push_back(parameter.name);
  std::vector<std::size_t> inside(sets), judged(sets);
  std::vector<double> sd;  // of the predictions, all of which are fitted
  for (const auto& view : assembly.layout().channels)
    sd.insert(sd.end(), view.sigma.rows.sd.begin(), view.sigma.rows.sd.end());
  tbb::parallel_for(std::size_t{0}, sets, [&](std::size_t k) {
    posterior::CounterRandom random(derive_seed(seed, fmt::format("data set {}", k)));
    std::vector<double> unit(n), truth(n), measured(sd.size());
    for (double& x : unit) x = random.uniform();
    assembly.box().from_unit(unit, truth);
    const auto workspace = assembly.evaluator().make_workspace();
    if (!assembly.evaluator().predict(truth, measured, {}, *workspace).ok()) throw std::runtime_error("no prediction");
    if (discrepancy) add_misfit(assembly, random, measured);
    std::vector<double> again = measured;  // measured once more, but not used in the fit
    for (std::size_t i = 0; i < sd.size(); ++i) {
      measured[i] += sd[i] * random.normal();
      again[i] += sd[i] * random.normal();
    }
    const auto made = posterior::sample(assembly, truth, draws, derive_seed(seed, fmt::format("chains {}", k)), {},
                                        measured, discrepancy);
    if (!made.complete) throw std::runtime_error(made.status.reason());
    judged[k] = made.converged() ? 1 : 0;
    const std::size_t each = made.chains.front().draws();
    for (std::size_t j = 0; j < n; ++j) {
      std::size_t rank = 0;
      for (std::size_t d = 0; d < Ranks::draws_of_rank; ++d) {
        const std::size_t place = d * made.draws() / Ranks::draws_of_rank;
        rank += made.chains[place / each].value(place % each, j) < truth[j] ? 1 : 0;
      }
      found.of[j][k] = rank;
    }
    for (std::size_t i = 0; i < sd.size(); ++i)
      inside[k] += again[i] >= made.bands.lowest_measured[i] && again[i] <= made.bands.highest_measured[i] ? 1 : 0;
  });
  for (std::size_t k = 0; k < sets; ++k) {
    found.inside += inside[k];
    found.judged_converged += judged[k];
  }
  found.new_rows = sets * sd.size();
  return found;
}

}  // namespace tunica::bench
