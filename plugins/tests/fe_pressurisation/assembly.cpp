// SPDX-License-Identifier: Apache-2.0
#include "assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "element.hpp"

namespace tunica::fe {
namespace {

/// Of an upper triangle by columns.
constexpr std::size_t upper(std::size_t i, std::size_t j) { return i <= j ? j * (j + 1) / 2 + i : i * (i + 1) / 2 + j; }

template <std::size_t Order>
class AssemblyOf final : public Assembly {
  using E = Element<Order>;
  static constexpr std::size_t nn = E::nodes, ng = E::points, np = E::modes, dofs = 2 * nn;

 public:
  explicit AssemblyOf(const Mesh& mesh)
      : mesh_(mesh), n_(mesh.radial), h_((mesh.outer - mesh.inner) / static_cast<double>(n_)) {
    for (std::size_t g = 0; g < ng; ++g)
      for (std::size_t e = 0; e < n_; ++e)
        radius_.push_back(mesh.inner + h_ * (static_cast<double>(e) + 0.5 * (1 + element_.xi[g])));
    for (std::size_t g = 0; g < ng; ++g)
      for (std::size_t a = 0; a < nn; ++a)
        for (std::size_t e = 0; e < n_; ++e) over_radius_.push_back(element_.shape[g][a] / radius_[g * n_ + e]);
    x_.resize(dofs * n_), q_.resize(np * n_);
    f_.resize(5 * ng * n_), C_.resize(4 * ng * n_), first_.resize(4 * ng * n_), second_.resize(10 * ng * n_);
    p_.resize(5 * n_), a_.resize(15 * n_), t_.resize(10 * n_);
    k_.resize(dofs * (dofs + 1) / 2 * n_), force_.resize(dofs * n_), g_.resize(np * dofs * n_), c_.resize(np * n_);
  }

  [[nodiscard]] std::size_t pressure_count() const override { return np * n_ * mesh_.axial; }

  Status assemble(const Material& material, const State& state, double pressure, bool tangent,
                  System& system) override {
    const std::size_t size = 2 * mesh_.nodes();
    prepare(system, size, tangent);
    double stiffness = 0, largest = 0;
    for (std::size_t row = 0; row < mesh_.axial; ++row) {
      gather(state, row);
      if (Status status = evaluate(material, row, tangent); !status.ok()) return status;
      integrate(material.sees_shear(), row, tangent, stiffness);
      largest = std::max(largest, scatter(row, tangent, system));
    }
    follow_pressure(state, pressure, tangent, system);
    for (std::size_t i = 0; i < size; ++i) system.right[i] -= system.force[i];
    system.largest_dilation = largest;
    if (tangent) system.stiffness = stiffness;
    return std::isfinite(largest + (tangent ? stiffness : 0))
               ? Status()
               : Status::failed("the stress overflows, or an element is turned inside out");
  }

  Status by_parameters(const Material& material, const State& state, std::span<double> forces) override {
    const std::size_t size = 2 * mesh_.nodes(), count = material.parameter_count();
    first_dp_.resize(4 * count * ng * n_);
    std::fill(forces.begin(), forces.end(), 0.0);
    for (std::size_t row = 0; row < mesh_.axial; ++row) {
      gather(state, row);
      deform(row);
      if (Status status = material.evaluate(ng * n_, C_, {}, {}, first_dp_); !status.ok()) return status;
      std::fill(q_.begin(), q_.end(), 0.0);
      for (std::size_t j = 0; j < count; ++j) {
        std::copy_n(first_dp_.data() + 4 * j * ng * n_, 4 * ng * n_, first_.data());
        std::fill(force_.begin(), force_.end(), 0.0);
        for (std::size_t g = 0; g < ng; ++g) {
          stress(g, row, true);
          add_force(g, row);
        }
        scatter_force(row, forces.subspan(j * size, size));
      }
    }
    return {};
  }

