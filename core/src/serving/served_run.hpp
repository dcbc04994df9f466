// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/assembly.hpp"

namespace tunica::serving {

/// An evaluation that fails, with its reason: the model's fault, not that of who asks.
class ModelFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One run of an experiment as functions of its free parameters, in base units:
///
///     objective    f(p), one number
///     residuals    r(p), Layout::residual_count numbers; the objective is Σ w ρ(‖r_b‖²) over the blocks of the layout
///     predictions  y(p), one vector a channel of a test, in the order of Layout::channels
///
/// Thread-safe: each call has its own scratch.
class ServedRun {
 public:
  enum class Function { objective, residuals, predictions };
  explicit ServedRun(const assembly::Assembly& assembly) : assembly_(assembly) {}

  [[nodiscard]] std::size_t input_size() const { return layout().parameters.size(); }
  /// Length of each output vector.
  [[nodiscard]] std::vector<std::size_t> output_sizes(Function function) const;
  /// Throws InputError where the parameters lie outside their bounds, and ModelFailure where they cannot be evaluated.
  [[nodiscard]] std::vector<std::vector<double>> values(Function function, std::span<const double> parameters) const;
  /// ∂output/∂p of one output vector, row-major. Exact where the tests' derivatives are.
  [[nodiscard]] std::vector<double> jacobian(Function function, std::size_t output,
                                             std::span<const double> parameters) const;
  [[nodiscard]] const assembly::Layout& layout() const { return assembly_.layout(); }

 private:
  void check(std::span<const double> parameters) const;
  const assembly::Assembly& assembly_;
};

/// "objective", "residuals", "predictions".
std::string_view name_of(ServedRun::Function function);

}  // namespace tunica::serving
