// SPDX-License-Identifier: Apache-2.0
#include "assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tunica/detail/vector_level.hpp"

namespace tunica::fe {
namespace {

template <std::size_t Order>
class AssemblyOf final : public Assembly {
  using Elements = Row<Order>;
  using E = Element<Order>;
  static constexpr std::size_t nn = E::nodes, ng = E::points, np = E::modes, dofs = 2 * nn;

 public:
  explicit AssemblyOf(const Mesh& mesh) : mesh_(mesh), n_(mesh.radial), row_(mesh) {
    const double h = (mesh_.outer - mesh_.inner) / static_cast<double>(n_);
    for (std::size_t e = 0; e < n_; ++e) {
      const double from = mesh_.edge(e), to = mesh_.edge(e + 1);
      column_.push_back(mesh_.uniform() ? (mesh_.inner + h * (static_cast<double>(e) + 0.5)) * h
                                        : 0.5 * (to + from) * (to - from));
    }
  }

  [[nodiscard]] std::size_t pressure_count() const override { return np * n_ * mesh_.axial; }

  Status assemble(const Material& material, const State& state, double pressure, bool tangent,
                  System& system) override {
    const std::size_t size = 2 * mesh_.nodes();
    prepare(system, size, tangent);
    double stiffness = 0, largest = 0;
    for (std::size_t row = 0; row < mesh_.axial; ++row) {
      if (row % 64 == 63 && late && late()) return Status::failed("the time limit is reached");
      row_.take(state, row);
      if (Status status = row_.evaluate(material, tangent, false); !status.ok()) return status;
      row_.integrate(material.sees_shear(), tangent, stiffness);
      largest = std::max(largest, scatter(row, tangent, system));
    }
    by_volume(state, system.volume);
    press(pressure, system.volume, system.force);
    if (support.slope != 0) add_support(mesh_, element_, support, state, system.force);
    if (tangent) {
      stiffen_edges(state, pressure);
      for (const Entry& at : edges_) system.matrix.add(at.i, at.j, at.value);
    }
    for (std::size_t i = 0; i < size; ++i) system.right[i] -= system.force[i];
    system.largest_dilation = largest;
    if (tangent) system.stiffness = stiffness;
    return std::isfinite(largest + (tangent ? stiffness : 0))
               ? Status()
               : Status::failed("the stress overflows, or an element is turned inside out");
  }

  /// V = Σ ∫ ½ r² dz along the inner edge.
  void by_volume(const State& state, std::span<double> volume) const override {
    std::fill(volume.begin(), volume.end(), 0.0);
    for (std::size_t row = 0; row < mesh_.axial; ++row)
      for (std::size_t g = 0; g < E::points_1d; ++g) {
        const InnerEdge at = inner_edge(state, row, g);
        const double w = element_.weight_1d[g];
        for (std::size_t k = 0; k < E::side; ++k) {
          volume[at.dof[k]] += w * at.r * at.z * element_.shape_1d[g][k];
          volume[at.dof[k] + 1] += w * at.r * at.r / 2 * element_.slope_1d[g][k];
        }
      }
  }

  Status multiply(const Material& material, const State& state, double pressure, std::span<const State> fields,
                  std::span<State> product, State& residual, Changes* changes) override {
    const std::size_t size = 2 * mesh_.nodes();
    forces_.resize(fields.size() * dofs * n_);
    dilations_.resize(std::max<std::size_t>(fields.size(), 1) * np * n_);
    for (State& of : product) {
      of.x.assign(size, 0);
      of.q.resize(pressure_count());
    }
    residual.x.assign(size, 0);
    residual.q.resize(pressure_count());
    if (changes != nullptr) prepare(material, *changes);
    double unused = 0;
    for (std::size_t row = 0; row < mesh_.axial; ++row) {
      if (row % 64 == 63 && late && late()) return Status::failed("the time limit is reached");
      row_.take(state, row);
      if (Status status = row_.evaluate(material, true, changes != nullptr); !status.ok()) return status;
      row_.integrate(material.sees_shear(), false, unused);
      gather(row, row_.force.data(), residual.x);
      gather_modes(row, row_.c.data(), residual.q);
      row_.multiply(material.sees_shear(), fields, forces_, dilations_);
      for (std::size_t d = 0; d < product.size(); ++d) {
        gather(row, &forces_[d * dofs * n_], product[d].x);
        gather_modes(row, &dilations_[d * np * n_], product[d].q);
      }
      if (changes != nullptr) add_changes(material, row, *changes);
    }
    volume_.resize(size);
    by_volume(state, volume_);
    press(pressure, volume_, residual.x);
    if (support.slope != 0) add_support(mesh_, element_, support, state, residual.x);
    stiffen_edges(state, pressure);
    for (std::size_t d = 0; d < product.size(); ++d)
      for (const Entry& at : edges_) {
        product[d].x[at.i] += at.value * fields[d].x[at.j];
        if (at.i != at.j) product[d].x[at.j] += at.value * fields[d].x[at.i];
      }
    return {};
  }

