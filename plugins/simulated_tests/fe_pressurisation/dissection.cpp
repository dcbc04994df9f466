// SPDX-License-Identifier: Apache-2.0
#include "dissection.hpp"

#include <algorithm>
#include <limits>

namespace tunica::fe {
namespace {

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

constexpr double per_entry = 100;  ///< operations that memory costs which is touched for the first time

std::size_t filled(std::size_t rows) { return (rows + panel - 1) / panel * panel; }

/// Σ (h − j)²/2 over the columns eliminated.
double operations_of(std::size_t own, std::size_t height) {
  double sum = 0;
  for (std::size_t j = 0; j < own; ++j) sum += 0.5 * static_cast<double>((height - j) * (height - j));
  return sum;
}

}  // namespace

/// Smaller parts would cost more time for their surroundings than for themselves.
bool Dissection::small(const Mesh& mesh, const Part& part) {
  const std::size_t side = 4 / mesh.order;
  return (part.right - part.left) * (part.high - part.low) <= side * side;
}

/// Across the longer side.
std::array<Dissection::Part, 2> Dissection::halves(const Part& part) {
  std::array<Part, 2> two{part, part};
  if (part.right - part.left >= part.high - part.low) {  // NOLINT(bugprone-branch-clone): they differ
    two[0].right = two[1].left = (part.left + part.right) / 2;
    two[0].cut_right = two[1].cut_left = true;
  } else {
    two[0].high = two[1].low = (part.low + part.high) / 2;
    two[0].cut_high = two[1].cut_low = true;
  }
  return two;
}

Dissection::Nodes Dissection::nodes_of(const Mesh& mesh, const Part& part) {
  const std::size_t n = mesh.order;
  Nodes found;
  const auto& [halved, other] = halves(part);
  const bool whole = small(mesh, part);
  for (std::size_t k = part.low * n; k <= part.high * n; ++k)
    for (std::size_t i = part.left * n; i <= part.right * n; ++i) {
      const bool cut = (part.cut_left && i == part.left * n) || (part.cut_right && i == part.right * n) ||
                       (part.cut_low && k == part.low * n) || (part.cut_high && k == part.high * n);
      const bool on_line = halved.right < part.right ? i == other.left * n : k == other.low * n;
      if (cut)
        found.around.push_back(mesh.node(i, k));
      else if (whole || on_line)
        found.own.push_back(mesh.node(i, k));
    }
  return found;
}

/// `left`: doubles that wait on the stack when the part is done.
FactorCost Dissection::cost(const Mesh& mesh, const Part& part, double& left) {
  const std::size_t n = mesh.order, across = n * (part.right - part.left) + 1, along = n * (part.high - part.low) + 1;
  const std::size_t free_across = across - part.cut_left - part.cut_right,
                    free_along = along - part.cut_low - part.cut_high;
  FactorCost sum;
  std::size_t own = free_across * free_along;
  double waiting = 0;
  if (!small(mesh, part)) {
    own = across >= along ? free_along : free_across;
    for (const Part& half : halves(part)) {
      double left_by_half = 0;
      const FactorCost of = cost(mesh, half, left_by_half);
      sum.operations += of.operations;
      sum.kept += of.kept;
      sum.working = std::max(sum.working, waiting + of.working);
      waiting += left_by_half;
    }
  }
  const std::size_t around = across * along - free_across * free_along, height = filled(2 * own) + filled(2 * around);
  left = static_cast<double>(filled(2 * around) * filled(2 * around));
  sum.operations += operations_of(filled(2 * own), height);
  sum.kept += static_cast<double>(filled(2 * own) * height);
  sum.working = std::max(sum.working, waiting + left);
  return sum;
}

FactorCost Dissection::cost(const Mesh& mesh) {
  double left = 0;
  return cost(mesh, {0, mesh.radial, 0, mesh.axial}, left);
}

/// The fronts of a part, the last of which takes what the others leave; and their nodes.
std::size_t Dissection::dissect(const Mesh& mesh, const Part& part, std::vector<Nodes>& nodes) {
  Front front;
  if (!small(mesh, part))
    for (const Part& half : halves(part)) front.children.push_back(dissect(mesh, half, nodes));
  nodes.push_back(nodes_of(mesh, part));
  fronts_.push_back(front);
  return fronts_.size() - 1;
}

bool Dissection::prepare(const Mesh& mesh, const Stencil& matrix, const std::function<bool()>& late) {
  size_ = 2 * mesh.nodes();
  fronts_.clear();
  positions_.clear();
  std::vector<Nodes> nodes;
  dissect(mesh, {0, mesh.radial, 0, mesh.axial}, nodes);
  std::vector<std::size_t> when(mesh.nodes());
  std::size_t time = 0;
  for (const Nodes& of : nodes)
    for (const std::size_t node : of.own) when[node] = time++;
  std::size_t kept = 0, panels = 0, top = 0, stack = 0, widest = 0;
  tallest_ = 0;
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    Front& front = fronts_[f];
    // Then rows follow each other in every front as they are eliminated, and what is below a diagonal stays below.
    std::ranges::sort(nodes[f].around, {}, [&](std::size_t node) { return when[node]; });
    front.eliminated = 2 * nodes[f].own.size();
    front.around = 2 * nodes[f].around.size();
    front.own = filled(front.eliminated);
    front.height = front.own + filled(front.around);
    front.positions = positions_.size();
    for (const auto* some : {&nodes[f].own, &nodes[f].around})
      for (const std::size_t node : *some)
        for (std::size_t d = 0; d < 2; ++d) positions_.push_back(static_cast<std::uint32_t>(2 * node + d));
    front.place = kept;
    front.first_panel = panels;
    kept += front.own * front.height;
    panels += front.own / panel;
    tallest_ = std::max(tallest_, front.height);
    widest = std::max(widest, front.own);
    // What it leaves is made above what its children left, and takes their place.
    const std::size_t left = front.left() * front.left();
    front.made = top;
    stack = std::max(stack, top + left);
    front.waits = front.children.empty() ? top : fronts_[front.children.front()].waits;
    top = front.waits + left;
  }
  a_.resize(kept);
  stack_.resize(stack);
  scaled_.resize(widest * panel);
  inverse_.resize(panels * panel * panel);
  inverse_pivot_.resize(panels * panel);
  return locate(mesh, matrix, late);
}