  void pressures(const System& system, std::span<const double> dx, std::span<const double> dilation,
                 std::span<double> dq) const override {
    for (std::size_t row = 0; row < mesh_.axial; ++row)
      for (std::size_t e = 0; e < n_; ++e)
        for (std::size_t m = 0; m < np; ++m) {
          const std::size_t at = (row * n_ + e) * np + m;
          double sum = dilation.empty() ? 0 : dilation[at];
          for (std::size_t a = 0; a < nn; ++a) {
            const std::size_t dof = 2 * node(a, e, row);
            sum += system.coupling[at * dofs + 2 * a] * dx[dof] + system.coupling[at * dofs + 2 * a + 1] * dx[dof + 1];
          }
          dq[at] = -system.gamma * sum / mass(m, e, row);
        }
  }

  void spread(const System& system, std::span<const double> dq, std::span<double> force) const override {
    std::fill(force.begin(), force.end(), 0.0);
    for (std::size_t row = 0; row < mesh_.axial; ++row)
      for (std::size_t e = 0; e < n_; ++e)
        for (std::size_t m = 0; m < np; ++m) {
          const std::size_t at = (row * n_ + e) * np + m;
          for (std::size_t a = 0; a < nn; ++a) {
            const std::size_t dof = 2 * node(a, e, row);
            force[dof] += system.coupling[at * dofs + 2 * a] * dq[at];
            force[dof + 1] += system.coupling[at * dofs + 2 * a + 1] * dq[at];
          }
        }
  }

  Status energies(const Material& material, const State& state, double& lumen, double& stored) override {
    lumen = stored = 0;
    std::vector<double> W(ng * n_);
    for (std::size_t row = 0; row < mesh_.axial; ++row) {
      gather(state, row);
      deform(row);
      if (Status status = material.energy(ng * n_, C_, W); !status.ok()) return status;
      for (std::size_t g = 0; g < ng; ++g)
        for (std::size_t e = 0; e < n_; ++e)
          stored += element_.weight[g] * h_ * height(row) / 4 * radius_[g * n_ + e] * W[g * n_ + e];
      for (std::size_t g = 0; g < E::points_1d; ++g) {
        double r = 0, z = 0;
        for (std::size_t k = 0; k < E::side; ++k) {
          const std::size_t dof = 2 * mesh_.node(0, row * Order + k);
          r += element_.shape_1d[g][k] * state.x[dof], z += element_.slope_1d[g][k] * state.x[dof + 1];
        }
        lumen += element_.weight_1d[g] * r * r * z / 2;
      }
    }
    lumen *= 2 * std::numbers::pi, stored *= 2 * std::numbers::pi;
    return {};
  }

  Status points(const Material& material, const State& state, std::vector<Point>& found) override {
    found.clear();
    for (std::size_t row = 0; row < mesh_.axial; ++row) {
      gather(state, row);
      if (Status status = evaluate(material, row, false); !status.ok()) return status;
      for (std::size_t e = 0; e < n_; ++e)
        for (std::size_t g = 0; g < ng; ++g) {
          Point at;
          at.R = radius_[g * n_ + e];
          at.Z = mesh_.layer[row * Order] + height(row) * (1 + element_.eta[g]) / 2;
          for (std::size_t k = 0; k < 5; ++k) at.f[k] = f_[(k * ng + g) * n_ + e];
          for (std::size_t k = 0; k < (material.sees_shear() ? 4 : 3); ++k)
            at.energy[k] = first_[(k * ng + g) * n_ + e];
          for (std::size_t m = 0; m < np; ++m) at.q += element_.mode[g][m] * q_[m * n_ + e];
          found.push_back(at);
        }
    }
    return {};
  }

 private:
  [[nodiscard]] std::size_t node(std::size_t a, std::size_t e, std::size_t row) const {
    return mesh_.node(e * Order + a % E::side, row * Order + a / E::side);
  }
  [[nodiscard]] double height(std::size_t row) const {
    return mesh_.layer[(row + 1) * Order] - mesh_.layer[row * Order];
  }
  /// ∫ ψ_m² dV of an element: M up to what R varies within it, which decides nothing (see the class).
  [[nodiscard]] double mass(std::size_t m, std::size_t e, std::size_t row) const {
    const double middle = mesh_.inner + h_ * (static_cast<double>(e) + 0.5);
    return middle * h_ * height(row) / (m == 0 ? 1 : 3);
  }

