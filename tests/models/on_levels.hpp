// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tunica/detail/strip_start.hpp"
#include "tunica/models/arterial_fibres.hpp"

/// Answers of models on every vector level, to be held against each other.
namespace tunica::testing {

using detail::VectorLevel;
using Rows = std::vector<std::vector<double>>;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The levels that this machine offers.
inline std::vector<VectorLevel> levels() {
  std::vector<VectorLevel> all;
  for (const auto level : {VectorLevel::baseline, VectorLevel::avx2, VectorLevel::avx512})
    if (level <= detail::best_vector_level()) all.push_back(level);
  return all;
}

/// Chooses a level, and the one before again at the end.
class OnLevel {
 public:
  explicit OnLevel(VectorLevel level) : before_(detail::vector_level()) { detail::use_vector_level(level); }
  ~OnLevel() { detail::use_vector_level(before_); }

 private:
  VectorLevel before_;
};

/// The largest difference relative to the largest number of the row, of at least 1e-3; infinite where
/// one is finite and the other not.
inline double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double scale = 1e-3, worst = 0;
  for (const double value : b)
    if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isfinite(a[i]) && std::isfinite(b[i]))
      worst = std::max(worst, std::abs(a[i] - b[i]));
    else if (std::isnan(a[i]) != std::isnan(b[i]) || (!std::isnan(a[i]) && a[i] != b[i]))
      return infinity;
  }
  return worst / scale;
}
inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
         });
}

enum { mu, k1, k2, theta, kappa, count };
struct Dispersed {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return {.i1 = p[kappa], .fibre = 1.0 - 3.0 * p[kappa], .offset = T(-1), .angle = p[theta] * degree};
  }
};
inline const std::vector<double> parameters{22, 15, 0.4, 57, 0.2};

inline ModelDescription five_parameters() {
  ModelDescription description;
  description.type = "levels";
  description.parameters = {arterial::mu(),
                            arterial::k1(),
                            arterial::k2(),
                            arterial::theta(),
                            {"kappa", "1", 0.1, 0, 1. / 3, Scale::linear, "", ""}};
  return description;
}
inline std::unique_ptr<EnergyPart> fibres(EnergyPart::Active active) {
  return std::make_unique<LawPart<laws::Exponential, Dispersed, count>>(
      EnergyPart::Description{"fibres", EnergyPart::Role::fibre, active, true, {kappa, theta}, {k1, k2}, false});
}

/// Fibres whose law is linear, so that they bend nowhere while their invariant moves with the parameters.
inline std::unique_ptr<EnergyPart> straight_fibres() {
  return std::make_unique<LawPart<laws::Linear, Dispersed, count>>(EnergyPart::Description{
      "straight", EnergyPart::Role::fibre, EnergyPart::Active::always, true, {kappa, theta}, {k1}, true});
}

/// A matrix and fibres; the same with a part of I2 and a second family; a matrix alone, and with linear fibres.
inline std::vector<std::unique_ptr<Hyperelastic>> models() {
  using Active = EnergyPart::Active;
  std::vector<std::unique_ptr<Hyperelastic>> all;
  for (const auto active : {Active::argument_positive, Active::fibre_stretched, Active::always})
    all.push_back(std::make_unique<Hyperelastic>(five_parameters(),
                                                 energy_parts(isotropic::neo_hookean<count>(mu), fibres(active))));
  all.push_back(std::make_unique<Hyperelastic>(
      five_parameters(),
      energy_parts(isotropic::neo_hookean<count>(mu), fibres(Active::argument_positive),
                   isotropic::part<laws::Exponential, isotropic::SecondInvariant, count>("second", {k1, k2}))));
  all.push_back(std::make_unique<Hyperelastic>(five_parameters(), energy_parts(isotropic::neo_hookean<count>(mu))));
  all.push_back(std::make_unique<Hyperelastic>(five_parameters(),
                                               energy_parts(isotropic::neo_hookean<count>(mu), straight_fibres())));
  all.push_back(std::make_unique<Hyperelastic>(
      five_parameters(),
      energy_parts(straight_fibres(), isotropic::neo_hookean<count>(mu), fibres(Active::argument_positive))));
  return all;
}

inline Rows along_axes(const Model& model, std::size_t n) {
  std::vector<double> c(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    c[i] = 1 + 0.02 * static_cast<double>(i);
    c[n + i] = 1.1 - 0.003 * static_cast<double>(i);
    c[2 * n + i] = 1 / (c[i] * c[n + i]);
  }
  Rows rows{std::vector<double>(n), std::vector<double>(3 * n), std::vector<double>(6 * n),
            std::vector<double>(3 * count * n), std::vector<double>(count * n)};
  EXPECT_TRUE(model.evaluate_axes({n, c, parameters}, {rows[0], rows[1], rows[2], rows[3], rows[4]}).ok());
  return rows;
}
inline Rows on_tensors(const Model& model, std::size_t n) {
  std::vector<double> C(6 * n);
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t i = 0; i < n; ++i)
      C[k * n + i] = k < 3 ? 1 + 0.01 * static_cast<double>((k + 1) * i % 17) : 0.02 * static_cast<double>(i % 5);
  Rows rows{std::vector<double>(n), std::vector<double>(6 * n), std::vector<double>(36 * n),
            std::vector<double>(6 * count * n)};
  EXPECT_TRUE(model.evaluate({n, C, parameters, {}, {}}, {rows[0], rows[1], rows[2], rows[3], {}}).ok());
  return rows;
}

/// With dispersion, a switch by the fibres' own stretch makes ∂W/∂y jump: some rows have no equilibrium.
inline bool jumps(const Model& model) {
  const auto parts = model.parts();
  return !parts.empty() && parts.back()->describe().active == EnergyPart::Active::fibre_stretched;
}

/// σ, y, their derivatives by parameters and along the path; those of σ by parameters again, as they are found where
/// nobody asks for y's.
inline Rows along_strip(const Model& model, std::size_t n, std::size_t loaded, double reach = 0.6) {
  std::vector<double> stretch(n);
  for (std::size_t i = 0; i < n; ++i) stretch[i] = 0.9 + reach * static_cast<double>(i) / static_cast<double>(n);
  Rows rows(7, std::vector<double>(n));
  for (const std::size_t k : {2, 3, 6}) rows[k].resize(count * n);
  StripPath path{.loaded = loaded, .parameters = parameters, .stretch = stretch, .stress = rows[0]};
  path.lateral = rows[1];
  path.stress_dp = rows[2];
  path.lateral_dp = rows[3];
  path.stress_by_l = rows[4];
  path.lateral_by_l = rows[5];
  const free_strip::Start start(stretch);
  start.set(path);
  Status status;
  EXPECT_TRUE(model.solve_strip(path, status));
  if (jumps(model) && !status.ok()) {
    EXPECT_THAT(status.reason(), ::testing::HasSubstr("jumps from one sign to the other"));
    return {};
  }
  EXPECT_TRUE(status.ok()) << status.reason();
  path.stress_dp = rows[6];
  path.stress = path.lateral = path.lateral_dp = path.stress_by_l = path.lateral_by_l = {};
  EXPECT_TRUE(model.solve_strip(path, status));
  EXPECT_TRUE(status.ok()) << status.reason();
  return rows;
}

}  // namespace tunica::testing
