// SPDX-License-Identifier: Apache-2.0
// Between the blocks of a path: what they begin with, what they leave, and the model at their rows.
#include "maxwell_block.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
using namespace maxwell;

MaxwellPath::MaxwellPath(const Strip& strip, const TestInput& input, std::span<const double> stretch,
                         std::span<const MaxwellModel::Branch> branches, std::span<double> y, const PathRows& rows)
    : strip_(strip),
      input_(input),
      stretch_(stretch),
      branches_(branches),
      y_(y),
      rows_(rows),
      n_(stretch.size()),
      count_(input.model_parameters.size()),
      elastic_count_(input.model.elastic().describe().parameters.size()) {
  for (std::size_t b = 0; b < branches.size(); ++b) {
    Branch& branch = thread_block().branches[b];
    branch.g = input.model_parameters[branches[b].g];
    branch.h_before = branch.t_before = {};
  }
}

/// g' = g − w/c with w = ⅓ Σ g c, before the first row, where c = 1.
Status MaxwellPath::evaluate_rest(bool parameters) {
  BlockScratch& s = thread_block();
  const std::size_t padded = count_ + detail::widest;
  if (parameters) {
    make_room(s.gradient_dp, 3 * block * elastic_count_);
    make_room(s.dev_dp_before, 3 * padded);
    make_room(s.memory_dp, 3 * padded * branches_.size());
    std::fill(s.dev_dp_before.begin(), s.dev_dp_before.end(), 0.0);
    std::fill(s.memory_dp.begin(), s.memory_dp.end(), 0.0);
  }
  s.c[0] = s.c[1] = s.c[2] = 1;
  const Status status = input_.model.elastic().evaluate_axes(
      {1, {s.c.data(), 3}, input_.model_parameters.first(elastic_count_)},
      {{}, {s.gradient.data(), 3}, {}, {s.gradient_dp.data(), parameters ? 3 * elastic_count_ : 0}});
  if (!status.ok()) return status;
  const std::array<std::size_t, 3> axis{strip_.loaded, strip_.transverse, 2};
  const auto deviator = [&axis](const double* g, std::size_t a) { return g[axis[a]] - (g[0] + g[1] + g[2]) / 3; };
  for (std::size_t a = 0; a < 3; ++a) {
    s.dev_before[a] = deviator(s.gradient.data(), a);
    for (std::size_t j = 0; parameters && j < elastic_count_; ++j)
      s.dev_dp_before[a * padded + j] = deviator(s.gradient_dp.data() + 3 * j, a);
  }
  return {};
}

Status MaxwellPath::evaluate(bool parameters) {
  BlockScratch& s = thread_block();
  detail::vectorised([&s, n = size_, stretch = stretch_.data() + first_, y = y_.data() + first_,
                      c1 = s.c.data() + strip_.loaded * size_, c2 = s.c.data() + strip_.transverse * size_,
                      c3 = s.c.data() + 2 * size_] {
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      c1[i] = stretch[i] * stretch[i];
      c2[i] = detail::lane_exp(y[i]);
      c3[i] = 1 / (c1[i] * c2[i]);
    }
  });
  return input_.model.elastic().evaluate_axes(
      {size_, {s.c.data(), 3 * size_}, input_.model_parameters.first(elastic_count_)},
      {{},
       {s.gradient.data(), 3 * size_},
       {s.hessian.data(), 6 * size_},
       {s.gradient_dp.data(), parameters ? 3 * size_ * elastic_count_ : 0}});
}

/// Where the blocks before point to.
void MaxwellPath::enter() {
  BlockScratch& s = thread_block();
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    Branch& branch = s.branches[b];
    branch.relaxation.set(strip_.time, first_, size_, input_.model_parameters[branches_[b].tau]);
  }
  std::copy_n(y_.data() + first_, size_, s.start.data());
  s.before.fill(0);
  if (first_ == 0) return;
  const std::array<double, 4> by = differences(s.seen, order_);
  detail::vectorised([by, n = size_, y = y_.data() + first_] {
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) y[i] += continued(by, static_cast<double>(static_cast<int>(i) + 1) / distance);
  });
}

void MaxwellPath::leave() {
  BlockScratch& s = thread_block();
  detail::vectorised(
      [&s, n = size_, y = y_.data() + first_, u = rows_.u.data() + first_, stress = rows_.stress.data() + first_] {
        TUNICA_LANES
        for (std::size_t i = 0; i < n; ++i) {
          y[i] += s.step[i];
          u[i] = detail::lane_exp(y[i]);
          stress[i] = s.stress[i];
        }
      });
  s.dev_before = s.dev_after;
  for (Branch& branch : s.branches) {
    branch.h_before = branch.h_after;
    branch.t_before = branch.t_after;
  }
  if (size_ < block) return;
  const auto shift = [&](std::size_t row) { return y_[first_ + row] - s.start[row]; };
  if (first_ > 0) choose_order(shift(block / 2 - 1), shift(block - 1));
  for (std::size_t k = 0; k < s.seen.size(); ++k) s.seen[k] = shift(block - 1 - k * distance);
}

/// The one that would have pointed closest to this block.
void MaxwellPath::choose_order(double half_way, double at_end) {
  const auto& seen = thread_block().seen;
  const auto error = [&](std::size_t order) {
    const std::array<double, 4> by = differences(seen, order);
    return std::max(std::abs(continued(by, 2) - half_way), std::abs(continued(by, 4) - at_end));
  };
  order_ = 0;
  for (std::size_t order = 1; order < seen.size(); ++order)
    if (error(order) < error(order_)) order_ = order;
}

}  // namespace tunica::uniaxial
