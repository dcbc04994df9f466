// SPDX-License-Identifier: Apache-2.0
#include "sections.hpp"

#include <algorithm>
#include <numbers>

#include "tunica/detail/vector_level.hpp"

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

}  // namespace

std::span<const Rule> rules() {
  static const std::vector<Rule> all = [] {
    std::vector<Rule> made;
    for (const int points : {6, 8, 10, 12, 16, 20, 26, 34, 44, 60, 80, 110, 150}) made.emplace_back(points);
    return made;
  }();
  return all;
}

void Sections::begin(const Layers& layers, const Wall& wall, const Rule& rule) {
  layers_ = &layers;
  wall_ = &wall;
  rule_ = &rule;
  wall.edges(edges_);
  cuts_.resize(layers.size());
  inside_.resize(layers.size());
  can_be_cut_ = false;
  for (std::size_t m = 0; m < layers.size(); ++m) {
    cuts_[m].clear();
    can_be_cut_ |= !layers.of(m).switches().empty();
    const bool throughout = layers.size() == 1;
    const double from = edges_[throughout ? 0 : m].a, to = edges_[throughout ? wall.layer_count() : m + 1].a;
    inside_[m] = {std::exp(2 * (from + smallest_piece)), std::exp(2 * (to - smallest_piece))};
  }
  clear_points();
  for (std::size_t layer = 0; layer < wall.layer_count(); ++layer)
    add_piece(edges_[layer].a, edges_[layer + 1].a, layer, true, true);
  base_weight_ = w_;
  base_s_ = s_;
  base_inverse_ = inverse_;
  clear_points();
}

void Sections::clear_points() {
  w_.clear();
  s_.clear();
  inverse_.clear();
  pieces_.clear();
  first_piece_.assign(1, 0);
  first_point_.assign(1, 0);
  uncut_ = 0;
}

void Sections::add_piece(double from, double to, std::size_t layer, bool begins, bool ends) {
  pieces_.push_back({w_.size(), to - from, layer, begins, ends});
  for (std::size_t k = 0; k < rule_->node.size(); ++k) {
    const double s = std::exp(2 * (from + rule_->node[k] * (to - from)));
    w_.push_back(rule_->weight[k] * (to - from) * wall_->factor(layer));
    s_.push_back(s);
    inverse_.push_back(1 / s);
  }
}

bool Sections::find_cuts(const Shape<double>& at) {
  bool cut = false;
  for (std::size_t m = 0; m < layers_->size(); ++m) {
    const std::span<const Switch> switches = layers_->of(m).switches();
    if (switches.empty()) continue;
    // R of a kink from c = b + a/R²
    std::vector<double>& cuts = cuts_[m];
    kinks_.clear();
    cuts.clear();
    if (at.a != 0)
      for (const Switch& change : switches) roots(change, at.cz, kinks_);
    for (const double c : kinks_) {
      const double s = at.a / (c - at.b);
      if (s > inside_[m][0] && s < inside_[m][1]) cuts.push_back(0.5 * std::log(s));
    }
    std::sort(cuts.begin(), cuts.end());
    cut |= !cuts.empty();
  }
  return cut;
}

/// Points of so many sections, where nothing cuts the layers of any. They depend on nothing but the wall, so those that
/// are there already stay.
void Sections::lay_uncut(std::size_t count) {
  for (; uncut_ < count; ++uncut_) {
    for (std::size_t layer = 0; layer < wall_->layer_count(); ++layer)
      pieces_.push_back(
          {w_.size() + layer * rule_->node.size(), edges_[layer + 1].a - edges_[layer].a, layer, true, true});
    w_.insert(w_.end(), base_weight_.begin(), base_weight_.end());
    s_.insert(s_.end(), base_s_.begin(), base_s_.end());
    inverse_.insert(inverse_.end(), base_inverse_.begin(), base_inverse_.end());
    first_piece_.push_back(pieces_.size());
    first_point_.push_back(w_.size());
  }
}

/// Points of one section behind those of the sections before it.
void Sections::lay_points(const Shape<double>& at) {
  find_cuts(at);
  for (std::size_t layer = 0; layer < wall_->layer_count(); ++layer) {
    double from = edges_[layer].a;
    bool begins = true;
    for (const double x : cuts_[layers_->size() == 1 ? 0 : layer]) {
      if (!(x > from + smallest_piece && x < edges_[layer + 1].a - smallest_piece)) continue;
      add_piece(from, x, layer, begins, false);
      from = x;
      begins = false;
    }
    add_piece(from, edges_[layer + 1].a, layer, begins, true);
  }
  first_piece_.push_back(pieces_.size());
  first_point_.push_back(w_.size());
}