/// The positions of the matrix entries, and the remainder of each front.
bool Dissection::locate(const Mesh& mesh, const Stencil& matrix, const std::function<bool()>& late) {
  entries_.clear();
  std::vector<std::size_t> row(size_, nowhere);
  const auto elements = [&](std::size_t i, std::size_t last) {  // that a line of nodes belongs to: first and last
    const std::size_t n = mesh.order;
    return std::array{i % n == 0 && i > 0 ? i / n - 1 : i / n, std::min(i / n, last - 1)};
  };
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    if (late && f % 1024 == 1023 && late()) return false;
    Front& front = fronts_[f];
    const std::span<const std::uint32_t> at(&positions_[front.positions], front.eliminated + front.around);
    for (std::size_t r = 0; r < at.size(); ++r)
      row[at[r]] = r < front.eliminated ? r : front.own + r - front.eliminated;
    front.first_entry = entries_.size();
    for (std::size_t c = 0; c < front.eliminated; ++c) {
      const std::size_t node = at[c] / 2, i = node % mesh.across(), k = node / mesh.across();
      const auto [left, right] = elements(i, mesh.radial);
      const auto [low, high] = elements(k, mesh.axial);
      for (std::size_t other_k = low * mesh.order; other_k <= (high + 1) * mesh.order; ++other_k)
        for (std::size_t other_i = left * mesh.order; other_i <= (right + 1) * mesh.order; ++other_i)
          for (std::size_t d = 0; d < 2; ++d) {
            const std::size_t other = 2 * mesh.node(other_i, other_k) + d, r = row[other];
            if (r == nowhere || r < c) continue;
            const std::size_t upper = std::min<std::size_t>(other, at[c]), lower = std::max<std::size_t>(other, at[c]);
            entries_.push_back({static_cast<std::uint32_t>(matrix.place(lower, upper)),
                                static_cast<std::uint32_t>(c * front.height + r)});
          }
    }
    front.last_entry = entries_.size();
    for (const std::size_t child : front.children) {
      Front& from = fronts_[child];
      from.runs.clear();
      for (std::size_t r = 0; r < from.around; ++r) {
        const auto to = static_cast<std::uint32_t>(row[positions_[from.positions + from.eliminated + r]]);
        if (r > 0 && to == from.runs.back().to + from.runs.back().length)
          ++from.runs.back().length;
        else
          from.runs.push_back({static_cast<std::uint32_t>(r), to, 1});
      }
    }
    for (const std::uint32_t position : at) row[position] = nowhere;
  }
  return true;
}