  void prepare(System& system, std::size_t size, bool tangent) const {
    system.force.assign(size, 0), system.right.assign(size, 0), system.volume.assign(size, 0);
    system.coupling.resize(pressure_count() * dofs), system.dilation.resize(pressure_count());
    if (!tangent) return;
    const std::size_t width = 2 * (Order * mesh_.across() + Order) + 1;
    if (system.matrix.size() != size || system.matrix.width() != width)
      system.matrix.resize(size, width);
    else
      system.matrix.clear();
  }

  void gather(const State& state, std::size_t row) {
    for (std::size_t a = 0; a < nn; ++a)
      for (std::size_t e = 0; e < n_; ++e) {
        const std::size_t dof = 2 * node(a, e, row);
        x_[2 * a * n_ + e] = state.x[dof], x_[(2 * a + 1) * n_ + e] = state.x[dof + 1];
      }
    for (std::size_t e = 0; e < n_; ++e)
      for (std::size_t m = 0; m < np; ++m) q_[m * n_ + e] = state.q[(row * n_ + e) * np + m];
  }

  /// f and C at all points of the row.
  void deform(std::size_t row) {
    const double to_z = 2 / height(row), to_r = 2 / h_;
    const std::size_t all = ng * n_;
    for (std::size_t g = 0; g < ng; ++g) {
      double* __restrict__ const f0 = f_.data() + g * n_;
      double* __restrict__ const f1 = f0 + all;
      double* __restrict__ const f2 = f1 + all;
      double* __restrict__ const f3 = f2 + all;
      double* __restrict__ const f4 = f3 + all;
      for (std::size_t e = 0; e < n_; ++e) f0[e] = f1[e] = f2[e] = f3[e] = f4[e] = 0;
      for (std::size_t a = 0; a < nn; ++a) {
        const double by_r = element_.by_xi[g][a] * to_r, by_z = element_.by_eta[g][a] * to_z;
        const double* __restrict__ const r = x_.data() + 2 * a * n_;
        const double* __restrict__ const z = r + n_;
        const double* __restrict__ const t = over_radius_.data() + (g * nn + a) * n_;
        for (std::size_t e = 0; e < n_; ++e) {
          f0[e] += by_r * r[e], f1[e] += by_z * r[e], f2[e] += by_r * z[e], f3[e] += by_z * z[e], f4[e] += t[e] * r[e];
        }
      }
      double* __restrict__ const C = C_.data() + g * n_;
      for (std::size_t e = 0; e < n_; ++e) {
        C[e] = f4[e] * f4[e], C[all + e] = f1[e] * f1[e] + f3[e] * f3[e];
        C[2 * all + e] = f0[e] * f0[e] + f2[e] * f2[e], C[3 * all + e] = f0[e] * f1[e] + f2[e] * f3[e];
      }
    }
  }

  Status evaluate(const Material& material, std::size_t row, bool tangent) {
    deform(row);
    return material.evaluate(ng * n_, C_, first_, tangent ? std::span<double>(second_) : std::span<double>(), {});
  }

  /// P = ∂w/∂f at Gauss point g of w = W − q (J − 1), f = (r_R, r_Z, z_R, z_Z, r/R), times the weight of the point.
  void stress(std::size_t g, std::size_t row, bool sees_shear) {
    const std::size_t all = ng * n_;
    const double* __restrict__ const f = f_.data() + g * n_;
    const double* __restrict__ const w = first_.data() + g * n_;
    double* __restrict__ const p = p_.data();
    const double area = element_.weight[g] * h_ * height(row) / 4;
    const double* __restrict__ const R = radius_.data() + g * n_;
    for (std::size_t e = 0; e < n_; ++e) {
      const double f0 = f[e], f1 = f[all + e], f2 = f[2 * all + e], f3 = f[3 * all + e], f4 = f[4 * all + e];
      const double wt = 2 * w[e], wz = 2 * w[all + e], wr = 2 * w[2 * all + e], ws = sees_shear ? w[3 * all + e] : 0;
      double q = q_[e];
      if constexpr (np == 3) q += element_.xi[g] * q_[n_ + e] + element_.eta[g] * q_[2 * n_ + e];
      const double dV = area * R[e], qf = q * f4;
      // ∂C by f, and J = f4 (f0 f3 − f1 f2)
      p[e] = dV * (wr * f0 + ws * f1 - qf * f3);
      p[n_ + e] = dV * (wz * f1 + ws * f0 + qf * f2);
      p[2 * n_ + e] = dV * (wr * f2 + ws * f3 + qf * f1);
      p[3 * n_ + e] = dV * (wz * f3 + ws * f2 - qf * f0);
      p[4 * n_ + e] = dV * (wt * f4 - q * (f0 * f3 - f1 * f2));
    }
  }