Status Sections::evaluate(std::span<const Section> sections, bool parameters, const Memory& memory,
                          const RestStress* rest) {
  sections_.assign(sections.begin(), sections.end());
  shapes_.clear();
  for (const Section& section : sections) shapes_.push_back(shape(*wall_, section.y, section.axial_stretch));
  if (can_be_cut_ &&
      std::any_of(shapes_.begin(), shapes_.end(), [this](const Shape<double>& at) { return find_cuts(at); })) {
    clear_points();
    for (const Shape<double>& at : shapes_) lay_points(at);
  } else {
    if (uncut_ == 0) clear_points();
    lay_uncut(sections.size());
  }
  n_ = first_point_[sections.size()];
  if (h_.size() < n_) {
    c_.resize(3 * n_);
    gradient_.resize(3 * n_);
    hessian_.resize(6 * n_);
    for (auto* v : {&h_, &h_c_, &h_z_, &q_, &q_c_, &q_z_}) v->resize(n_);
  }
  detail::vectorised([this] {
    double* const ct = c_.data();
    double* const cz = ct + n_;
    double* const cr = cz + n_;
    const double* const inverse = inverse_.data();
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      const double a = shapes_[i].a, b = shapes_[i].b, z = shapes_[i].cz;
      const std::size_t end = first_point_[i + 1];
      TUNICA_LANES
      for (std::size_t k = first_point_[i]; k < end; ++k) {
        ct[k] = b + a * inverse[k];
        cz[k] = z;
        cr[k] = 1 / (ct[k] * z);
      }
    }
  });
  rest_ = rest;
  if (Status status = respond(parameters, memory); !status.ok()) return status;
  if (rest == nullptr) {
    form(0, n_, 0);
    return {};
  }
  for (std::size_t p = 0; p < first_piece_[sections.size()]; ++p)
    form(pieces_[p].first, pieces_[p].first + rule_->node.size(),
         rest->value[layers_->size() == 1 ? 0 : pieces_[p].layer]);
  return {};
}

Status Sections::respond(bool parameters, const Memory& memory) {
  runs_.clear();
  if (layers_->size() > 1)
    for (std::size_t p = 0; p < first_piece_[sections_.size()]; ++p)
      runs_.push_back({pieces_[p].layer, pieces_[p].first, rule_->node.size()});
  const std::size_t of_parameters = parameters ? 3 * n_ * layers_->parameter_count() : 0;
  if (gradient_dp_.size() < of_parameters) gradient_dp_.resize(of_parameters);
  return layers_->evaluate(n_, runs_, {c_.data(), 3 * n_}, {gradient_.data(), 3 * n_}, {hessian_.data(), 6 * n_},
                           {gradient_dp_.data(), of_parameters}, memory);
}

/// h = T/c and q = 2Z − T with their derivatives by c at fixed c_z and by c_z at fixed c, where c_r = 1/(c c_z).
void Sections::form(std::size_t first, std::size_t last, double at_rest) {
  detail::vectorised([this, first, last, at_rest] {
    const double* const c = c_.data();
    const double* const cz = c + n_;
    const double* const cr = c + 2 * n_;
    const double* const g = gradient_.data();
    const double* const H = hessian_.data();
    double* const h = h_.data();
    double* const h_c = h_c_.data();
    double* const h_z = h_z_.data();
    double* const q = q_.data();
    double* const q_c = q_c_.data();
    double* const q_z = q_z_.data();
    const std::size_t n = n_;
    TUNICA_LANES
    for (std::size_t k = first; k < last; ++k) {
      const double gt = g[k], gz = g[n + k], gr = g[2 * n + k];
      const double Htt = H[k], Hzz = H[n + k], Hrr = H[2 * n + k];
      const double Htz = H[3 * n + k], Hzr = H[4 * n + k], Htr = H[5 * n + k];
      const double inverse = 1 / c[k], by_c = cr[k] * inverse, by_z = cr[k] / cz[k];  // −∂c_r/∂c, −∂c_r/∂c_z
      const double normal = cr[k] * gr;
      const double normal_c = by_c * (cr[k] * Hrr + gr) - cr[k] * Htr;  // −∂(c_r g_r)/∂c
      const double normal_z = by_z * (cr[k] * Hrr + gr) - cr[k] * Hzr;
      const double T = 2 * (c[k] * gt - normal) - at_rest;
      const double T_c = 2 * (gt + c[k] * (Htt - by_c * Htr) + normal_c);
      const double T_z = 2 * (c[k] * (Htz - by_z * Htr) + normal_z);
      const double h_k = T * inverse;
      h[k] = h_k;
      h_c[k] = (T_c - h_k) * inverse;
      h_z[k] = T_z * inverse;
      q[k] = 4 * (cz[k] * gz - normal) - T;
      q_c[k] = 4 * (cz[k] * (Htz - by_c * Hzr) + normal_c) - T_c;
      q_z[k] = 4 * (gz + cz[k] * (Hzz - by_z * Hzr) + normal_z) - T_z;
    }
  });
}

