// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/QR>

#include "calibration/fakes.hpp"
#include "diagnosis/evidence/encompassing_noise.hpp"

namespace tunica::diagnosis {

/// Evidence that no fit has made: channels, residuals and a Jacobian as a test says.
struct HandMade : fakes::Bench {
  HandMade() { run.objective = experiment::ObjectiveType::least_squares; }

  /// Rows (x, y) of a test, the noise that the base takes, and the kind that its channel is said to have.
  experiment::TestEntry& add(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
                             const data::Noise& noise, NoiseSource::Kind kind = NoiseSource::Kind::differences) {
    auto& entry = add_test(name, x, y);
    entry.data.noise = {{"y", noise}};
    NoiseSource source{name, "y", "kPa", kind, noise};
    source.freedom = 3;
    evidence.noise.push_back(source);
    return entry;
  }

  NoiseSource& source(const std::string& name) {
    for (NoiseSource& one : evidence.noise)
      if (one.test == name) return one;
    throw std::runtime_error("no test " + name);
  }

  /// After the last test: residuals of 0, and no variables.
  void close() {
    evidence.experiment = experiment;
    evidence.run = run;
    evidence.base = std::make_shared<const assembly::Assembly>(experiment, run, shelf);
    evidence.curves = curves_of(*evidence.base, evidence.noise);
    const auto n = static_cast<Eigen::Index>(evidence.base->layout().residual_count);
    evidence.fit.residuals = Eigen::VectorXd::Zero(n);
    evidence.fit.jacobian.resize(n, 0);
  }

  [[nodiscard]] const Curve& curve(const std::string& name) const {
    for (const Curve& one : evidence.curves)
      if (one.test == name) return one;
    throw std::runtime_error("no curve " + name);
  }

  /// Of the Jacobian.
  void add_column(const Eigen::VectorXd& column, bool at_bound = false) {
    Eigen::MatrixXd& J = evidence.fit.jacobian;
    J.conservativeResize(Eigen::NoChange, J.cols() + 1);
    J.rightCols(1) = column;
    evidence.fit.at_bound.push_back(at_bound);
  }

  /// A column of all rows that is zero but in one curve.
  [[nodiscard]] Eigen::VectorXd in_curve(const std::string& name, const Eigen::VectorXd& values) const {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(evidence.fit.residuals.size());
    column.segment(curve(name).first, values.size()) = values;
    return column;
  }

  /// 1, u … of all rows that are zero but in one curve, u from −1 to 1 over its rows.
  [[nodiscard]] Eigen::MatrixXd powers(const std::string& name, Eigen::Index count) const {
    const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(curve(name).count, -1, 1);
    Eigen::MatrixXd all(evidence.fit.residuals.size(), count);
    for (Eigen::Index k = 0; k < count; ++k)
      all.col(k) = in_curve(name, u.array().pow(static_cast<double>(k)).matrix());
    return all;
  }

  /// The noise that the residuals say there is.
  [[nodiscard]] NoiseEstimate estimate(const std::vector<Eigen::VectorXd>& signatures = {}) const {
    std::vector<const Eigen::VectorXd*> pointers;
    for (const Eigen::VectorXd& one : signatures) pointers.push_back(&one);
    return encompassing_noise(evidence, evidence.fit, pointers);
  }

  Evidence evidence;
};

inline const NoiseSource& of(const NoiseEstimate& estimate, const std::string& name) {
  for (const NoiseSource& one : estimate.sources)
    if (one.test == name) return one;
  throw std::runtime_error("no source " + name);
}

/// Values between −1 and 1 that no smooth shape follows: a sine of i².
inline Eigen::VectorXd rough(Eigen::Index count, double seed) {
  const Eigen::ArrayXd i = Eigen::ArrayXd::LinSpaced(count, 0, static_cast<double>(count - 1));
  return (2.3 * i.square() + seed * (1.7 + 0.9 * i)).sin();
}

/// Errors that are largest where a rising curve is smallest, so that no likelihood lets them grow.
inline Eigen::VectorXd shrinking(Eigen::Index count, double seed) {
  return rough(count, seed).cwiseProduct(Eigen::VectorXd::LinSpaced(count, 1.5, 0.5));
}

/// 2 + 10 x: the values of a curve.
inline std::vector<double> rising(const std::vector<double>& x) {
  return fakes::map(x, [](double at) { return 2 + 10 * at; });
}

inline Eigen::MatrixXd beside(const std::vector<Eigen::MatrixXd>& parts) {
  Eigen::MatrixXd all(parts.front().rows(), 0);
  for (const Eigen::MatrixXd& part : parts) {
    all.conservativeResize(Eigen::NoChange, all.cols() + part.cols());
    all.rightCols(part.cols()) = part;
  }
  return all;
}

/// |y|² outside the columns.
inline double squares_outside(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  return (y - X * X.colPivHouseholderQr().solve(y)).squaredNorm();
}

/// Share of a direction that the columns do not hold.
inline double outside(const Eigen::MatrixXd& X, const Eigen::VectorXd& v) {
  return std::sqrt(squares_outside(X, v)) / v.norm();
}

/// One curve of n rows, σ = 0.5, and errors of a physical size.
struct OneCurve : HandMade {
  explicit OneCurve(std::size_t n, double resolution = 0) {
    const std::vector<double> x = fakes::grid(0, 1, n);
    add("s", x, rising(x), {0.5, 0, 0});
    source("s").resolution = resolution;
    close();
    evidence.fit.residuals = shrinking(static_cast<Eigen::Index>(n), 1);
  }
};

}  // namespace tunica::diagnosis
