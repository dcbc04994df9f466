// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tunica/model.hpp"

/// Loading paths of models with memory in principal axes: the elastic response of all rows in one batch, then memory
/// row by row, with derivatives carried forward (axis_step.hpp).
namespace tunica::detail {

/// The points of a path and their elastic response. Scratch for one call at a time: it grows to the largest path seen.
///
/// Order of calls: prepare(), set `c` of every row, evaluate(), begin(), then for each row in loading order: row(),
/// derivatives of c by the moving directions, remember().
class AxisPath {
 public:
  /// The model and its parameters have to live longer than the calls below.
  void prepare(const Model& model, std::span<const double> parameters, std::size_t rows) {
    model_ = &model;
    parameters_ = parameters;
    elastic_count_ = model.elastic().describe().parameters.size();
    history_ = model.describe().axis_history_size;
    n_ = rows + 1;  // the last one is at rest
    if (c_.size() < 3 * n_) {
      c_.resize(3 * n_);
      energy_.resize(n_);
      gradient_.resize(3 * n_);
      hessian_.resize(6 * n_);
    }
    for (std::size_t a = 0; a < 3; ++a) c_[a * n_ + rows] = 1;
  }
  /// Squared stretches of axis a, one a row.
  double* c(std::size_t a) { return c_.data() + a * n_; }

  /// The elastic response of all rows and at rest.
  Status evaluate(bool parameters) {
    if (parameters) {
      gradient_dp_.resize(std::max(gradient_dp_.size(), 3 * n_ * elastic_count_));
      energy_dp_.resize(std::max(energy_dp_.size(), n_ * elastic_count_));
    }
    return model_->elastic().evaluate_axes({n_, {c_.data(), 3 * n_}, parameters_.first(elastic_count_)},
                                           {{energy_.data(), n_},
                                            {gradient_.data(), 3 * n_},
                                            {hessian_.data(), 6 * n_},
                                            {gradient_dp_.data(), parameters ? 3 * n_ * elastic_count_ : 0},
                                            {energy_dp_.data(), parameters ? n_ * elastic_count_ : 0}});
  }

  /// Rows of `moving` + `still` directions, and of all parameters of the model if wanted; the state at rest. Moving
  /// directions move the stretches of a row, still ones come through the state only.
  void begin(std::size_t moving, std::size_t still, bool parameters, bool timed) {
    moving_ = moving;
    place_ = 1 + moving + still;
    with_parameters_ = parameters;
    width_ = place_ + (parameters ? parameters_.size() : 0);
    timed_ = timed;
    first_ = true;
    c_rows_.assign(3 * width_, 0);
    g_rows_.assign(3 * width_, 0);
    energy_row_.assign(width_, 0);
    state_.assign(history_ * width_, 0);
    load(n_ - 1);
    AxisStep step = step_of(0);
    step.at_rest = true;
    model_->remember(step);
  }
  [[nodiscard]] std::size_t width() const { return width_; }
  /// Place of the first parameter in a row.
  [[nodiscard]] std::size_t parameter_place() const { return place_; }

  /// Begins row i; then `c_row(a)[1 + k]` are to be set for the moving directions k.
  void load(std::size_t i) {
    at_ = i;
    for (std::size_t a = 0; a < 3; ++a) {
      double* const row = c_row(a);
      row[0] = c_[a * n_ + i];
      for (std::size_t k = 1; k <= moving_; ++k) row[k] = 0;
    }
  }
  double* c_row(std::size_t a) { return c_rows_.data() + a * width_; }
  /// After remember(): g_a with its derivatives.
  [[nodiscard]] const double* g_row(std::size_t a) const { return g_rows_.data() + a * width_; }

  /// The response of the current row, with what it remembers, `time_step` after the row before.
  void remember(double time_step) {
    model_->remember(step_of(time_step));
    first_ = false;
  }
  /// The state moves with the row's unknown, direction 0: what direction k does to the unknown is by_unknown[k].
  /// Afterwards the state of the row is a total derivative by all directions but the unknown.
  void settle(const double* by_unknown) {
    for (std::size_t s = 0; s < history_; ++s) {
      double* const row = state_.data() + s * width_;
      const double own = row[1];
      if (own == 0) continue;
      row[1] = 0;
      for (std::size_t k = 2; k < width_; ++k) row[k] += own * by_unknown[k];
    }
  }

 private:
  AxisStep step_of(double time_step) {
    static constexpr std::array<std::array<std::size_t, 3>, 3> pair{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
    const double* const g = gradient_.data() + at_;
    const double* const h = hessian_.data() + at_;
    double* const energy = energy_row_.data();
    energy[0] = energy_[at_];
    for (std::size_t a = 0; a < 3; ++a) g_row_of(a)[0] = g[a * n_];
    for (std::size_t k = 1; k <= moving_; ++k) {
      const std::array<double, 3> dc{c_row(0)[k], c_row(1)[k], c_row(2)[k]};
      energy[k] = g[0] * dc[0] + g[n_] * dc[1] + g[2 * n_] * dc[2];
      for (std::size_t a = 0; a < 3; ++a)
        g_row_of(a)[k] = h[pair[a][0] * n_] * dc[0] + h[pair[a][1] * n_] * dc[1] + h[pair[a][2] * n_] * dc[2];
    }
    for (std::size_t k = 1 + moving_; k < place_; ++k) {
      energy[k] = 0;
      for (std::size_t a = 0; a < 3; ++a) g_row_of(a)[k] = 0;
    }
    if (with_parameters_) {
      for (std::size_t j = 0; j < elastic_count_; ++j) {
        energy[place_ + j] = energy_dp_[j * n_ + at_];
        for (std::size_t a = 0; a < 3; ++a) g_row_of(a)[place_ + j] = gradient_dp_[(3 * j + a) * n_ + at_];
      }
      for (std::size_t j = place_ + elastic_count_; j < width_; ++j) {
        energy[j] = 0;
        for (std::size_t a = 0; a < 3; ++a) g_row_of(a)[j] = 0;
      }
    }
    return {width_,       with_parameters_ ? place_ : 0,
            parameters_,  time_step,
            timed_,       false,
            first_,       c_rows_.data(),
            energy,       g_rows_.data(),
            state_.data()};
  }
  double* g_row_of(std::size_t a) { return g_rows_.data() + a * width_; }

  const Model* model_ = nullptr;
  std::span<const double> parameters_;
  std::size_t elastic_count_ = 0, history_ = 0, n_ = 0, moving_ = 0, place_ = 1, width_ = 1, at_ = 0;
  bool with_parameters_ = false, timed_ = false, first_ = true;
  std::vector<double> c_, energy_, gradient_, hessian_, gradient_dp_, energy_dp_;  ///< all rows, as AxisResponse
  std::vector<double> c_rows_, g_rows_, energy_row_, state_;                       ///< of the current row
};

}  // namespace tunica::detail