WallForces Sections::forces(std::size_t i) const {
  const Section& at = sections_[i];
  const Shape<double>& form = shapes_[i];
  double I = 0, I_a = 0, I_b = 0, I_z = 0, J = 0, J_a = 0;
  for (std::size_t k = first_point_[i]; k < first_point_[i + 1]; ++k) {
    I += w_[k] * h_[k];
    I_a += w_[k] * h_c_[k] * inverse_[k];
    I_b += w_[k] * h_c_[k];
    I_z += w_[k] * h_z_[k];
    J += w_[k] * s_[k] * q_[k];
    J_a += w_[k] * q_c_[k];
  }
  const double K2 = wall_->K * wall_->K, lz = at.axial_stretch, sector = std::exp(2 * wall_->iota);
  const double a_y = 2 * K2 * form.ri2, a_axial = form.b * sector / lz, force = std::numbers::pi * form.b / K2;
  return {form.b * I, form.b * I_a * a_y, form.b * (I_a * a_axial - I_b * form.b / lz + 2 * lz * I_z - I / lz),
          force * J, force * J_a * a_y};
}

std::vector<Sections::Across> Sections::across(std::size_t i) const {
  const double b = wall_->K / sections_[i].axial_stretch;
  std::vector<Across> all;
  for (std::size_t p = first_piece_[i]; p < first_piece_[i + 1]; ++p) {
    const double factor = wall_->factor(pieces_[p].layer);
    for (std::size_t k = pieces_[p].first; k < pieces_[p].first + rule_->node.size(); ++k) {
      const double T = c_[k] * h_[k];
      all.push_back({s_[k], c_[k], factor * T, factor * 0.5 * (q_[k] + T), b * w_[k] * h_[k]});
    }
  }
  return all;
}

double Sections::pressure_error(std::size_t i) const {
  double sum = 0;
  for (std::size_t p = first_piece_[i]; p < first_piece_[i + 1]; ++p)
    sum += pieces_[p].length * wall_->factor(pieces_[p].layer) * rule_->error(h_.data() + pieces_[p].first);
  return wall_->K / sections_[i].axial_stretch * sum;
}

