// SPDX-License-Identifier: Apache-2.0
#include "inflation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../thick_wall_pressurisation/rule.hpp"

namespace tunica::bulge {
namespace {

/// Values and slopes at t of Lagrange's polynomials with nodes 0, 1/4, …, 1.
void lagrange(double t, std::array<double, Mesh::degree + 1>& value, std::array<double, Mesh::degree + 1>& slope) {
  constexpr std::size_t n = Mesh::degree + 1;
  const auto node = [](std::size_t k) { return static_cast<double>(k) / Mesh::degree; };
  for (std::size_t k = 0; k < n; ++k) {
    value[k] = 1;
    slope[k] = 0;
    for (std::size_t j = 0; j < n; ++j) {
      if (j == k) continue;
      const double scale = 1 / (node(k) - node(j));
      slope[k] = (slope[k] * (t - node(j)) + value[k]) * scale;
      value[k] *= (t - node(j)) * scale;
    }
  }
}

}  // namespace

Mesh::Mesh(std::size_t elements) : nodes(degree * elements + 1) {
  const thick_wall::Rule rule(static_cast<int>(degree) + 2);
  const auto edge = [elements](std::size_t e) {
    const double radius = static_cast<double>(e) / static_cast<double>(elements);
    return radius * radius;
  };
  const auto scaled = [](std::array<double, degree + 1> slope, double size) {
    for (double& one : slope) one /= size;
    return slope;
  };
  std::array<double, degree + 1> value, slope;
  for (std::size_t e = 0; e < elements; ++e) {
    const double size = edge(e + 1) - edge(e);
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      lagrange(rule.node[k], value, slope);
      points.push_back({edge(e) + rule.node[k] * size, rule.weight[k] * size, degree * e, value, scaled(slope, size)});
    }
  }
  lagrange(0, value, slope);
  at_pole = scaled(slope, edge(1));
}

Inflation::Inflation(const Mesh& mesh, const Model& model, std::span<const double> parameters, plane::Faces faces,
                     double rim)
    : mesh_(mesh),
      membrane_(model, parameters, {1, 0}, faces),
      pole_(membrane_),
      parameter_count_(parameters.size()),
      rim_(rim) {
  membrane_.resize(mesh.points.size());
  pole_.resize(1);
  const auto n = static_cast<long>(mesh.nodes);
  f_ = Vector::Constant(n, rim);
  g_ = Vector::Zero(n);
}

/// A shallow cap, the load such that the apex is in equilibrium.
void Inflation::begin(double height) {
  const auto n = static_cast<long>(mesh_.nodes);
  for (long k = 0; k < n; ++k) {
    const double radius = static_cast<double>(k) / static_cast<double>(n - 1), inside = 1 - radius * radius;
    f_[k] = rim_ + 0.5 * height * height * inside;
    g_[k] = height * inside;
  }
  load_ = 0;
  height_ = height;
  if (assemble(false)) load_ = -residual_[height_place()] / by_load_[height_place()];
}