/// The matrix entries of a front.
void Dissection::load(const Front& front, const Stencil& matrix, double diagonal) {
  double* const a = a_.data() + front.place;
  std::fill_n(a, front.own * front.height, 0.0);
  const double* const values = matrix.column(0);
  for (std::size_t k = front.first_entry; k < front.last_entry; ++k) a[entries_[k].to] += values[entries_[k].from];
  for (std::size_t r = 0; r < front.eliminated + front.around; ++r) {
    if (fixed_[positions_[front.positions + r]] == 0) continue;
    const std::size_t row = r < front.eliminated ? r : front.own + r - front.eliminated;
    for (std::size_t c = 0; c < std::min(row, front.own); ++c) a[c * front.height + row] = 0;
    if (r >= front.eliminated) continue;
    std::fill_n(a + row * front.height + row, front.height - row, 0.0);
    a[row * front.height + row] = diagonal;
  }
}

/// Adds the remainder of a front to its parent.
void Dissection::extend(const Front& from, const Front& to, const double* left, double* a, double* to_left) {
  for (const Run& columns : from.runs)
    for (std::size_t c = 0; c < columns.length; ++c) {
      const std::size_t column = columns.to + c;
      const bool is_left = column >= to.own;  // then its rows are, too
      double* const into = is_left ? to_left + (column - to.own) * to.left() : a + column * to.height;
      const std::size_t first_row = is_left ? to.own : 0;
      const double* const out = left + (columns.from + c) * from.left();
      for (const Run* rows = &columns; rows < from.runs.data() + from.runs.size(); ++rows) {
        const std::size_t begin = rows == &columns ? c : 0;
        const double* __restrict__ const source = out + rows->from;
        double* __restrict__ const sum = into + (rows->to - first_row);
        for (std::size_t r = begin; r < rows->length; ++r) sum[r] += source[r];
      }
    }
}

/// As the band does it, panel by panel: each takes from those before at once. What is left is taken into `left`.
template <class Vector, std::size_t Vectors, std::size_t Columns>
std::optional<std::size_t> Dissection::eliminate(const Front& front, double* left, Questions& questions) {
  constexpr std::size_t rows = Vectors * lanes<Vector>;
  const std::size_t height = front.height, own = front.own / panel, all = height / panel;
  double* const a = a_.data() + front.place;
  double* const scaled = scaled_.data();
  std::size_t negative = 0;
  for (std::size_t J = 0; J < all; ++J) {
    const std::size_t before = std::min(J, own), first_row = J < own ? 0 : front.own;
    if (questions.late_after(static_cast<double>(panel * (height - J * panel) * (before + 1) * panel))) return {};
    for (std::size_t k = 0; k < before * panel; ++k)
      for (std::size_t q = 0; q < panel; ++q)
        scaled[k * panel + q] = a[k * (height + 1)] * a[k * height + J * panel + q];
    double* const to = J < own ? a + J * panel * height : left + (J - own) * panel * front.left();
    const std::size_t to_height = height - first_row;
    for (std::size_t I = J; I < (before == 0 ? 0 : all); ++I)
      for (std::size_t r = I * panel; r < (I + 1) * panel; r += rows)
        for (std::size_t q = 0; q < panel; q += Columns)
          subtract_products<Vector, Vectors, Columns>(to + q * to_height + (r - first_row), to_height, a + r, height,
                                                      panel * height, scaled + q, before);
    if (J < own)
      negative += factorise_panel<Vector>(to + J * panel, height, height - J * panel,
                                          std::min(panel, front.eliminated - J * panel),
                                          inverse_pivot_.data() + (front.first_panel + J) * panel,
                                          inverse_.data() + (front.first_panel + J) * panel * panel);
  }
  return negative;
}