WallForcesJet Sections::forces_jet(std::size_t i) const {
  const Section& at = sections_[i];
  const Shape<Jet> form = shape_jet(*wall_, at.y, at.axial_stretch);
  Jet I(0.), J(0.);
  double I_a = 0, I_b = 0, I_z = 0, J_a = 0, J_b = 0, J_z = 0;
  const auto add_edge = [](Jet& to, double weight, const Jet& edge) {
    for (int k = 0; k < variable_count; ++k) to.v[k] += weight * edge.v[k];
  };
  for (std::size_t p = first_piece_[i]; p < first_piece_[i + 1]; ++p) {
    const Piece& piece = pieces_[p];
    double S = 0, R = 0, S_left = 0, S_right = 0, R_left = 0, R_right = 0;
    for (std::size_t m = 0; m < rule_->node.size(); ++m) {
      const std::size_t k = piece.first + m;
      const double wh = w_[k] * h_[k], wq = w_[k] * s_[k] * q_[k], wh_c = w_[k] * h_c_[k], wq_c = w_[k] * q_c_[k];
      S += wh;
      I_a += wh_c * inverse_[k];
      I_b += wh_c;
      I_z += w_[k] * h_z_[k];
      R += wq;
      J_a += wq_c;
      J_b += s_[k] * wq_c;
      J_z += w_[k] * s_[k] * q_z_[k];
      // A node moves with the edges of its piece: ∂c/∂x = −2 (c − b), ∂R²/∂x = 2 R².
      const double slope = -2 * (c_[k] - form.b.a), h_x = slope * wh_c, q_x = s_[k] * slope * wq_c + 2 * wq;
      S_left += (1 - rule_->node[m]) * h_x;
      S_right += rule_->node[m] * h_x;
      R_left += (1 - rule_->node[m]) * q_x;
      R_right += rule_->node[m] * q_x;
    }
    // The integrand is continuous at a cut: moving one changes nothing.
    if (piece.begins) {
      const Jet& edge = edges_[piece.layer];
      add_edge(I, S_left - S / piece.length, edge);
      add_edge(J, R_left - R / piece.length, edge);
    }
    if (piece.ends) {
      const Jet& edge = edges_[piece.layer + 1];
      add_edge(I, S_right + S / piece.length, edge);
      add_edge(J, R_right + R / piece.length, edge);
    }
    I.a += S;
    J.a += R;
  }
  const double K = wall_->K, force = std::numbers::pi / (K * K);
  WallForcesJet forces{Jet(form.b.a * I.a), Jet(force * form.b.a * J.a)};
  for (int k = 0; k < variable_count; ++k) {
    const double a_k = form.a.v[k], b_k = form.b.v[k], z_k = form.cz.v[k];
    forces.p.v[k] = b_k * I.a + form.b.a * (I.v[k] + I_a * a_k + I_b * b_k + I_z * z_k);
    forces.F.v[k] = force * (b_k * J.a + form.b.a * (J.v[k] + J_a * a_k + J_b * b_k + J_z * z_k));
  }
  forces.F.v[closing] -= 2 * forces.F.a / K;
  return forces;
}

std::pair<std::size_t, std::size_t> Sections::points_of(std::size_t i, std::size_t material) const {
  if (layers_->size() == 1) return {first_point_[i], first_point_[i + 1]};
  std::size_t first = n_, last = 0;
  for (std::size_t p = first_piece_[i]; p < first_piece_[i + 1]; ++p) {
    if (pieces_[p].layer != material) continue;
    first = std::min(first, pieces_[p].first);
    last = pieces_[p].first + rule_->node.size();
  }
  return {first, last};
}

Sections::Change Sections::by_parameter(std::size_t i, std::size_t j) const {
  const double* const gt = gradient_dp_.data() + 3 * j * n_;
  const double* const gz = gt + n_;
  const double* const gr = gz + n_;
  const double at_rest = rest_ == nullptr ? 0 : rest_->by_parameter[j];
  const auto [first, last] = points_of(i, layers_->material_of(j));
  double I = 0, J = 0;
  for (std::size_t k = first; k < last; ++k) {
    const double normal = c_[2 * n_ + k] * gr[k], T = 2 * (c_[k] * gt[k] - normal) - at_rest;
    I += w_[k] * T * (c_[n_ + k] * c_[2 * n_ + k]);  // c_t c_z c_r = 1
    J += w_[k] * s_[k] * (4 * (c_[n_ + k] * gz[k] - normal) - T);
  }
  const double b = wall_->K / sections_[i].axial_stretch;
  return {b * I, std::numbers::pi * b / (wall_->K * wall_->K) * J};
}

Sections::Change Sections::by_ratio(std::size_t i) const {
  double I = 0, J = 0;
  for (std::size_t p = first_piece_[i]; p < first_piece_[i + 1]; ++p) {
    const Piece& piece = pieces_[p];
    const double change =
        (piece.layer == 0 ? wall_->inner_by_ratio : wall_->outer_by_ratio) / wall_->factor(piece.layer);
    for (std::size_t k = piece.first; k < piece.first + rule_->node.size(); ++k) {
      I += change * w_[k] * h_[k];
      J += change * w_[k] * s_[k] * q_[k];
    }
  }
  const double b = wall_->K / sections_[i].axial_stretch;
  return {b * I, std::numbers::pi * b / (wall_->K * wall_->K) * J};
}

}  // namespace tunica::thick_wall
