// SPDX-License-Identifier: Apache-2.0
// Fung, Fronek, Patitucci (1979), Am. J. Physiol. 237:H620–H631: an exponential of a quadratic form in the
// Green–Lagrange strains E = (C − 1)/2 of the wall,
//
//   W = c/2 (e^Q − 1),   Q = a1 E_tt² + a2 E_zz² + 2 a4 E_tt E_zz,
//
// and with radial strain (Chuong, Fung 1983, J. Biomech. Eng. 105:268–274)
//
//   Q += a3 E_rr² + 2 a5 E_zz E_rr + 2 a6 E_rr E_tt.
//
// Shear (Humphrey 1995, Crit. Rev. Biomed. Eng. 23:1–162) adds 2 a7 E_tz² + 2 a8 E_zr² + 2 a9 E_tr². Where a7 to a9 are
// no parameters, each is what isotropy in its plane would ask for: a7 = (a1 + a2)/2 − a4, and so on. They are positive
// where Q is positive definite.
//
// The material is incompressible: tests add a pressure, so that `plane` needs no radial strain. Where a1 = a2 = 2 a4 it
// is isotropic for small strains.
//
// Derivatives are written out and not taken by JointEnergy: on Taylor numbers of ten parameters and six invariants this
// file would compile for three minutes.
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Core>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

enum class Form { plane, wall, wall_with_shear };
/// c and the nine coefficients; `plane` has parameters for c, a1, a2 and a4 only, `wall` for those up to a6.
enum Coefficient { c, a1, a2, a3, a4, a5, a6, a7, a8, a9, coefficients };
/// Strains in the order of tensors: tt, zz, rr, tz, zr, tr.
constexpr Eigen::Index strains = 6;
using Strain = Eigen::Matrix<double, strains, 1>;
using ByParameters = Eigen::Matrix<double, strains, Eigen::Dynamic, Eigen::ColMajor, strains, coefficients>;

/// The entry of K that a coefficient is, where Q = EᵀKE. In shear it is twice the coefficient.
constexpr std::array<std::pair<int, int>, coefficients> entry{
    {{}, {0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}, {3, 3}, {4, 4}, {5, 5}}};
constexpr double factor(int coefficient) { return coefficient < a7 ? 1 : 2; }

const char *const fung_1979 = "Fung, Fronek, Patitucci, Am. J. Physiol. 237:H620 (1979)",
                  *const chuong_fung = "Chuong, Fung, J. Biomech. Eng. 105:268 (1983)",
                  *const humphrey = "Humphrey, Crit. Rev. Biomed. Eng. 23:1 (1995)";

std::vector<Parameter> parameters_of(Form form) {
  const auto square = [](const char* name, double initial, const char* doc, const char* source) {
    return Parameter{name, "1", initial, 1e-3, 100, Scale::log, doc, source};
  };
  const auto product = [](const char* name, const char* doc, const char* source) {
    return Parameter{name, "1", 0.1, -10, 100, Scale::linear, doc, source};
  };
  std::vector<Parameter> all{{"c", "kPa", 20, 0.01, 1e4, Scale::log, "Stiffness of the exponential.", fung_1979},
                             square("a1", 1, "Weight of E_tt^2.", fung_1979),
                             square("a2", 0.5, "Weight of E_zz^2.", fung_1979)};
  if (form != Form::plane) all.push_back(square("a3", 0.1, "Weight of E_rr^2.", chuong_fung));
  all.push_back(product("a4", "Half the weight of E_tt E_zz.", fung_1979));
  if (form == Form::plane) return all;
  all.push_back(product("a5", "Half the weight of E_zz E_rr.", chuong_fung));
  all.push_back(product("a6", "Half the weight of E_rr E_tt.", chuong_fung));
  if (form == Form::wall) return all;
  all.push_back(square("a7", 1, "Half the weight of E_tz^2.", humphrey));
  all.push_back(square("a8", 1, "Half the weight of E_zr^2.", humphrey));
  all.push_back(square("a9", 1, "Half the weight of E_tr^2.", humphrey));
  return all;
}

