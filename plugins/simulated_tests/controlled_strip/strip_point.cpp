// SPDX-License-Identifier: Apache-2.0
#include "strip_point.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::controlled_strip {
namespace {

constexpr std::array<std::array<std::size_t, 3>, 3> pair{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

}  // namespace

bool StripPoint::can_be_followed(const Model& model) {
  const ModelDescription& description = model.describe();
  return description.history_size > 0 ? description.axis_history_size > 0
                                      : description.principal_axes && description.parameter_derivatives;
}

StripPoint::StripPoint(const Model& model, std::span<const double> parameters, std::size_t loaded, bool timed,
                       bool by_parameters, std::size_t others)
    : model_(model),
      elastic_(model.elastic()),
      parameters_(parameters),
      axis_{loaded, 1 - loaded, 2},
      timed_(timed),
      followed_(can_be_followed(model)),
      carries_(by_parameters && followed_),
      elastic_count_(elastic_.describe().parameters.size()),
      history_(followed_ ? model.describe().axis_history_size : model.describe().history_size),
      carried_(carries_ ? parameters.size() + others : 0),
      full_(1 + moving + carried_) {
  past_.assign(history_ * (followed_ ? full_ : 1), 0.0);
  stress_dp_.assign(carried_, 0.0);
  lateral_dp_ = stress_dp_;
}

bool StripPoint::begin() {
  c_ = {1, 1, 1};
  first_ = true;
  if (!followed_ || history_ == 0) return true;
  if (!on_axes(0, true, carries_)) return false;
  accept();
  first_ = true;
  return true;
}

bool StripPoint::evaluate(double l, double y, double time_step, bool by_parameters) {
  c_ = {std::exp(2 * l), std::exp(y), std::exp(-2 * l - y)};
  return followed_ ? on_axes(time_step, false, by_parameters && carries_) : on_tensors(time_step);
}

/// Elastic response and its derivatives by l, y and, if wanted, the parameters; then what the model remembers.
bool StripPoint::on_axes(double time_step, bool at_rest, bool by_parameters) {
  const std::size_t width = by_parameters ? full_ : 1 + moving;
  const bool energies = elastic_.describe().energy_derivatives;
  std::array<double, 3> c;
  for (std::size_t a = 0; a < 3; ++a) c[axis_[a]] = c_[a];
  double energy = 0;
  std::array<double, 3> gradient;
  std::array<double, 6> hessian;
  gradient_dp_.resize(by_parameters ? 3 * elastic_count_ : 0);
  energy_dp_.resize(by_parameters && energies ? elastic_count_ : 0);
  const Status status = elastic_.evaluate_axes({1, c, parameters_.first(elastic_count_)},
                                               {{&energy, 1}, gradient, hessian, gradient_dp_, energy_dp_});
  if (!status.ok()) {
    failure_ = status.reason();
    return false;
  }
  c_rows_.assign(3 * width, 0.0);
  g_rows_.assign(3 * width, 0.0);
  energy_row_.assign(width, 0.0);
  // ∂c/∂l = (2 c1, 0, −2 c3), ∂c/∂y = (0, c2, −c3)
  const std::array<std::array<double, moving>, 3> by{{{2 * c_[0], 0}, {0, c_[1]}, {-2 * c_[2], -c_[2]}}};
  energy_row_[0] = energy;
  for (std::size_t a = 0; a < 3; ++a) {
    double* const row = c_rows_.data() + axis_[a] * width;
    row[0] = c_[a];
    for (std::size_t k = 0; k < moving && !at_rest; ++k) row[1 + k] = by[a][k];
  }
  for (std::size_t a = 0; a < 3; ++a) {
    double* const row = g_rows_.data() + a * width;
    row[0] = gradient[a];
    for (std::size_t k = 1; k <= moving && !at_rest; ++k) {
      energy_row_[k] += gradient[a] * c_rows_[a * width + k];
      for (std::size_t b = 0; b < 3; ++b) row[k] += hessian[pair[a][b]] * c_rows_[b * width + k];
    }
    for (std::size_t j = 0; by_parameters && j < elastic_count_; ++j) row[1 + moving + j] = gradient_dp_[3 * j + a];
  }
  for (std::size_t j = 0; j < energy_dp_.size(); ++j) energy_row_[1 + moving + j] = energy_dp_[j];

  if (history_ > 0) {
    now_.resize(history_ * full_);
    now_width_ = width;
    for (std::size_t s = 0; s < history_; ++s)
      for (std::size_t k = 0; k < width; ++k) now_[s * width + k] = k == 0 || by_parameters ? past_[s * full_ + k] : 0;
    model_.remember({width, by_parameters ? 1 + moving : 0, parameters_, time_step, timed_, at_rest, first_,
                     c_rows_.data(), energy_row_.data(), g_rows_.data(), now_.data()});
  }
  const std::array<const double*, 3> g{g_rows_.data() + axis_[0] * width, g_rows_.data() + axis_[1] * width,
                                       g_rows_.data() + 2 * width};
  take_slopes(g, moving);
  for (std::size_t j = 0; by_parameters && j < carried_; ++j) {
    const std::size_t k = 1 + moving + j;
    stress_dp_[j] = 2 * (c_[0] * g[0][k] - c_[2] * g[2][k]);
    lateral_dp_[j] = c_[1] * g[1][k] - c_[2] * g[2][k];
  }
  return true;
}

/// The same from the consistent tangent: ∂g_a = ½ dS_aa = ¼ Σ_b A_ab ∂c_b.
bool StripPoint::on_tensors(double time_step) {
  std::array<double, 6> C{}, S{};
  std::array<double, 36> A{};
  for (std::size_t a = 0; a < 3; ++a) C[axis_[a]] = c_[a];
  now_.resize(history_);
  const bool timed = timed_ && history_ > 0;
  const Status status = model_.evaluate({1,
                                         C,
                                         parameters_,
                                         {&time_step, timed ? std::size_t{1} : 0},
                                         std::span<const double>(past_).first(first_ ? 0 : history_)},
                                        {{}, S, A, {}, now_});
  if (!status.ok()) {
    failure_ = status.reason();
    return false;
  }
  const std::array<std::array<double, moving>, 3> by{{{2 * c_[0], 0}, {0, c_[1]}, {-2 * c_[2], -c_[2]}}};
  std::array<std::array<double, 1 + moving>, 3> g{};
  for (std::size_t a = 0; a < 3; ++a) {
    g[a][0] = S[axis_[a]] / 2;
    for (std::size_t k = 0; k < moving; ++k)
      for (std::size_t b = 0; b < 3; ++b) g[a][1 + k] += A[6 * axis_[a] + axis_[b]] * by[b][k] / 4;
  }
  take_slopes({g[0].data(), g[1].data(), g[2].data()}, moving);
  return true;
}

void StripPoint::take_slopes(const std::array<const double*, 3>& g, std::size_t directions) {
  std::array<double, 1 + moving> stress{}, lateral{};
  const std::array<std::array<double, moving>, 3> by{{{2 * c_[0], 0}, {0, c_[1]}, {-2 * c_[2], -c_[2]}}};
  for (std::size_t k = 0; k <= directions; ++k) {
    const double d1 = k == 0 ? 0 : by[0][k - 1], d2 = k == 0 ? 0 : by[1][k - 1], d3 = k == 0 ? 0 : by[2][k - 1];
    stress[k] = 2 * (c_[0] * g[0][k] + d1 * g[0][0] - c_[2] * g[2][k] - d3 * g[2][0]);
    lateral[k] = c_[1] * g[1][k] + d2 * g[1][0] - c_[2] * g[2][k] - d3 * g[2][0];
    if (k == 0) {
      stress[0] = 2 * (c_[0] * g[0][0] - c_[2] * g[2][0]);
      lateral[0] = c_[1] * g[1][0] - c_[2] * g[2][0];
    }
  }
  stress_ = {stress[0], stress[1], stress[2]};
  lateral_ = {lateral[0], lateral[1], lateral[2]};
}

void StripPoint::accept(std::span<const double> l_dp, std::span<const double> y_dp) {
  first_ = false;
  if (!followed_) {
    past_.assign(now_.begin(), now_.end());
    return;
  }
  // The state moves with l and y, which the parameters move: afterwards its derivatives are total ones.
  for (std::size_t s = 0; s < history_; ++s) {
    const double* const row = now_.data() + s * now_width_;
    double* const to = past_.data() + s * full_;
    to[0] = row[0];
    to[1] = to[2] = 0;
    for (std::size_t j = 0; 1 + moving + j < now_width_; ++j) {
      const double moved = l_dp.empty() ? 0 : row[1] * l_dp[j] + row[2] * y_dp[j];
      to[1 + moving + j] = row[1 + moving + j] + moved;
    }
  }
}

}  // namespace tunica::controlled_strip
