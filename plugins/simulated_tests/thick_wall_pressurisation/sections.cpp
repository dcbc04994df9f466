// SPDX-License-Identifier: Apache-2.0
#include "sections.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "tunica/detail/vector_level.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::thick_wall {
namespace {

constexpr double smallest_piece = 1e-7;  ///< in ln R; what a kink closer to an edge does is below its square

/// Squared circumferential stretches at which a switch acts under c_z: tt c² + (zz c_z + offset) c + rr/c_z = 0.
void roots(const Switch& at, double cz, std::vector<double>& c) {
  const double q = at.zz * cz + at.offset, r = at.rr / cz;
  const double discriminant = q * q - 4 * at.tt * r;
  if (discriminant < 0) return;
  const double t = -0.5 * (q + std::copysign(std::sqrt(discriminant), q));
  for (const double root : {t / at.tt, r / t})
    if (std::isfinite(root) && root > 0) c.push_back(root);
}

void grow(std::vector<double>& v, std::size_t n) {
  if (v.size() < n) v.resize(n);
}

}  // namespace

std::span<const Rule> rules() {
  static const std::vector<Rule> all = [] {
    std::vector<Rule> made;
    for (const int points : {6, 8, 10, 12, 16, 20, 26, 34, 44, 60, 80, 110, 150}) made.emplace_back(points);
    return made;
  }();
  return all;
}

void Sections::Points::resize(std::size_t n) {
  for (auto* v : {&weight, &R2, &inverse}) v->resize(n);
}
void Sections::Points::set(std::size_t k, double weight_at, double x) {
  weight[k] = weight_at;
  R2[k] = std::exp(2 * x);
  inverse[k] = 1 / R2[k];
}

void Sections::begin(const Layers& layers, const Wall& wall, const Rule& rule, bool whole) {
  layers_ = &layers;
  wall_ = &wall;
  sector2_ = std::exp(2 * wall.iota);
  wall.edges(edges_);
  if (whole) edges_.erase(edges_.begin() + 1, edges_.end() - 1);
  inside_.resize(layers.size());
  can_be_cut_ = false;
  for (std::size_t m = 0; m < layers.size(); ++m) {
    can_be_cut_ |= !layers.of(m).switches().empty();
    const bool throughout = layers.size() == 1;
    const double from = edges_[throughout ? 0 : m].a, to = edges_[throughout ? walls() : m + 1].a;
    inside_[m] = {std::exp(2 * (from + smallest_piece)), std::exp(2 * (to - smallest_piece))};
  }
  take(rule);
}

void Sections::take(const Rule& rule) {
  rule_ = &rule;
  const std::size_t nodes = rule.node.size();
  base_.resize(walls() * nodes);
  for (std::size_t layer = 0; layer < walls(); ++layer) {
    const double from = edges_[layer].a, length = edges_[layer + 1].a - from, factor = wall_->factor(layer);
    for (std::size_t k = 0; k < nodes; ++k)
      base_.set(layer * nodes + k, rule.weight[k] * length * factor, from + rule.node[k] * length);
  }
}

/// Whether a kink may cut some section, over lanes. It does where f(c) = tt c + q + rr/(c_z c) changes its sign through
/// the wall; or at both roots, if the extremum at c² = rr/(c_z tt) is between.
bool Sections::may_be_cut() const {
  double found = 0;
  const double inside = 1 / std::exp(2 * edges_.front().a), outside = 1 / std::exp(2 * edges_.back().a);
  for (std::size_t m = 0; m < layers_->size(); ++m)
    for (const Switch& change : layers_->of(m).switches())
      detail::vectorised([this, &found, change, inside, outside, count = count_, a_of = numbers(a), b_of = numbers(b),
                          z_of = numbers(cz)] {
        double hits = 0;
        for (std::size_t i = 0; i < count; ++i) {
          const double q = change.zz * z_of[i] + change.offset, r = change.rr / z_of[i];
          const double ci = b_of[i] + a_of[i] * inside, co = b_of[i] + a_of[i] * outside;
          const double fi = (change.tt * ci + q) * ci + r, fo = (change.tt * co + q) * co + r;
          const double between = (r - change.tt * ci * ci) * (r - change.tt * co * co);
          const bool hit = (fi * fo <= 0) | ((between < 0) & (q * q >= 4 * change.tt * r));
          hits += hit ? 1 : 0;
        }
        found += hits;
      });
  return found > 0;
}