/// Coefficients by parameters, a constant matrix: a = L p.
Eigen::MatrixXd coefficients_by(Form form) {
  const std::vector<int> own = form == Form::plane  ? std::vector<int>{c, a1, a2, a4}
                               : form == Form::wall ? std::vector<int>{c, a1, a2, a3, a4, a5, a6}
                                                    : std::vector<int>{c, a1, a2, a3, a4, a5, a6, a7, a8, a9};
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(coefficients, static_cast<Eigen::Index>(own.size()));
  for (std::size_t j = 0; j < own.size(); ++j) L(own[j], static_cast<Eigen::Index>(j)) = 1;
  if (form == Form::wall_with_shear) return L;
  // a7 = (a1 + a2)/2 − a4, a8 = (a2 + a3)/2 − a5, a9 = (a3 + a1)/2 − a6
  L.row(a7) = 0.5 * (L.row(a1) + L.row(a2)) - L.row(a4);
  L.row(a8) = 0.5 * (L.row(a2) + L.row(a3)) - L.row(a5);
  L.row(a9) = 0.5 * (L.row(a3) + L.row(a1)) - L.row(a6);
  return L;
}

/// Q is positive definite in the normal strains: its leading minors.
std::vector<Combination> admissible(Form form) {
  const bool plane = form == Form::plane;
  const auto minor = [plane](std::span<const double> p) {
    const double product = p[plane ? 3 : a4];
    return p[a1] * p[a2] - product * product;
  };
  std::vector<Combination> all{{"a1 a2 - a4^2", "1", {a1, a2, plane ? 3u : 4u}, minor, ""}};
  if (!plane)
    all.push_back({"det of a1 to a6",
                   "1",
                   {a1, a2, a3, a4, a5, a6},
                   [minor](std::span<const double> p) {
                     return p[a3] * minor(p) - p[a1] * p[a5] * p[a5] - p[a2] * p[a6] * p[a6] +
                            2 * p[a4] * p[a5] * p[a6];
                   },
                   ""});
  return all;
}

class Fung final : public Model {
 public:
  explicit Fung(Form form) : by_(coefficients_by(form)) {
    description_.type = "fung";
    description_.parameters = parameters_of(form);
    description_.principal_axes = true;
    description_.energy_derivatives = true;
    description_.admissible = admissible(form);
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  /// With F = KE, e = c e^Q and w = 1 for normal, 1/2 for shear components, whose C_ab stands twice in a tensor,
  ///
  ///   S_a = w_a e F_a,   2 ∂S_a/∂C_b = w_a w_b e (K_ab + 2 F_a F_b).
  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const Material material(*this, points.parameters);
    const std::size_t n = points.count;
    for (std::size_t i = 0; i < n; ++i) {
      Strain E;
      for (Eigen::Index a = 0; a < strains; ++a) E[a] = 0.5 * (points.C[a * n + i] - (a < 3 ? 1 : 0));
      const Strain F = material.K * E;
      const double e = material.c * std::exp(E.dot(F));
      if (!out.energy.empty()) out.energy[i] = 0.5 * material.c * std::expm1(E.dot(F));
      for (Eigen::Index a = 0; !out.stress.empty() && a < strains; ++a) out.stress[a * n + i] = weight(a) * e * F[a];
      for (Eigen::Index a = 0; !out.tangent.empty() && a < strains; ++a)
        for (Eigen::Index b = 0; b < strains; ++b)
          out.tangent[(6 * a + b) * n + i] = weight(a) * weight(b) * e * (material.K(a, b) + 2 * F[a] * F[b]);
      if (out.stress_dp.empty()) continue;
      const ByParameters S_p = material.gradient_by_parameters(E, F, e, by_);
      for (Eigen::Index j = 0; j < S_p.cols(); ++j)
        for (Eigen::Index a = 0; a < strains; ++a) out.stress_dp[(6 * j + a) * n + i] = weight(a) * S_p(a, j);
    }
    return {};
  }