  double contract(const State& state, const Weights& weight, std::span<double> by_free) override {
    return contract_support(mesh_, element_, support, state, weight.right, by_free);
  }

  Status remember(const Material& material, const State& state) override {
    for (std::size_t row = 0; row < mesh_.axial; ++row) {
      row_.take(state, row);
      if (Status status = material.remember(ng * n_, row_.C, row); !status.ok()) return status;
    }
    return {};
  }

  void pressures(const System& system, std::span<const double> dx, std::span<const double> dilation,
                 std::span<double> dq) const override {
    for (std::size_t row = 0; row < mesh_.axial; ++row)
      for (std::size_t e = 0; e < n_; ++e)
        for (std::size_t m = 0; m < np; ++m) {
          const std::size_t at = (row * n_ + e) * np + m;
          std::array<double, width> sums{};
          for (std::size_t k = 0; k < (dx.empty() ? 0 : E::side); ++k) {
            const double* const x = dx.data() + line(row, e, k);
            const double* const g = system.coupling.data() + at * dofs + k * width;
            for (std::size_t i = 0; i < width; ++i) sums[i] += g[i] * x[i];
          }
          double sum = dilation.empty() ? 0 : dilation[at];
          for (const double part : sums) sum += part;
          dq[at] = -system.gamma * sum / mass(m, e, row);
        }
  }

  void spread(const System& system, std::span<const double> dq, std::span<double> force) const override {
    std::fill(force.begin(), force.end(), 0.0);
    for (std::size_t row = 0; row < mesh_.axial; ++row)
      for (std::size_t e = 0; e < n_; ++e)
        for (std::size_t m = 0; m < np; ++m) {
          const std::size_t at = (row * n_ + e) * np + m;
          for (std::size_t k = 0; k < E::side; ++k) {
            double* const f = force.data() + line(row, e, k);
            const double* const g = system.coupling.data() + at * dofs + k * width;
            for (std::size_t i = 0; i < width; ++i) f[i] += g[i] * dq[at];
          }
        }
  }

  Status energies(const Material& material, const State& state, double& lumen, double& stored) override {
    lumen = stored = 0;
    std::vector<double> W(ng * n_);
    for (std::size_t row = 0; row < mesh_.axial; ++row) {
      row_.take(state, row);
      if (Status status = material.energy(ng * n_, row_.C, W); !status.ok()) return status;
      for (std::size_t g = 0; g < ng; ++g)
        for (std::size_t e = 0; e < n_; ++e) stored += row_.volume(g, e) * W[g * n_ + e];
      for (std::size_t g = 0; g < E::points_1d; ++g) {
        const InnerEdge at = inner_edge(state, row, g);
        lumen += element_.weight_1d[g] * at.r * at.r * at.z / 2;
      }
    }
    lumen *= 2 * std::numbers::pi;
    stored *= 2 * std::numbers::pi;
    return {};
  }

  Status points(const Material& material, const State& state, std::vector<Point>& found) override {
    const std::size_t all = ng * n_;
    found.clear();
    for (std::size_t row = 0; row < mesh_.axial; ++row) {
      row_.take(state, row);
      if (Status status = row_.evaluate(material, false, false); !status.ok()) return status;
      for (std::size_t e = 0; e < n_; ++e)
        for (std::size_t g = 0; g < ng; ++g) {
          Point at;
          at.R = row_.radius(g, e);
          at.Z = mesh_.layer[row * Order] + row_.height(row) * (1 + element_.eta[g]) / 2;
          for (std::size_t k = 0; k < 5; ++k) at.f[k] = row_.f[k * all + g * n_ + e];
          at.column = e;
          if (material.closing() != nullptr && material.closing()->opened)
            at.closing = std::sqrt(material.closing()->square[g * n_ + e]);
          for (std::size_t k = 0; k < (material.sees_shear() ? 4 : 3); ++k)
            at.energy[k] = row_.first[k * all + g * n_ + e];
          for (std::size_t m = 0; m < np; ++m) at.q += element_.mode[g][m] * state.q[(row * n_ + e) * np + m];
          found.push_back(at);
        }
    }
    return {};
  }