  /// A = ∂²w/∂f² at Gauss point g, times its weight; entry (i, j) at upper(i, j).
  void moduli(std::size_t g, std::size_t row, bool sees_shear, double& stiffness) {
    const std::size_t all = ng * n_;
    const double* __restrict__ const f = f_.data() + g * n_;
    const double* __restrict__ const w = first_.data() + g * n_;
    const double* __restrict__ const h = second_.data() + g * n_;
    double* __restrict__ const a = a_.data();
    const double area = element_.weight[g] * h_ * height(row) / 4;
    const double* __restrict__ const R = radius_.data() + g * n_;
    double largest = 0, sum = 0;
    for (std::size_t e = 0; e < n_; ++e) {
      const double f0 = f[e], f1 = f[all + e], f2 = f[2 * all + e], f3 = f[3 * all + e], f4 = f[4 * all + e];
      const double wt = 2 * w[e], wz = 2 * w[all + e], wr = 2 * w[2 * all + e];
      double q = q_[e];
      if constexpr (np == 3) q += element_.xi[g] * q_[n_ + e] + element_.eta[g] * q_[2 * n_ + e];
      const double dV = area * R[e];
      // ∂C_t/∂f = (0, 0, 0, 0, 2 f4), ∂C_z/∂f = (0, 2 f1, 0, 2 f3, 0), ∂C_r/∂f = (2 f0, 0, 2 f2, 0, 0)
      const double tt = 4 * h[e], zz = 4 * h[all + e], rr = 4 * h[2 * all + e], tz = 4 * h[3 * all + e],
                   zr = 4 * h[4 * all + e], tr = 4 * h[5 * all + e], qf = q * f4;
      a[upper(0, 0) * n_ + e] = dV * (rr * f0 * f0 + wr);
      a[upper(0, 1) * n_ + e] = dV * (zr * f0 * f1);
      a[upper(0, 2) * n_ + e] = dV * (rr * f0 * f2);
      a[upper(0, 3) * n_ + e] = dV * (zr * f0 * f3 - qf);
      a[upper(0, 4) * n_ + e] = dV * (tr * f0 * f4 - q * f3);
      a[upper(1, 1) * n_ + e] = dV * (zz * f1 * f1 + wz);
      a[upper(1, 2) * n_ + e] = dV * (zr * f1 * f2 + qf);
      a[upper(1, 3) * n_ + e] = dV * (zz * f1 * f3);
      a[upper(1, 4) * n_ + e] = dV * (tz * f1 * f4 + q * f2);
      a[upper(2, 2) * n_ + e] = dV * (rr * f2 * f2 + wr);
      a[upper(2, 3) * n_ + e] = dV * (zr * f2 * f3);
      a[upper(2, 4) * n_ + e] = dV * (tr * f2 * f4 + q * f1);
      a[upper(3, 3) * n_ + e] = dV * (zz * f3 * f3 + wz);
      a[upper(3, 4) * n_ + e] = dV * (tz * f3 * f4 - q * f0);
      a[upper(4, 4) * n_ + e] = dV * (tt * f4 * f4 + wt);
      const double modulus = tt * f4 * f4 + zz * f3 * f3 + rr * f0 * f0 + std::abs(wt);
      largest = std::max(largest, modulus), sum += modulus;
    }
    stiffness = std::isfinite(sum) ? std::max(stiffness, largest) : sum;
    if (sees_shear) add_shear(g, area);
  }