bool Inflation::assemble(bool by_parameters) {
  const std::size_t n = mesh_.points.size();
  const auto size = 2 * static_cast<long>(mesh_.nodes), nodes = static_cast<long>(mesh_.nodes);
  constexpr std::size_t m = Mesh::degree + 1;
  struct At {
    double f, meridian, rise;  // f, f + 2 s f', g'
  };
  std::vector<At> at(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Mesh::Point& point = mesh_.points[i];
    double f = 0, f_s = 0, g_s = 0;
    for (std::size_t k = 0; k < m; ++k) {
      const auto node = static_cast<long>(point.first + k);
      f += point.shape[k] * f_[node];
      f_s += point.slope[k] * f_[node];
      g_s += point.slope[k] * g_[node];
    }
    at[i] = {f, f + 2 * point.s * f_s, g_s};
    if (!(f > 0)) return false;
    membrane_.C[i] = at[i].meridian * at[i].meridian + 4 * point.s * g_s * g_s;
    membrane_.C[n + i] = f * f;
  }
  if (!membrane_.evaluate(true, by_parameters)) return false;

  residual_.setZero(size);
  by_load_.setZero(size);
  stiffness_.setZero(size, size);
  if (by_parameters) by_parameters_.setZero(size, static_cast<long>(parameter_count_));
  for (std::size_t i = 0; i < n; ++i) {
    const Mesh::Point& point = mesh_.points[i];
    const auto& [f, meridian, rise] = at[i];
    const double w = point.weight, s = point.s, S1 = membrane_.stress[i], S2 = membrane_.stress[n + i];
    const double A11 = membrane_.tangent[i], A12 = membrane_.tangent[n + i], A22 = membrane_.tangent[4 * n + i];
    std::array<double, m> a, b, e, along;  // ∂C1/∂f, ∂C2/∂f, ∂C1/∂g; f + 2 s f' by f
    for (std::size_t k = 0; k < m; ++k) {
      along[k] = point.shape[k] + 2 * s * point.slope[k];
      a[k] = 2 * meridian * along[k];
      b[k] = 2 * f * point.shape[k];
      e[k] = 8 * s * rise * point.slope[k];
    }
    for (std::size_t k = 0; k < m; ++k) {
      const auto fk = static_cast<long>(point.first + k), gk = nodes + fk;
      const double volume_f = s * 2 * f * rise * point.shape[k], volume_g = s * f * f * point.slope[k];
      residual_[fk] += w * (0.5 * S1 * a[k] + 0.5 * S2 * b[k] + load_ * volume_f);
      residual_[gk] += w * (0.5 * S1 * e[k] + load_ * volume_g);
      by_load_[fk] += w * volume_f;
      by_load_[gk] += w * volume_g;
      for (std::size_t j = 0; by_parameters && j < parameter_count_; ++j) {
        const double S1_p = membrane_.stress_dp[3 * j * n + i], S2_p = membrane_.stress_dp[(3 * j + 1) * n + i];
        by_parameters_(fk, static_cast<long>(j)) += w * 0.5 * (S1_p * a[k] + S2_p * b[k]);
        by_parameters_(gk, static_cast<long>(j)) += w * 0.5 * S1_p * e[k];
      }
      for (std::size_t l = 0; l < m; ++l) {
        const auto fl = static_cast<long>(point.first + l), gl = nodes + fl;
        stiffness_(fk, fl) +=
            w * (0.25 * (A11 * a[k] * a[l] + A12 * (a[k] * b[l] + b[k] * a[l]) + A22 * b[k] * b[l]) +
                 S1 * along[k] * along[l] + (S2 + 2 * load_ * s * rise) * point.shape[k] * point.shape[l]);
        const double mixed =
            w * (0.25 * (A11 * a[k] + A12 * b[k]) * e[l] + 2 * load_ * s * f * point.shape[k] * point.slope[l]);
        stiffness_(fk, gl) += mixed;
        stiffness_(gl, fk) += mixed;
        stiffness_(gk, gl) += w * (0.25 * A11 * e[k] * e[l] + 4 * S1 * s * point.slope[k] * point.slope[l]);
      }
    }
  }
  return true;
}

Inflation::Vector Inflation::reduced(const Vector& all) const {
  const auto n = static_cast<long>(mesh_.nodes);
  Vector some(2 * n - 2);
  some << all.head(n - 1), all.segment(n, n - 1);
  return some;
}

void Inflation::factorise() {
  const auto n = static_cast<long>(mesh_.nodes), size = 2 * n - 2;
  Eigen::MatrixXd matrix(size, size);
  for (long k = 0; k < n - 1; ++k) matrix.col(k) = reduced(stiffness_.col(k));
  for (long k = 1; k < n - 1; ++k) matrix.col(n - 2 + k) = reduced(stiffness_.col(n + k));
  matrix.col(size - 1) = reduced(by_load_);
  factor_.compute(matrix);
}

