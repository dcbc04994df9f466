// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/remainder.hpp"

#include <algorithm>

#include <Eigen/Dense>

#include "numerics/distributions.hpp"

namespace tunica::cohort_diagnosis {

double Rest::p() const { return Q > 0 && freedom > 0 ? numerics::chi_squared_above(Q, freedom) : 1; }

Rest rest_of(const SpecimenEvidence& specimen, const std::vector<const Profile*>& causes) {
  const auto shapes = static_cast<Eigen::Index>(specimen.shapes.size());
  Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(specimen.shapes.data(), shapes);
  Rest rest{0, static_cast<double>(shapes)};
  std::vector<const Half*> halves;
  for (const Profile* cause : causes)
    if (cause->active().shown > 0) halves.push_back(&cause->active());
  if (halves.size() == 1 && halves.front()->left) {  // fitted at finite amplitude: what that leaves
    const Half& one = *halves.front();
    for (Eigen::Index k = 0; k < shapes; ++k) {
      b[k] = SpecimenEvidence::left_unit * specimen.left[*one.left][specimen.vectors + static_cast<std::size_t>(k)];
      const double c = specimen.likeness(one.vector, specimen.vectors + static_cast<std::size_t>(k));
      rest.freedom -= c * c;
    }
    rest.Q = b.squaredNorm();
    return rest;
  }
  if (!halves.empty()) {
    // Amplitudes that leave least of r along all vectors: G x = t; what they take of the shapes is C x.
    const auto count = static_cast<Eigen::Index>(halves.size());
    Eigen::MatrixXd G(count, count), C(shapes, count);
    Eigen::VectorXd t(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Half& one = *halves[static_cast<std::size_t>(i)];
      t[i] = one.shown;
      for (Eigen::Index j = 0; j < count; ++j) {
        const Half& other = *halves[static_cast<std::size_t>(j)];
        G(i, j) = one.sign * other.sign * specimen.likeness(one.vector, other.vector);
      }
      for (Eigen::Index k = 0; k < shapes; ++k)
        C(k, i) = one.sign * specimen.likeness(one.vector, specimen.vectors + static_cast<std::size_t>(k));
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(G + 1e-6 * Eigen::MatrixXd::Identity(count, count));
    b -= C * solver.solve(t);
    rest.freedom -= (C * solver.solve(C.transpose())).trace();
  }
  rest.Q = b.squaredNorm();
  return rest;
}

Rest rest_of(const Specimens& specimens, const std::vector<const Hypothesis*>& causes) {
  Rest all;
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    std::vector<const Profile*> seen;
    for (const Hypothesis* cause : causes)
      if (cause->sees[s]) seen.push_back(&cause->seen[s]);
    const Rest own = rest_of(*specimens[s], seen);
    all.Q += own.Q;
    all.freedom += own.freedom;
  }
  return all;
}

}  // namespace tunica::cohort_diagnosis