  /// What the energy adds to A where it depends on s = C_zr, ∂s/∂f = (f1, f0, f3, f2, 0).
  void add_shear(std::size_t g, double area) {
    const std::size_t all = ng * n_;
    for (std::size_t e = 0; e < n_; ++e) {
      const auto f = [&](std::size_t k) { return f_[k * all + g * n_ + e]; };
      const auto h = [&](std::size_t k) { return second_[k * all + g * n_ + e]; };
      const double dV = area * radius_[g * n_ + e], ws = first_[3 * all + g * n_ + e];
      const double s[5] = {f(1), f(0), f(3), f(2), 0};
      const double t[5] = {0, 0, 0, 0, 2 * f(4)}, z[5] = {0, 2 * f(1), 0, 2 * f(3), 0},
                   r[5] = {2 * f(0), 0, 2 * f(2), 0, 0};
      for (std::size_t j = 0; j < 5; ++j)
        for (std::size_t i = 0; i <= j; ++i)
          a_[upper(i, j) * n_ + e] += dV * (h(6) * s[i] * s[j] + h(7) * (t[i] * s[j] + s[i] * t[j]) +
                                            h(8) * (z[i] * s[j] + s[i] * z[j]) + h(9) * (r[i] * s[j] + s[i] * r[j]));
      a_[upper(0, 1) * n_ + e] += dV * ws, a_[upper(2, 3) * n_ + e] += dV * ws;
    }
  }

  void add_force(std::size_t g, std::size_t row) {
    const double to_z = 2 / height(row), to_r = 2 / h_;
    const double* __restrict__ const p = p_.data();
    for (std::size_t a = 0; a < nn; ++a) {
      const double by_r = element_.by_xi[g][a] * to_r, by_z = element_.by_eta[g][a] * to_z;
      const double* __restrict__ const t = over_radius_.data() + (g * nn + a) * n_;
      double* __restrict__ const r = force_.data() + 2 * a * n_;
      double* __restrict__ const z = r + n_;
      for (std::size_t e = 0; e < n_; ++e) {
        r[e] += by_r * p[e] + by_z * p[n_ + e] + t[e] * p[4 * n_ + e];
        z[e] += by_r * p[2 * n_ + e] + by_z * p[3 * n_ + e];
      }
    }
  }

  /// Bᵀ A B, where ∂f/∂r_a = (N_R, N_Z, 0, 0, N/R) and ∂f/∂z_a = (0, 0, N_R, N_Z, 0).
  void add_stiffness(std::size_t g, std::size_t row) {
    const double to_z = 2 / height(row), to_r = 2 / h_;
    const double* __restrict__ const A = a_.data();
    double* __restrict__ const T = t_.data();
    const std::size_t n = n_;
    for (std::size_t b = 0; b < nn; ++b) {
      const double br = element_.by_xi[g][b] * to_r, bz = element_.by_eta[g][b] * to_z;
      const double* __restrict__ const bt = over_radius_.data() + (g * nn + b) * n;
      for (std::size_t i = 0; i < 5; ++i) {
        const double* __restrict__ const a0 = A + upper(i, 0) * n;
        const double* __restrict__ const a1 = A + upper(i, 1) * n;
        const double* __restrict__ const a2 = A + upper(i, 2) * n;
        const double* __restrict__ const a3 = A + upper(i, 3) * n;
        const double* __restrict__ const a4 = A + upper(i, 4) * n;
        double* __restrict__ const tr = T + i * n;
        double* __restrict__ const tz = T + (5 + i) * n;
        for (std::size_t e = 0; e < n; ++e) {
          tr[e] = a0[e] * br + a1[e] * bz + a4[e] * bt[e];
          tz[e] = a2[e] * br + a3[e] * bz;
        }
      }
      for (std::size_t a = 0; a <= b; ++a) {
        const double ar = element_.by_xi[g][a] * to_r, az = element_.by_eta[g][a] * to_z;
        const double* __restrict__ const at = over_radius_.data() + (g * nn + a) * n;
        double* __restrict__ const rr = k_.data() + upper(2 * a, 2 * b) * n;
        double* __restrict__ const zr = k_.data() + upper(2 * a + 1, 2 * b) * n;
        double* __restrict__ const rz = k_.data() + upper(2 * a, 2 * b + 1) * n;
        double* __restrict__ const zz = k_.data() + upper(2 * a + 1, 2 * b + 1) * n;
        for (std::size_t e = 0; e < n; ++e) {
          rr[e] += ar * T[e] + az * T[n + e] + at[e] * T[4 * n + e];
          rz[e] += ar * T[5 * n + e] + az * T[6 * n + e] + at[e] * T[9 * n + e];
          zz[e] += ar * T[7 * n + e] + az * T[8 * n + e];
        }
        if (a < b)
          for (std::size_t e = 0; e < n; ++e) zr[e] += ar * T[2 * n + e] + az * T[3 * n + e];
      }
    }
  }

