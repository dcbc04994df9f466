// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/measured.hpp"
#include "discovery/history.hpp"

namespace tunica::trial {

/// Tests that the base describes; who looks for path dependence chooses the residuals.
class PathsOf {
 public:
  /// Strips of a wall.
  explicit PathsOf(std::vector<Strip> strips) {
    const Measured measured(std::move(strips));
    measured.measure(31);
    evidence_of(measured);
  }
  /// What is written into the experiment and its folder first.
  explicit PathsOf(const std::function<void(Measured& measured)>& write) {
    Measured measured;
    write(measured);
    evidence_of(measured);
  }

  /// `of(test, row, stretch)`
  using Of = std::function<double(const std::string& test, std::size_t row, double stretch)>;
  [[nodiscard]] discovery::PathDependence with(const Of& of) const {
    diagnosis::Fit fit = evidence_.fit;
    for (const diagnosis::Curve& curve : evidence_.curves)
      for (std::size_t i = 0; i < curve.abscissa.size(); ++i)
        fit.residuals[curve.first + static_cast<Eigen::Index>(i)] = of(curve.test, i, curve.abscissa[i]);
    fit.chi2 = fit.residuals.squaredNorm();
    return discovery::path_dependence(evidence_, fit);
  }
  [[nodiscard]] double rows() const { return static_cast<double>(evidence_.fit.residuals.size()); }

 private:
  void evidence_of(const Measured& measured) {
    const experiment::Experiment read = measured.read();
    const diagnosis::Request request = diagnosis::request_of(read);
    const diagnosis::Progress silent;
    evidence_ = diagnosis::evidence_of({read, request, testing::catalogue(), silent}, {});
  }

  diagnosis::Evidence evidence_;
};

}  // namespace tunica::trial
