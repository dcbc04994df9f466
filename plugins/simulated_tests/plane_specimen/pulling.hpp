// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "body.hpp"
#include "factor.hpp"
#include "tunica/test.hpp"

namespace tunica::plane {

/// The readings at every row.
struct Gauge {
  enum class Kind { stress, stretch, transverse_stretch };
  Kind kind = Kind::stress;
  Reading reading;  ///< of a stretch: 1 + Σ weight · u
  double area = 1;  ///< of a stress: width at the grips, mm, per thickness
};

/// One specimen being pulled: finds the displacements of one row after the other. Not shared between threads.
///
/// Unknown are the free displacements u and, where a gauge instead of the grips is prescribed, the pull d:
///
///     f(u, d) = 0 at the free nodes,   g(u) = its prescribed stretch
///
/// Newton's method on both; the second equation by block elimination with the factor at hand.
class Pulling {
 public:
  Pulling(const Body& body, const Model& model, std::span<const double> parameters, std::array<double, 2> along,
          bool compressible);

  /// Brings the specimen to a pull d, or to a stretch of the gauge. Steps on the way are halved where Newton fails.
  /// Empty where it arrived, else what went wrong.
  std::optional<std::string> move_to(double target, const Gauge* driver);
  /// With the stiffness at the solution: what derivatives need. False where it cannot be factored.
  bool linearise(bool by_parameters, const Gauge* driver);

  [[nodiscard]] double value(const Gauge& gauge) const;
  /// After linearise(): by the target of move_to(), and by a parameter of the model.
  [[nodiscard]] double by_target(const Gauge& gauge) const;
  [[nodiscard]] double by_parameter(const Gauge& gauge, std::size_t j) const;

  [[nodiscard]] double pull() const { return pull_; }
  [[nodiscard]] const std::vector<double>& displacements() const { return u_; }
  [[nodiscard]] const Membrane& membrane() const { return membrane_; }
  [[nodiscard]] const std::vector<std::array<double, 4>>& gradients() const { return F_; }

 private:
  static constexpr int most_iterations = 40;
  static constexpr std::size_t most_states = 4;
  static constexpr double smallest_step = 2e-3;  ///< of the way from row to row
  bool evaluate(bool with_tangent, bool with_parameters);
  bool factor();
  bool newton(double target, const Gauge* driver);
  void extrapolate(double target);
  /// −K⁻¹ of each of these, given by dof.
  [[nodiscard]] Eigen::MatrixXd solve(const Factor& factor, std::span<const std::vector<double>> of_dofs) const;
  /// Of a stretch: what these changes of the free displacements and of the pull do to it.
  [[nodiscard]] double reading(const Gauge& gauge, const Eigen::VectorXd& du, double dpull) const;
  /// The change of a gauge with these changes of the free displacements, the pull and the forces at fixed u.
  [[nodiscard]] double change(const Gauge& gauge, const Eigen::VectorXd& du, double dpull,
                              const std::vector<double>& df) const;
  [[nodiscard]] double grip_force(const std::vector<double>& f) const;

  const Body& body_;
  Membrane membrane_;
  std::vector<double> u_, f_, by_pull_;
  double pull_ = 0;
  std::vector<std::array<double, 4>> F_;
  Eigen::SparseMatrix<double> K_;
  Factor factor_;
  bool factored_ = false;
  Eigen::VectorXd along_;  ///< du/dd at the solution, by unknown
  /// At the solution.
  struct Linear {
    std::optional<Factor> factor;
    std::vector<double> by_pull;
    std::vector<std::vector<double>> by_parameters;  ///< forces at fixed u, by the model's parameters
    Eigen::VectorXd along;                           ///< du/dd, by unknown
    Eigen::MatrixXd du;                              ///< by parameters, at a fixed pull
    double slope = 1;                                ///< dd/dtarget
  } linear_;
  const Gauge* driver_ = nullptr;
  /// States that were reached, the latest last.
  struct State {
    double target, pull;
    std::vector<double> u;
  };
  std::vector<State> reached_;
};

}  // namespace tunica::plane