  /// c = ∫ (J − 1) ψ dV and, with the tangent, G = ∫ ∂J/∂x ψ dV.
  void add_coupling(std::size_t g, std::size_t row, bool tangent) {
    const std::size_t all = ng * n_;
    const double to_z = 2 / height(row), to_r = 2 / h_, area = element_.weight[g] * h_ * height(row) / 4;
    const double* __restrict__ const f = f_.data() + g * n_;
    const double* __restrict__ const R = radius_.data() + g * n_;
    double* __restrict__ const j = t_.data();  // ∂J/∂f · dV, and (J − 1) dV
    for (std::size_t e = 0; e < n_; ++e) {
      const double f0 = f[e], f1 = f[all + e], f2 = f[2 * all + e], f3 = f[3 * all + e], f4 = f[4 * all + e];
      const double dV = area * R[e], plane = f0 * f3 - f1 * f2;
      j[e] = dV * f4 * f3, j[n_ + e] = -dV * f4 * f2, j[2 * n_ + e] = -dV * f4 * f1, j[3 * n_ + e] = dV * f4 * f0;
      j[4 * n_ + e] = dV * plane, j[5 * n_ + e] = dV * (f4 * plane - 1);
    }
    for (std::size_t m = 0; m < np; ++m) {
      const double mode = element_.mode[g][m];
      double* __restrict__ const c = c_.data() + m * n_;
      for (std::size_t e = 0; e < n_; ++e) c[e] += mode * j[5 * n_ + e];
      for (std::size_t a = 0; a < (tangent ? nn : 0); ++a) {
        const double by_r = mode * element_.by_xi[g][a] * to_r, by_z = mode * element_.by_eta[g][a] * to_z;
        const double* __restrict__ const t = over_radius_.data() + (g * nn + a) * n_;
        double* __restrict__ const r = g_.data() + (m * dofs + 2 * a) * n_;
        double* __restrict__ const z = r + n_;
        for (std::size_t e = 0; e < n_; ++e) {
          r[e] += by_r * j[e] + by_z * j[n_ + e] + mode * t[e] * j[4 * n_ + e];
          z[e] += by_r * j[2 * n_ + e] + by_z * j[3 * n_ + e];
        }
      }
    }
  }

  void integrate(bool sees_shear, std::size_t row, bool tangent, double& stiffness) {
    std::fill(force_.begin(), force_.end(), 0.0), std::fill(c_.begin(), c_.end(), 0.0);
    if (tangent) std::fill(k_.begin(), k_.end(), 0.0), std::fill(g_.begin(), g_.end(), 0.0);
    for (std::size_t g = 0; g < ng; ++g) {
      stress(g, row, sees_shear);
      add_force(g, row);
      add_coupling(g, row, tangent);
      if (!tangent) continue;
      moduli(g, row, sees_shear, stiffness);
      add_stiffness(g, row);
    }
  }

  void scatter_force(std::size_t row, std::span<double> force) const {
    for (std::size_t a = 0; a < nn; ++a)
      for (std::size_t e = 0; e < n_; ++e) {
        const std::size_t dof = 2 * node(a, e, row);
        force[dof] += force_[2 * a * n_ + e], force[dof + 1] += force_[(2 * a + 1) * n_ + e];
      }
  }

