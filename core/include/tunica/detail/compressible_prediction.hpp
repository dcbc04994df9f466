// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <ceres/jet.h>

#include "tunica/detail/free_faces.hpp"
#include "tunica/test.hpp"

/// Tests of one material point with a compressible model: values and derivatives of every row.
namespace tunica::free_faces {

/// The same call with the incompressible model, if the model keeps its volume.
inline TestInput without_compressibility(const TestInput& input) {
  if (!input.model.describe().compressible) return input;
  const Model& model = input.model.incompressible();
  return {model, input.model_parameters.first(model.describe().parameters.size()), input.test_parameters,
          input.abscissae, input.layers};
}

/// One call of a test that can have both kinds of material: `kept(input, output)` simulates J = 1, `changing(input,
/// output)` solves for the volume. If a compressible model keeps its volume, results are those of `kept`, bit for bit.
/// Only derivatives by parameters, including the vanishing one, are those of the whole model.
template <class Kept, class Changing>
Status by_volume(const TestInput& input, const TestOutput& output, const Kept& kept, const Changing& changing) {
  if (!input.model.describe().compressible) return kept(input, output);
  if (!input.model.keeps_volume(input.model_parameters)) return changing(input, output);
  TestOutput values = output;
  values.jacobian = {};
  const Status status = kept(without_compressibility(input), values);
  return !status.ok() || output.jacobian.empty() ? status : changing(input, {{}, output.jacobian, {}, {}});
}

/// Predicts a test with a compressible model. A Specimen defines the prescribed and the measured quantities of a row,
/// for any number type; x are the abscissae of a row, and q are the test's parameters:
///
///     std::size_t count() const, channels() const;                                     // rows; channels
///     std::size_t faces() const;                                                       // how many are free
///     template <class T> TensorOf<T> prescribed(std::span<const T> x, std::span<const T> q) const;        // C₀
///     template <class T> TensorOf<T> face(std::size_t k, std::span<const T> q) const;                     // d_k⊗d_k
///     template <class T> T channel(std::size_t k, std::span<const T> x, std::span<const T> q,
///                                  const TensorOf<T>& C, const TensorOf<T>& S) const;
///     std::string row_name(std::size_t row, std::span<const double> x) const;
///     double diagnostic(std::size_t d, std::span<const double> q, const Tensor& C, const Tensor& S) const;
///
/// `columns`: the abscissae. Derivatives are exact: the equilibrium is differentiated implicitly.
template <class Specimen>
Status predict(const Specimen& specimen, std::span<const std::span<const double>> columns, const TestInput& input,
               const TestOutput& output) {
  using Dual = ceres::Jet<double, 1>;
  const ModelDescription& model = input.model.describe();
  if (model.history_size > 0)
    return Status::failed("the model changes its volume and remembers; take one of the two out");
  if (!output.jacobian.empty() && !model.parameter_derivatives)
    return Status::failed("the model has no parameter derivatives; difference the whole prediction");
  const std::size_t n = specimen.count(), m = specimen.channels(), size = n * m;
  const std::size_t of_model = input.model_parameters.size(), of_test = input.test_parameters.size();
  const std::span<const double> q = input.test_parameters;
  std::array<Tensor, 2> faces{};
  for (std::size_t k = 0; k < specimen.faces(); ++k) faces[k] = specimen.template face<double>(k, q);
  Point point(input.model, input.model_parameters, std::span(faces).first(specimen.faces()));
  std::vector<double> x(columns.size());
  std::vector<Dual> moving_x(columns.size()), moving_q(of_test);

  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t a = 0; a < columns.size(); ++a) x[a] = columns[a][i];
    const std::span<const double> at(x);
    if (Status status = point.solve(specimen.template prescribed<double>(at, q), !output.jacobian.empty());
        !status.ok())
      return Status::failed(specimen.row_name(i, at) + ": " + status.reason());
    for (std::size_t k = 0; k < m && !output.values.empty(); ++k) {
      const double y = specimen.template channel<double>(k, at, q, point.C(), point.stress());
      if (!std::isfinite(y))
        return Status::failed(specimen.row_name(i, at) +
                              ": the stress overflows; narrow the bounds of the model's parameters");
      output.values[k * n + i] = y;
    }
    for (std::size_t d = 0; d * n < output.diagnostics.size(); ++d)
      output.diagnostics[d * n + i] = specimen.diagnostic(d, q, point.C(), point.stress());

    for (std::size_t a = 0; a < x.size(); ++a) moving_x[a] = Dual(x[a]);
    for (std::size_t j = 0; j < of_test; ++j) moving_q[j] = Dual(q[j]);
    const std::span<const Dual> dual_x(moving_x), dual_q(moving_q);
    const auto write = [&](const Tensor& dC, const Tensor& dS, std::span<double> column) {
      TensorOf<Dual> C, S;
      for (std::size_t c = 0; c < 6; ++c) {
        C[c] = Dual(point.C()[c]);
        S[c] = Dual(point.stress()[c]);
        C[c].v[0] = dC[c];
        S[c].v[0] = dS[c];
      }
      for (std::size_t k = 0; k < m; ++k)
        column[k * n + i] = specimen.template channel<Dual>(k, dual_x, dual_q, C, S).v[0];
    };
    const auto by_setting = [&](Dual& setting, std::span<double> column) {
      setting.v[0] = 1;
      const auto parts = [](const TensorOf<Dual>& of) {
        Tensor d;
        for (std::size_t c = 0; c < 6; ++c) d[c] = of[c].v[0];
        return d;
      };
      std::array<Tensor, 2> turned{};
      for (std::size_t k = 0; k < specimen.faces(); ++k) turned[k] = parts(specimen.template face<Dual>(k, dual_q));
      Tensor dC, dS;
      point.follow(parts(specimen.template prescribed<Dual>(dual_x, dual_q)), std::span(turned).first(specimen.faces()),
                   dC, dS);
      write(dC, dS, column);
      setting.v[0] = 0;
    };
    for (std::size_t j = 0; j < of_model && !output.jacobian.empty(); ++j) {
      Tensor dC, dS;
      point.by_parameter(j, dC, dS);
      write(dC, dS, output.jacobian.subspan(j * size, size));
    }
    for (std::size_t j = 0; j < of_test && !output.jacobian.empty(); ++j)
      by_setting(moving_q[j], output.jacobian.subspan((of_model + j) * size, size));
    for (std::size_t a = 0; a < columns.size() && !output.abscissa_derivative.empty(); ++a)
      by_setting(moving_x[a], output.abscissa_derivative.subspan(a * size, size));
  }
  return {};
}

}  // namespace tunica::free_faces