bool Sections::smooth(double lambda_z, double from, double to) {
  if (!can_be_cut_) return true;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  kinks_.clear();
  for (const double y : {from, to}) {  // c rises with y, and between its ends through the wall it rises or falls
    const Shape<double> at = shape(*wall_, y, lambda_z);
    for (const Jet& edge : {edges_.front(), edges_.back()}) {
      const double c = at.b + at.a * std::exp(-2 * edge.a);
      low = std::min(low, c);
      high = std::max(high, c);
    }
  }
  for (std::size_t m = 0; m < layers_->size(); ++m)
    for (const Switch& change : layers_->of(m).switches()) roots(change, lambda_z * lambda_z, kinks_);
  return std::ranges::none_of(kinks_, [low, high](double c) { return c >= low && c <= high; });
}

/// ln R at which kinks cut each layer of section i, from inside.
void Sections::find_cuts(std::size_t i) {
  const double a_i = numbers(a)[i], b_i = numbers(b)[i], cz_i = numbers(cz)[i];
  for (std::size_t layer = 0; layer < walls(); ++layer) {
    std::vector<double>& cuts = cuts_[i * walls() + layer];
    const auto& [inside, outside] = inside_[layers_->size() == 1 ? 0 : layer];
    cuts.clear();
    kinks_.clear();
    if (a_i == 0) continue;
    for (const Switch& change : layers_->of(layer).switches()) roots(change, cz_i, kinks_);
    for (const double c : kinks_) {  // c = b + a/R²
      const double s = a_i / (c - b_i);
      if (s > inside && s < outside) cuts.push_back(0.5 * std::log(s));
    }
    std::sort(cuts.begin(), cuts.end());
    double before = edges_[layer].a;
    const double end = edges_[layer + 1].a - smallest_piece;
    std::erase_if(cuts, [&before, end](double x) {
      if (!(x > before + smallest_piece && x < end)) return true;
      before = x;
      return false;
    });
  }
}

void Sections::lay_points() {
  cut_ = can_be_cut_ && may_be_cut();
  if (cut_) {
    if (cuts_.size() < walls() * count_) cuts_.resize(walls() * count_);
    for (std::size_t i = 0; i < count_; ++i) find_cuts(i);
  }
  slot_layer_.clear();
  for (std::size_t layer = 0; layer < walls(); ++layer) {
    std::size_t most = 0;
    for (std::size_t i = 0; cut_ && i < count_; ++i) most = std::max(most, cuts_[i * walls() + layer].size());
    slot_layer_.insert(slot_layer_.end(), most + 1, layer);
  }
  cut_ = slots() > walls();
  n_ = slots() * rule_->node.size() * count_;
  if (cut_) lay_cut_points();
}

void Sections::lay_cut_points() {
  if (points_.weight.size() < n_) points_.resize(n_);
  begins_.resize(slots() * count_);
  ends_.resize(slots() * count_);
  for (std::size_t slot = 0, first = 0; slot < slots(); ++slot) {
    const std::size_t layer = slot_layer_[slot];
    if (layer != slot_layer_[first]) first = slot;
    const std::size_t piece = slot - first;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::vector<double>& cuts = cuts_[i * walls() + layer];
      const auto edge = [&](std::size_t k) {
        return k == 0 ? edges_[layer].a : k <= cuts.size() ? cuts[k - 1] : edges_[layer + 1].a;
      };
      const double from = edge(piece), length = edge(piece + 1) - from, scale = length * wall_->factor(layer);
      begins_[slot * count_ + i] = piece == 0 ? 1 : 0;
      ends_[slot * count_ + i] = piece == cuts.size() ? 1 : 0;
      for (std::size_t k = 0; k < rule_->node.size(); ++k)
        points_.set((slot * rule_->node.size() + k) * count_ + i, rule_->weight[k] * scale,
                    from + rule_->node[k] * length);
    }
  }
}

void Sections::set_shapes(std::span<const Section> sections) {
  detail::vectorised([this, given = sections.data(), sector2 = sector2_, K = wall_->K, n = count_] {
    double* const lz = numbers(axial_stretch);
    double* const ri2 = numbers(inner2);
    double* const a_of = numbers(a);
    double* const b_of = numbers(b);
    double* const z_of = numbers(cz);
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      lz[i] = given[i].axial_stretch;
      ri2[i] = detail::lane_exp(2 * given[i].y);
      b_of[i] = K / lz[i];
      a_of[i] = K * K * ri2[i] - b_of[i] * sector2;
      z_of[i] = lz[i] * lz[i];
    }
  });
}