  /// ∂W/∂c_a = S_aa/2, and ∂²W/∂c_a∂c_b = 2 ∂S_aa/∂c_b / 4.
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    constexpr std::array<std::pair<int, int>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
    const Material material(*this, points.parameters);
    const std::size_t n = points.count;
    for (std::size_t i = 0; i < n; ++i) {
      Strain E = Strain::Zero();
      for (Eigen::Index a = 0; a < 3; ++a) E[a] = 0.5 * (points.c[a * n + i] - 1);
      const Strain F = material.K * E;
      const double e = material.c * std::exp(E.dot(F));
      if (!out.energy.empty()) out.energy[i] = 0.5 * material.c * std::expm1(E.dot(F));
      for (Eigen::Index a = 0; !out.gradient.empty() && a < 3; ++a) out.gradient[a * n + i] = 0.5 * e * F[a];
      for (std::size_t k = 0; !out.hessian.empty() && k < pairs.size(); ++k) {
        const auto [a, b] = pairs[k];
        out.hessian[k * n + i] = 0.25 * e * (material.K(a, b) + 2 * F[a] * F[b]);
      }
      if (!out.energy_dp.empty()) {
        const Eigen::VectorXd W_p = material.energy_by_parameters(E, e, by_);
        for (Eigen::Index j = 0; j < W_p.size(); ++j) out.energy_dp[j * n + i] = W_p[j];
      }
      if (out.gradient_dp.empty()) continue;
      const ByParameters S_p = material.gradient_by_parameters(E, F, e, by_);
      for (Eigen::Index j = 0; j < S_p.cols(); ++j)
        for (Eigen::Index a = 0; a < 3; ++a) out.gradient_dp[(3 * j + a) * n + i] = 0.5 * S_p(a, j);
    }
    return {};
  }

 private:
  static double weight(Eigen::Index component) { return component < 3 ? 1 : 0.5; }

  /// The values of the parameters.
  struct Material {
    double c;
    Eigen::Matrix<double, strains, strains> K = Eigen::Matrix<double, strains, strains>::Zero();

    Material(const Fung& model, std::span<const double> p) {
      const Eigen::VectorXd a = model.by_ * Eigen::Map<const Eigen::VectorXd>(p.data(), model.by_.cols());
      c = a[Coefficient::c];
      for (int m = a1; m < coefficients; ++m) {
        const auto [row, column] = entry[m];
        K(row, column) = K(column, row) = factor(m) * a[m];
      }
    }
    /// ∂Q/∂a of the nine coefficients.
    [[nodiscard]] Eigen::Matrix<double, coefficients, 1> monomials(const Strain& E) const {
      Eigen::Matrix<double, coefficients, 1> q;
      q[Coefficient::c] = 0;
      for (int m = a1; m < coefficients; ++m) {
        const auto [row, column] = entry[m];
        q[m] = (row == column ? factor(m) : 2) * E[row] * E[column];
      }
      return q;
    }
    /// ∂W/∂c = (e^Q − 1)/2,   ∂W/∂a = e/2 ∂Q/∂a
    [[nodiscard]] Eigen::VectorXd energy_by_parameters(const Strain& E, double e, const Eigen::MatrixXd& by) const {
      Eigen::Matrix<double, coefficients, 1> W_a = 0.5 * e * monomials(E);
      W_a[Coefficient::c] = 0.5 * (e / c - 1);
      return by.transpose() * W_a;
    }
    /// ∂(eF)/∂c = eF/c,   ∂(eF)/∂a = e (∂K/∂a E + F ∂Q/∂a)
    [[nodiscard]] ByParameters gradient_by_parameters(const Strain& E, const Strain& F, double e,
                                                      const Eigen::MatrixXd& by) const {
      Eigen::Matrix<double, strains, coefficients> D = e * F * monomials(E).transpose();
      D.col(Coefficient::c) = e / c * F;
      for (int m = a1; m < coefficients; ++m) {
        const auto [row, column] = entry[m];
        D(row, m) += e * factor(m) * E[column];
        if (row != column) D(column, m) += e * E[row];
      }
      return D * by;
    }
  };

  ModelDescription description_;
  Eigen::MatrixXd by_;  ///< L
};

}  // namespace

TUNICA_PLUGIN("fung", TUNICA_PLUGIN_VERSION) {
  const Option choice = Option::choice(
      "form", {"plane", "wall", "wall_with_shear"}, "plane",
      "Strains with parameters: in the plane (a1, a2, a4), radial ones too (to a6), all with shear (to a9).");
  const auto create = [](const Options& options) -> std::unique_ptr<Model> {
    const std::string& form = options.text("form");
    return std::make_unique<Fung>(form == "wall"              ? Form::wall
                                  : form == "wall_with_shear" ? Form::wall_with_shear
                                                              : Form::plane);
  };
  registry.add(ModelFactory{
      "fung", "Artery wall, an exponential of a quadratic form in Green strains.", fung_1979, {choice}, create});
}