 private:
  /// Positions of the nodes of an element in its plane k follow each other, from here on.
  static constexpr std::size_t width = 2 * E::side;
  [[nodiscard]] std::size_t line(std::size_t row, std::size_t e, std::size_t k) const {
    return 2 * mesh_.node(e * Order, row * Order + k);
  }

  /// ∫ ψ_m² dV of an element: M up to what R varies within it, which decides nothing (see the class).
  [[nodiscard]] double mass(std::size_t m, std::size_t e, std::size_t row) const {
    return column_[e] * row_.height(row) / (m == 0 ? 1 : 3);
  }

  void prepare(System& system, std::size_t size, bool tangent) const {
    system.force.assign(size, 0);
    system.right.assign(size, 0);
    system.volume.resize(size);
    system.coupling.resize(pressure_count() * dofs);
    system.dilation.resize(pressure_count());
    if (!tangent) return;
    if (system.matrix.size() != size || system.matrix.width() != Stencil::width_of(mesh_))
      system.matrix.resize(mesh_);
    else
      system.matrix.clear();
  }

  /// The pressure on the inner edge.
  void press(double pressure, std::span<const double> volume, std::span<double> force) const {
    for (std::size_t k = 0; k < (pressure == 0 ? 0 : mesh_.planes()); ++k)
      for (std::size_t d = 0; d < 2; ++d) {
        const std::size_t i = 2 * mesh_.node(0, k) + d;
        force[i] -= pressure * volume[i];
      }
  }

  /// Adds the values of a row's lanes, dof by dof.
  void gather(std::size_t row, const double* force, std::span<double> to) const {
    for (std::size_t a = 0; a < nn; ++a)
      for (std::size_t e = 0; e < n_; ++e) {
        const std::size_t dof = 2 * row_.node(a, e, row);
        to[dof] += force[2 * a * n_ + e];
        to[dof + 1] += force[(2 * a + 1) * n_ + e];
      }
  }

  void gather_modes(std::size_t row, const double* c, std::span<double> to) const {
    for (std::size_t m = 0; m < np; ++m)
      for (std::size_t e = 0; e < n_; ++e) to[(row * n_ + e) * np + m] = c[m * n_ + e];
  }

  /// Parameters whose changes multiply() finds.
  static std::size_t changing(const Material& material) {
    const bool closed = material.closing() != nullptr && material.closing()->differentiated();
    return material.parameter_count() + (closed ? std::size_t{geometry_count} : 1);
  }

  void prepare(const Material& material, Changes& changes) {
    changes.force.assign(changing(material) * 2 * mesh_.nodes(), 0);
    changes.dilation.resize(pressure_count());
    forces_by_.resize(changing(material) * dofs * n_);
  }

  void add_changes(const Material& material, std::size_t row, Changes& changes) {
    const std::size_t size = 2 * mesh_.nodes();
    row_.change(material, forces_by_);
    for (std::size_t j = 0; j < changing(material); ++j)
      gather(row, &forces_by_[j * dofs * n_], std::span(changes.force).subspan(j * size, size));
    row_.dilate(dilations_);
    gather_modes(row, dilations_.data(), changes.dilation);
  }

  /// Condenses the pressures and adds the row to the system; returns the largest mean of |J − 1|.
  double scatter(std::size_t row, bool tangent, System& system) {
    gather(row, row_.force.data(), system.force);
    double largest = 0;
    for (std::size_t m = 0; m < np; ++m)
      for (std::size_t e = 0; e < n_; ++e) {
        const double factor = system.gamma / mass(m, e, row), c = row_.c[m * n_ + e];
        const std::size_t at = (row * n_ + e) * np + m;
        system.dilation[at] = c;
        largest = std::max(largest, std::abs(c) / mass(0, e, row));
        double* __restrict__ const coupling = system.coupling.data() + at * dofs;
        for (std::size_t i = 0; i < (tangent ? dofs : 0); ++i) coupling[i] = row_.coupling[(m * dofs + i) * n_ + e];
        for (std::size_t a = 0; a < nn; ++a) {
          const std::size_t dof = 2 * row_.node(a, e, row);
          system.right[dof] -= factor * c * coupling[2 * a];
          system.right[dof + 1] -= factor * c * coupling[2 * a + 1];
        }
      }
    if (!tangent) return largest;
    detail::vectorised([&] { condense(row, system.gamma); });
    for (std::size_t b = 0; b < nn; ++b)
      for (std::size_t a = 0; a <= b; ++a)
        for (std::size_t s = 0; s < 2; ++s)
          for (std::size_t t = 0; t < (a == b ? s + 1 : 2); ++t) {
            const double* __restrict__ const k = row_.k.data() + upper(2 * a + t, 2 * b + s) * n_;
            const std::size_t below =
                2 * (row_.node(b, 0, row) - row_.node(a, 0, row)) + s - t;  // nodes are numbered as here
            const std::size_t slot = system.matrix.slot(below);
            for (std::size_t e = 0; e < n_; ++e) system.matrix.column(2 * row_.node(a, e, row) + t)[slot] += k[e];
          }
    return largest;
  }

