// SPDX-License-Identifier: Apache-2.0
#include "conformance/material_point.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conformance/handout.hpp"

namespace tunica::conformance {

Tensor to_tensor(const Matrix& C) { return {C(0, 0), C(1, 1), C(2, 2), C(0, 1), C(1, 2), C(2, 0)}; }
Matrix to_matrix(const Tensor& C) {
  Matrix m;
  m << C[0], C[3], C[5], C[3], C[1], C[4], C[5], C[4], C[2];
  return m;
}

std::string where(const Model& model, const Point& point) {
  const auto& declared = model.describe().parameters;
  std::vector<std::string> values;
  for (std::size_t j = 0; j < point.p.size(); ++j)
    values.push_back(fmt::format("{} = {:.6g}", j < declared.size() ? declared[j].name : "?", point.p[j]));
  return fmt::format(" at C (tt, zz, rr, tz, zr, tr) = [{:.6g}], {}", fmt::join(point.C, ", "),
                     fmt::join(values, ", "));
}

bool Evaluated::finite() const {
  const auto all = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  return std::isfinite(energy) && all(stress) && all(tangent) && all(stress_dp) && all(state);
}

Evaluated evaluate(const Model& model, const Tensor& C, std::span<const double> parameters) {
  const ModelDescription& description = model.describe();
  Handout handout("the model");
  const MaterialPoints points{1, handout.input("C", C), handout.input("parameters", parameters), {}, {}};
  const std::size_t derivatives = description.parameter_derivatives ? 6 * parameters.size() : 0;
  const MaterialResponse response{handout.output("energy", 1), handout.output("stress", 6),
                                  handout.output("tangent", 36), handout.output("stress_dp", derivatives),
                                  handout.output("state", description.history_size)};
  const Status status = model.evaluate(points, response);
  handout.verify(status.ok());
  if (!status.ok()) throw std::runtime_error("the model answers '" + status.reason() + "'");
  Evaluated out;
  out.energy = response.energy[0];
  std::copy(response.stress.begin(), response.stress.end(), out.stress.begin());
  std::copy(response.tangent.begin(), response.tangent.end(), out.tangent.begin());
  out.stress_dp.assign(response.stress_dp.begin(), response.stress_dp.end());
  out.state.assign(response.state.begin(), response.state.end());
  return out;
}

Tensor Sampler::right_cauchy_green() {
  std::uniform_real_distribution<double> entry(-0.25, 0.25);
  Matrix F = Matrix::Identity();
  for (int i = 0; i < 9; ++i) F(i / 3, i % 3) += entry(engine_);
  return to_tensor(F.transpose() * F);
}

std::vector<double> Sampler::parameters(const std::vector<Parameter>& declared) {
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  std::vector<double> p;
  for (const Parameter& parameter : declared) {
    const double x = unit(engine_), min = parameter.min, max = parameter.max;
    p.push_back(parameter.scale == Scale::log ? min * std::pow(max / min, x) : min + x * (max - min));
  }
  return p;
}

Point Sampler::finite_point(const Model& model, bool shear) {
  constexpr int patience = 500;
  std::string reason = "its numbers are not finite there";
  for (int attempt = 0; attempt < patience; ++attempt) {
    Point point{right_cauchy_green(), parameters(model.describe())};
    if (!shear) point.C[3] = point.C[4] = point.C[5] = 0;
    ++drawn_;
    try {
      if (evaluate(model, point.C, point.p).finite()) return point;
    } catch (const std::runtime_error& failure) {
      reason = failure.what();
    }
    ++again_;
  }
  throw std::runtime_error(
      fmt::format("of {} states with strains up to 25 % and parameters within their bounds none could be evaluated "
                  "({}); narrow the declared bounds",
                  patience, reason));
}
Point Sampler::point(const Model& model) { return finite_point(model, true); }
Point Sampler::diagonal_point(const Model& model) { return finite_point(model, false); }

std::string Sampler::drawn_again() const {
  return again_ == 0 ? "" : fmt::format("{} of {} states drawn again, where energies overflow or end", again_, drawn_);
}

}  // namespace tunica::conformance
