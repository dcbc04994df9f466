// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/loaded.hpp"

/// Models inside mechanisms, and everything they answer.
namespace tunica::testing {

inline std::unique_ptr<Model> model(const std::string& type) { return make_model(type); }

/// A model with fibres that carry load as the option fibre_switch says.
inline std::unique_ptr<Model> model(const std::string& type, const std::string& fibre_switch) {
  Options options;
  options.set("fibre_switch", fibre_switch);
  return make_model(type, options);
}

inline std::unique_ptr<Model> wrapped(const std::string& mechanism, std::unique_ptr<Model> base) {
  const auto& entry = catalogue().mechanisms().at(mechanism);
  return plugins::wrap(entry, std::move(base), defaults(entry.factory.options));
}

/// What a mechanism says of a model that it does not fit, or "accepted".
inline std::string refusal(const std::string& mechanism, std::unique_ptr<Model> base) {
  try {
    wrapped(mechanism, std::move(base));
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "accepted";
}

/// All outputs of a model at some points, stored.
struct Response {
  std::vector<double> energy, stress, tangent, stress_dp, state;
};

struct Wanted {
  bool stress_dp = false, state = false;
};

inline Response evaluate(const Model& model, const std::vector<double>& C, const std::vector<double>& parameters,
                         Wanted wanted = {}, const std::vector<double>& time_step = {},
                         const std::vector<double>& state = {}) {
  const std::size_t n = C.size() / 6;
  Response r{std::vector<double>(n), std::vector<double>(6 * n), std::vector<double>(36 * n), {}, {}};
  if (wanted.stress_dp) r.stress_dp.resize(6 * n * parameters.size());
  if (wanted.state) r.state.resize(n * model.describe().history_size);
  const Status status =
      model.evaluate({n, C, parameters, time_step, state}, {r.energy, r.stress, r.tangent, r.stress_dp, r.state});
  if (!status.ok()) throw std::runtime_error(status.reason());
  return r;
}

}  // namespace tunica::testing
