// SPDX-License-Identifier: Apache-2.0
#include "signatures.hpp"

#include <cmath>

namespace blind {
namespace {

/// Every place an effect can sit, but for the single rows.
std::vector<Target> targets(const Effect& effect, const Protocol& protocol) {
  using enum Effect::Where;
  std::vector<Target> all;
  switch (effect.where) {
    case material:
    case all_tubes:
      return {{}};
    case tube_or_all:
      all.push_back({});
      for (std::size_t i = 0; i < protocol.tubes.size(); ++i)
        all.push_back({.strip = {}, .tube = i, .channel = {}, .row = {}});
      return all;
    case strip:
      for (std::size_t i = 0; i < protocol.strips.size(); ++i)
        all.push_back({.strip = i, .tube = {}, .channel = {}, .row = {}});
      return all;
    case channel:
      for (std::size_t k = 0; k < channel_count(protocol); ++k)
        all.push_back({.strip = {}, .tube = {}, .channel = k, .row = {}});
      return all;
    case points:  // whole curves: of diameters, since other mechanisms shift those of forces
      for (std::size_t i = 0; i < protocol.tubes.size(); ++i)
        all.push_back({.strip = {}, .tube = {}, .channel = protocol.strips.size() + 2 * i, .row = {}});
  }
  return all;
}

}  // namespace

Eigen::VectorXd projected(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& v) {
  return v - jacobian * jacobian.householderQr().solve(v);
}

std::vector<Signature> signatures(const Specimen& specimen, const Tissue& fitted, const Noise& noise,
                                  const Eigen::MatrixXd& jacobian) {
  const Specimen about{fitted, specimen.protocol};
  const auto bare = observe(about.protocol, {fitted});
  std::vector<Signature> all;
  const auto add = [&](const Effect& effect, const Target& target, std::vector<double> change) {
    const Eigen::VectorXd whole = whiten(about.protocol, noise, change), left = projected(jacobian, whole);
    const double length = left.norm(), whole_length = whole.norm();
    if (!(length > 1e-6 * whole_length)) return;  // nothing that the base model would not absorb
    const bool one_sided = effect.low == effect.null || effect.even;
    all.push_back({&effect, target, one_sided, left / length, length / whole_length});
  };
  for (const Effect& effect : catalogue()) {
    if (!makes_sense(effect, about)) continue;
    std::vector<std::map<std::string, double>> settings{{}};
    for (const Effect::Nuisance& nuisance : effect.nuisances) {
      settings.clear();
      for (const double value : nuisance.grid) settings.push_back({{nuisance.name, value}});
    }
    for (const Target& target : targets(effect, about.protocol)) {
      for (const auto& nuisance : settings) {
        HiddenEffect hidden{.effect = &effect, .target = target, .nuisance = nuisance};
        hidden.largest = effect.logarithmic ? std::log(effect.high) : effect.high - effect.null;
        hidden.distance = (effect.even ? 0.3 : 0.01) * hidden.largest;
        auto y = observe(about.protocol, world_with(about, {hidden}));
        bool good = true;
        for (std::size_t i = 0; i < y.size(); ++i) {
          y[i] -= bare[i];
          good &= std::isfinite(y[i]);
        }
        if (good) add(effect, target, std::move(y));
      }
    }
    if (effect.where != Effect::Where::points) continue;
    const auto layout = channels(about.protocol);
    for (std::size_t k = 0; k < layout.size(); ++k) {
      for (std::size_t row = 0; row < layout[k].count; ++row) {
        std::vector<double> spike(bare.size(), 0.0);
        spike[layout[k].first + row] = 1;
        add(effect, {.strip = {}, .tube = {}, .channel = k, .row = row}, std::move(spike));
      }
    }
  }
  return all;
}

Explanation best_account(const std::vector<Signature>& all, const Eigen::VectorXd& residual) {
  Explanation best;
  for (const Signature& one : all) {
    const double c = one.shape.dot(residual) / residual.norm(), size = one.one_sided ? c : std::abs(c);
    if (size > best.correlation) best = {one.effect, one.target, size};
  }
  return best;
}

}  // namespace blind