  /// k += γ G M⁻¹ Gᵀ
  void condense(std::size_t row, double gamma) {
    for (std::size_t m = 0; m < np; ++m)
      for (std::size_t j = 0; j < dofs; ++j) {
        const double* __restrict__ const gj = row_.coupling.data() + (m * dofs + j) * n_;
        double* __restrict__ const scaled = row_.scratch.data();
#pragma GCC ivdep
        for (std::size_t e = 0; e < n_; ++e) scaled[e] = gamma / mass(m, e, row) * gj[e];
        for (std::size_t i = 0; i <= j; ++i) {
          const double* __restrict__ const gi = row_.coupling.data() + (m * dofs + i) * n_;
          double* __restrict__ const k = row_.k.data() + upper(i, j) * n_;
#pragma GCC ivdep
          for (std::size_t e = 0; e < n_; ++e) k[e] += gi[e] * scaled[e];
        }
      }
  }

  /// A Gauss point of the inner edge of a row of elements: r, dz along it and the positions there.
  struct InnerEdge {
    double r = 0, z = 0;
    std::array<std::size_t, E::side> dof{};
  };
  [[nodiscard]] InnerEdge inner_edge(const State& state, std::size_t row, std::size_t g) const {
    InnerEdge at;
    for (std::size_t k = 0; k < E::side; ++k) {
      at.dof[k] = 2 * mesh_.node(0, row * Order + k);
      at.r += element_.shape_1d[g][k] * state.x[at.dof[k]];
      at.z += element_.slope_1d[g][k] * state.x[at.dof[k] + 1];
    }
    return at;
  }

  /// Into edges_: −P times the Hessian of V, and what the support adds.
  void stiffen_edges(const State& state, double pressure) {
    edges_.clear();
    for (std::size_t row = 0; row < (pressure == 0 ? 0 : mesh_.axial); ++row)
      for (std::size_t g = 0; g < E::points_1d; ++g) {
        const InnerEdge at = inner_edge(state, row, g);
        const auto& N = element_.shape_1d[g];
        const auto& D = element_.slope_1d[g];
        const double w = element_.weight_1d[g];
        for (std::size_t k = 0; k < E::side; ++k)
          for (std::size_t l = 0; l < E::side; ++l) {
            if (k <= l) edges_.push_back({at.dof[k], at.dof[l], -pressure * w * at.z * N[k] * N[l]});
            edges_.push_back({at.dof[k], at.dof[l] + 1, -pressure * w * at.r * N[k] * D[l]});
          }
      }
    if (support.slope != 0) stiffen_by_support(mesh_, element_, support, state, edges_);
  }

  const Mesh mesh_;
  const std::size_t n_;  ///< elements along R
  const E element_;
  Elements row_;
  std::vector<double> column_;                          ///< ∫ R dR over each column of elements
  std::vector<Entry> edges_;                            ///< of the matrix, by what acts on the edges of the wall
  std::vector<double> forces_, dilations_, forces_by_;  ///< of a row, by multiply()
  std::vector<double> volume_;
};

}  // namespace

std::array<double, 4> Point::stress() const {
  const auto [f0, f1, f2, f3, f4] = f;
  const double wt = 2 * energy[0], wz = 2 * energy[1], wr = 2 * energy[2], ws = energy[3];
  return {f0 * (wr * f0 + ws * f1) + f1 * (wz * f1 + ws * f0) - q,
          f2 * (wr * f2 + ws * f3) + f3 * (wz * f3 + ws * f2) - q, wt * f4 * f4 - q,
          f0 * (wr * f2 + ws * f3) + f1 * (wz * f3 + ws * f2)};
}

std::unique_ptr<Assembly> Assembly::make(const Mesh& mesh) {
  if (mesh.order == 1) return std::make_unique<AssemblyOf<1>>(mesh);
  return std::make_unique<AssemblyOf<2>>(mesh);
}

}  // namespace tunica::fe