void Sections::set_stretches() {
  over_points([n = n_, count = count_, a_of = numbers(a), b_of = numbers(b), z_of = numbers(cz), c = c_.data()](
                  auto, auto, auto inverse) TUNICA_INLINE {
    if (count == 1) {
      const double a_1 = *a_of, b_1 = *b_of, z_1 = *z_of;
      TUNICA_LANES
      for (std::size_t m = 0; m < n; ++m) {
        c[m] = b_1 + a_1 * inverse.all[m];
        c[n + m] = z_1;
        c[2 * n + m] = 1 / (c[m] * z_1);
      }
      return;
    }
    for (std::size_t m = 0; m * count < n; ++m) {
      double* const ct = c + m * count;
      const auto per_R2 = inverse(m);
      TUNICA_LANES
      for (std::size_t i = 0; i < count; ++i) {
        ct[i] = b_of[i] + a_of[i] * per_R2[i];
        ct[n + i] = z_of[i];
        ct[2 * n + i] = 1 / (ct[i] * z_of[i]);
      }
    }
  });
}

Status Sections::evaluate(std::span<const Section> sections, const Wants& wants, const Memory& memory,
                          const RestStress* rest) {
  count_ = sections.size();
  rest_ = rest;
  grow(numbers_, number_count * count_);
  set_shapes(sections);
  lay_points();
  if (h_.size() < n_) {
    c_.resize(3 * n_);
    gradient_.resize(3 * n_);
    hessian_.resize(6 * n_);
    for (auto* v : {&h_, &h_c_, &q_, &q_c_}) v->resize(n_);
  }
  set_stretches();
  if (Status status = respond(wants.parameters, memory); !status.ok()) return status;
  if (wants.force)
    integrate<true, true>();
  else if (wants.geometry)
    integrate<true, false>();
  else
    integrate<false, false>();
  return {};
}

Status Sections::respond(bool parameters, const Memory& memory) {
  runs_.clear();
  const std::size_t points = rule_->node.size() * count_;
  for (std::size_t slot = 0; layers_->size() > 1 && slot < slots(); ++slot)
    runs_.push_back({slot_layer_[slot], slot * points, points});
  const std::size_t of_parameters = parameters ? 3 * n_ * layers_->parameter_count() : 0;
  grow(gradient_dp_, of_parameters);
  return layers_->evaluate(n_, runs_, {c_.data(), 3 * n_}, {gradient_.data(), 3 * n_}, {hessian_.data(), 6 * n_},
                           {gradient_dp_.data(), of_parameters}, memory);
}

/// I = ∫ T/c dx and J = ∫ (2Z − T) R² dx, with their derivatives by a and b of c = b + a/R² and by c_z: sums of h = T/c
/// and q = 2Z − T, and of their derivatives by c at fixed c_z and by c_z at fixed c, where c_r = 1/(c c_z).
template <bool geometry, bool force>
void Sections::integrate() {
  constexpr std::size_t sums = force ? 8 : geometry ? 4 : 2;
  std::fill_n(numbers(I), 8 * count_, 0.0);
  if (count_ == 1) grow(terms_, sums * n_);
  over_points([this, n = n_, count = count_, nodes = rule_->node.size()](auto weight, auto R2,
                                                                         auto inverse) TUNICA_INLINE {
    double* const sum = numbers(I);
    /// Calls add(number, term) for point k, of weight w and R² = s.
    const auto terms = [this, n](std::size_t k, double w, double s, double per_s, double at_rest,
                                 const auto& add) TUNICA_INLINE {
      const double* const c_of = c_.data();
      const double* const g = gradient_.data();
      const double* const H = hessian_.data();
      const double c = c_of[k], z = c_of[n + k], cr = c_of[2 * n + k], gt = g[k], gr = g[2 * n + k], Htt = H[k],
                   Hrr = H[2 * n + k], Htr = H[5 * n + k];
      const double per_c = z * cr, by_c = cr * per_c;  // −∂c_r/∂c
      const double normal = cr * gr;
      const double normal_c = by_c * (cr * Hrr + gr) - cr * Htr;  // −∂(c_r g_r)/∂c
      const double T = 2 * (c * gt - normal) - at_rest;
      const double T_c = 2 * (gt + c * (Htt - by_c * Htr) + normal_c);
      const double h = T * per_c, h_c = (T_c - h) * per_c, wh_c = w * h_c;
      h_[k] = h;
      h_c_[k] = h_c;
      add(0, w * h);
      add(1, wh_c * per_s);
      if constexpr (geometry) {
        const double by_z = cr * (c * cr), Htz = H[3 * n + k], Hzr = H[4 * n + k];  // −∂c_r/∂c_z
        const double normal_z = by_z * (cr * Hrr + gr) - cr * Hzr;
        const double T_z = 2 * (c * (Htz - by_z * Htr) + normal_z);
        add(2, wh_c);
        add(3, w * T_z * per_c);
        if constexpr (force) {
          const double gz = g[n + k], Hzz = H[n + k], ws = w * s;
          const double q = 4 * (z * gz - normal) - T, q_c = 4 * (z * (Htz - by_c * Hzr) + normal_c) - T_c;
          const double q_z = 4 * (gz + z * (Hzz - by_z * Hzr) + normal_z) - T_z;
          q_[k] = q;
          q_c_[k] = q_c;
          add(4, ws * q);
          add(5, w * q_c);
          add(6, ws * q_c);
          add(7, ws * q_z);
        }
      }
    };
    for (std::size_t slot = 0; slot < slots(); ++slot) {
      const double at_rest = rest_ == nullptr ? 0 : rest_->value[layers_->size() == 1 ? 0 : slot_layer_[slot]];
      if (count == 1) {  // lanes over points
        double* const to = terms_.data();
        TUNICA_LANES
        for (std::size_t m = slot * nodes; m < (slot + 1) * nodes; ++m)
          terms(m, weight.all[m], R2.all[m], inverse.all[m], at_rest,
                [to, n, m](std::size_t number, double term) TUNICA_INLINE { to[number * n + m] = term; });
        continue;
      }
      for (std::size_t m = slot * nodes; m < (slot + 1) * nodes; ++m) {
        const auto w = weight(m), s = R2(m), per_s = inverse(m);
        TUNICA_LANES
        for (std::size_t i = 0; i < count; ++i)
          terms(m * count + i, w[i], s[i], per_s[i], at_rest,
                [sum, count, i](std::size_t number, double term) TUNICA_INLINE { sum[number * count + i] += term; });
      }
    }
    for (std::size_t k = 0; count == 1 && k < sums; ++k)
      for (std::size_t m = 0; m < n; ++m) sum[k] += terms_[k * n + m];
  });
}