  /// Condenses the pressures and adds the row to the system; returns the largest mean of |J − 1|.
  double scatter(std::size_t row, bool tangent, System& system) {
    scatter_force(row, system.force);
    double largest = 0;
    for (std::size_t m = 0; m < np; ++m)
      for (std::size_t e = 0; e < n_; ++e) {
        const double factor = system.gamma / mass(m, e, row), c = c_[m * n_ + e];
        const std::size_t at = (row * n_ + e) * np + m;
        system.dilation[at] = c;
        largest = std::max(largest, std::abs(c) / mass(0, e, row));
        double* __restrict__ const coupling = system.coupling.data() + at * dofs;
        for (std::size_t i = 0; i < (tangent ? dofs : 0); ++i) coupling[i] = g_[(m * dofs + i) * n_ + e];
        for (std::size_t a = 0; a < nn; ++a) {
          const std::size_t dof = 2 * node(a, e, row);
          system.right[dof] -= factor * c * coupling[2 * a], system.right[dof + 1] -= factor * c * coupling[2 * a + 1];
        }
      }
    if (!tangent) return largest;
    for (std::size_t m = 0; m < np; ++m)
      for (std::size_t j = 0; j < dofs; ++j) {
        const double* __restrict__ const gj = g_.data() + (m * dofs + j) * n_;
        double* __restrict__ const scaled = t_.data();
        for (std::size_t e = 0; e < n_; ++e) scaled[e] = system.gamma / mass(m, e, row) * gj[e];
        for (std::size_t i = 0; i <= j; ++i) {
          const double* __restrict__ const gi = g_.data() + (m * dofs + i) * n_;
          double* __restrict__ const k = k_.data() + upper(i, j) * n_;
          for (std::size_t e = 0; e < n_; ++e) k[e] += gi[e] * scaled[e];
        }
      }
    for (std::size_t b = 0; b < nn; ++b)
      for (std::size_t a = 0; a <= b; ++a)
        for (std::size_t s = 0; s < 2; ++s)
          for (std::size_t t = 0; t < (a == b ? s + 1 : 2); ++t) {
            const double* __restrict__ const k = k_.data() + upper(2 * a + t, 2 * b + s) * n_;
            const std::size_t below = 2 * (node(b, 0, row) - node(a, 0, row)) + s - t;  // nodes are numbered as here
            for (std::size_t e = 0; e < n_; ++e) system.matrix.column(2 * node(a, e, row) + t)[below] += k[e];
          }
    return largest;
  }

  /// V = Σ ∫ ½ r² dz along the inner edge: its gradient, and −P times gradient and Hessian.
  void follow_pressure(const State& state, double pressure, bool tangent, System& system) const {
    for (std::size_t row = 0; row < mesh_.axial; ++row)
      for (std::size_t g = 0; g < E::points_1d; ++g) {
        const auto& N = element_.shape_1d[g];
        const auto& D = element_.slope_1d[g];
        double r = 0, z = 0;
        std::size_t dof[E::side];
        for (std::size_t k = 0; k < E::side; ++k) {
          dof[k] = 2 * mesh_.node(0, row * Order + k);
          r += N[k] * state.x[dof[k]], z += D[k] * state.x[dof[k] + 1];
        }
        const double w = element_.weight_1d[g];
        for (std::size_t k = 0; k < E::side; ++k)
          system.volume[dof[k]] += w * r * z * N[k], system.volume[dof[k] + 1] += w * r * r / 2 * D[k];
        if (!tangent || pressure == 0) continue;
        for (std::size_t k = 0; k < E::side; ++k)
          for (std::size_t l = 0; l < E::side; ++l) {
            if (k <= l) system.matrix.add(dof[k], dof[l], -pressure * w * z * N[k] * N[l]);
            system.matrix.add(dof[k], dof[l] + 1, -pressure * w * r * N[k] * D[l]);
          }
      }
    if (pressure == 0) return;
    for (std::size_t k = 0; k < mesh_.planes(); ++k)
      for (std::size_t d = 0; d < 2; ++d) {
        const std::size_t i = 2 * mesh_.node(0, k) + d;
        system.force[i] -= pressure * system.volume[i];
      }
  }

  const Mesh mesh_;
  const std::size_t n_;  ///< lanes: elements along R
  const double h_;       ///< their length
  const E element_;
  std::vector<double> radius_, over_radius_;                       ///< R and N/R: point · (node ·) lane
  std::vector<double> x_, q_, f_, C_, first_, second_, first_dp_;  ///< component-major over points · lanes
  std::vector<double> p_, a_, t_, k_, force_, g_, c_;              ///< component · lane
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