void Inflation::move(const Vector& step, double share) {
  const auto n = static_cast<long>(mesh_.nodes);
  f_.head(n - 1) += share * step.head(n - 1);
  g_.segment(1, n - 2) += share * step.segment(n - 1, n - 2);
  load_ += share * step[2 * n - 3];
}

/// Newton's method at the present height. What its last step leaves behind is about the square of that step.
bool Inflation::settle() {
  constexpr int most = 15;
  const auto n = static_cast<long>(mesh_.nodes);
  const double size = std::min(1.0, height_);
  for (int iteration = 0; iteration < most; ++iteration) {
    if (!assemble(false)) return false;
    factorise();
    const Vector step = factor_.solve(-reduced(residual_));
    if (!step.allFinite()) return false;
    const double of_f = step.head(n - 1).cwiseAbs().maxCoeff(), of_g = step.segment(n - 1, n - 2).cwiseAbs().maxCoeff();
    constexpr double largest_step = 0.5;
    move(step, std::min(1.0, largest_step / std::max({of_f, of_g, 1e-300})));
    if (of_f < 1e-7 * size * size && of_g < 1e-7 * size) return true;
  }
  return false;
}

std::optional<std::string> Inflation::raise_to(double height) {
  constexpr double first_height = 0.1, largest_step = 0.4, least_step = 1e-5;
  if (height_ == 0) {
    begin(std::min(height, first_height));
    if (!settle()) {
      height_ = 0;
      return "no equilibrium is found where the membrane begins to rise; narrow the bounds of the model's parameters";
    }
  }
  double step = 2 * largest_step;
  while (height_ != height) {
    step = std::min(step, largest_step);
    const double before = height_, load = load_;
    const Vector f = f_, g = g_;
    const double next = std::abs(height - height_) <= step ? height : height_ + std::copysign(step, height - height_);
    // The tangent at the height before leads to the next one.
    if (!assemble(false)) return "the energy is undefined; narrow the bounds of the model's parameters";
    factorise();
    move(factor_.solve(-reduced(stiffness_.col(height_place()))), next - height_);
    g_[0] = height_ = next;
    if (settle()) {
      step *= 2;
      continue;
    }
    f_ = f;
    g_ = g;
    load_ = load;
    height_ = before;
    step /= 4;
    if (step < least_step)
      return "the equilibrium is lost on the way there, since the energy is undefined or overflows, or the membrane "
             "snaps; narrow the bounds of the model's parameters";
  }
  return std::nullopt;
}

bool Inflation::linearise(bool by_parameters) {
  if (!assemble(by_parameters)) return false;
  factorise();
  return factor_.solve(reduced(by_load_)).allFinite();
}

Inflation::Reading Inflation::reading_of(const Vector& f, const Vector& g, double load) const {
  double bend = 0;
  for (std::size_t k = 0; k <= Mesh::degree; ++k) bend += mesh_.at_pole[k] * g[static_cast<long>(k)];
  return {load, f[0], bend};
}

Inflation::Reading Inflation::solve(const Vector& right) const {
  const auto n = static_cast<long>(mesh_.nodes);
  const Vector step = factor_.solve(reduced(right));
  Vector f = Vector::Zero(n), g = Vector::Zero(n);
  f.head(n - 1) = step.head(n - 1);
  g.segment(1, n - 2) = step.segment(n - 1, n - 2);
  return reading_of(f, g, step[2 * n - 3]);
}

double Inflation::thickness_stretch(double stretch) const {
  pole_.C = {stretch * stretch, stretch * stretch, 0};
  return pole_.evaluate(false, false) ? std::sqrt(pole_.normal[0]) : std::numeric_limits<double>::quiet_NaN();
}

double Inflation::rim_stretch() const { return std::sqrt(membrane_.C[mesh_.points.size() - 1]); }

}  // namespace tunica::bulge