WallForces Sections::forces(std::size_t i) const {
  const double K2 = wall_->K * wall_->K, lz = numbers(axial_stretch)[i];
  const double b_i = numbers(b)[i], a_y = 2 * K2 * numbers(inner2)[i], a_axial = b_i * sector2_ / lz;
  const double force = std::numbers::pi * b_i / K2, I_i = numbers(I)[i], I_a_i = numbers(I_a)[i];
  return {b_i * I_i, b_i * I_a_i * a_y,
          b_i * (I_a_i * a_axial - numbers(I_b)[i] * b_i / lz + 2 * lz * numbers(I_z)[i] - I_i / lz),
          force * numbers(J)[i], force * numbers(J_a)[i] * a_y};
}

std::span<const double> Sections::pressure_errors() {
  std::fill_n(numbers(error), count_, 0.0);
  const std::size_t nodes = rule_->node.size();
  for (std::size_t slot = 0; slot < slots(); ++slot) {
    std::fill_n(numbers(mean), 3 * count_, 0.0);
    over_points([this, slot, nodes, count = count_](auto weight, auto, auto) TUNICA_INLINE {
      double* const sum = numbers(mean);
      for (std::size_t k = 0; k < nodes; ++k) {
        const double w = rule_->weight[k], a_last = rule_->last[k], a_but_one = rule_->last_but_one[k];
        const double* const h = h_.data() + (slot * nodes + k) * count;
        TUNICA_LANES
        for (std::size_t i = 0; i < count; ++i) {
          sum[i] += w * std::abs(h[i]);
          sum[count + i] += a_last * h[i];
          sum[2 * count + i] += a_but_one * h[i];
        }
      }
      double* const to = numbers(error);
      const double* const b_of = numbers(b);
      const double per_weight = 1 / rule_->weight[0];
      const auto first_weight = weight(slot * nodes);
      TUNICA_LANES
      for (std::size_t i = 0; i < count; ++i) {
        const double one = std::abs(sum[count + i]), other = std::abs(sum[2 * count + i]);
        const double behind = coefficient_behind(one > other ? one : other, sum[i]);
        to[i] += b_of[i] * per_weight * first_weight[i] * behind;
      }
    });
  }
  return {numbers(error), count_};
}

std::vector<Sections::Across> Sections::across(std::size_t i) const {
  std::vector<Across> all;
  const std::size_t nodes = rule_->node.size();
  for (std::size_t m = 0; m < slots() * nodes; ++m) {
    const std::size_t k = m * count_ + i;
    const double weight = cut_ ? points_.weight[k] : base_.weight[m], factor = wall_->factor(slot_layer_[m / nodes]);
    if (weight == 0) continue;  // a piece that this section does not have
    const double T = c_[k] * h_[k];
    all.push_back({cut_ ? points_.R2[k] : base_.R2[m], c_[k], factor * T, factor * 0.5 * (q_[k] + T),
                   numbers(b)[i] * weight * h_[k]});
  }
  return all;
}

}  // namespace tunica::thick_wall