std::optional<std::size_t> Dissection::factorise(const Stencil& matrix, std::span<const std::size_t> fixed,
                                                 double diagonal, const std::function<bool()>& late) {
  fixed_.assign(size_, 0);
  for (const std::size_t position : fixed) fixed_[position] = 1;
  std::size_t negative = 0;
  Questions questions{late};
  for (const Front& front : fronts_) {
    if (questions.late_after(per_entry * static_cast<double>(front.own * front.height))) return {};
    const std::size_t size = front.left() * front.left();
    double* const left = stack_.data() + front.made;
    std::fill_n(left, size, 0.0);
    load(front, matrix, diagonal);
    for (const std::size_t child : front.children)
      extend(fronts_[child], front, stack_.data() + fronts_[child].waits, a_.data() + front.place, left);
    std::optional<std::size_t> found;
    in_blocks([&](auto block) __attribute__((always_inline)) {
      using Kind = decltype(block);
      found = eliminate<typename Kind::Vector, Kind::vectors, Kind::columns>(front, left, questions);
    });
    if (!found) return {};
    negative += *found;
    if (front.made > front.waits) std::copy(left, left + size, stack_.data() + front.waits);
  }
  return negative;
}

template <class Vector>
void Dissection::substitute(std::span<const std::span<double>> x, double* rows) const {
  for (const Front& front : fronts_) {
    const std::uint32_t* const at = &positions_[front.positions];
    for (std::size_t k = 0; k < x.size(); ++k) {
      double* const y = rows + k * tallest_;
      std::fill_n(y, front.height, 0.0);
      for (std::size_t r = 0; r < front.eliminated; ++r) y[r] = x[k][at[r]];
    }
    for (std::size_t J = 0; J < front.own / panel; ++J)
      for (std::size_t k = 0; k < x.size(); ++k)
        substitute_forward<Vector>(a_.data() + front.place + J * panel * (front.height + 1), front.height,
                                   front.height - J * panel, inverse_.data() + (front.first_panel + J) * panel * panel,
                                   rows + k * tallest_ + J * panel);
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double* const y = rows + k * tallest_;
      for (std::size_t r = 0; r < front.eliminated; ++r) x[k][at[r]] = y[r];
      for (std::size_t r = 0; r < front.around; ++r) x[k][at[front.eliminated + r]] += y[front.own + r];
    }
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const std::uint32_t* const at = &positions_[front->positions];
    for (std::size_t k = 0; k < x.size(); ++k) {
      double* const y = rows + k * tallest_;
      std::fill_n(y, front->height, 0.0);
      for (std::size_t r = 0; r < front->eliminated; ++r) y[r] = x[k][at[r]];
      for (std::size_t r = 0; r < front->around; ++r) y[front->own + r] = x[k][at[front->eliminated + r]];
    }
    for (std::size_t J = front->own / panel; J-- > 0;)
      for (std::size_t k = 0; k < x.size(); ++k)
        substitute_backward<Vector>(
            a_.data() + front->place + J * panel * (front->height + 1), front->height, front->height - J * panel,
            inverse_.data() + (front->first_panel + J) * panel * panel,
            inverse_pivot_.data() + (front->first_panel + J) * panel, rows + k * tallest_ + J * panel);
    for (std::size_t k = 0; k < x.size(); ++k)
      for (std::size_t r = 0; r < front->eliminated; ++r) x[k][at[r]] = rows[k * tallest_ + r];
  }
}

void Dissection::solve(std::span<const std::span<double>> x) const {
  thread_local std::vector<double, Aligned<double>> rows;
  rows.resize(tallest_ * x.size());
  in_blocks([&](auto block)
                __attribute__((always_inline)) { substitute<typename decltype(block)::Vector>(x, rows.data()); });
}

}  // namespace tunica::fe
