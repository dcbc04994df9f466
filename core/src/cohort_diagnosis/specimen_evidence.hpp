// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cohort_diagnosis/outlines.hpp"
#include "cohort_diagnosis/profile.hpp"
#include "diagnosis/diagnosis.hpp"

/// The combined evidence of several specimens about errors of the simulation: docs/cohort_diagnosis.md.
namespace tunica::cohort_diagnosis {

/// Cosines between unit vectors, in hundred-thousandths: a triangle by rows, without its diagonal.
class Likeness {
 public:
  Likeness() = default;
  explicit Likeness(std::vector<std::int32_t> triangle) : triangle_(std::move(triangle)) {}
  static constexpr double unit = 1e-5;
  [[nodiscard]] double operator()(std::size_t i, std::size_t j) const {
    if (i == j) return 1;
    if (i < j) std::swap(i, j);
    return unit * static_cast<double>(triangle_[i * (i - 1) / 2 + j]);
  }
  [[nodiscard]] const std::vector<std::int32_t>& triangle() const { return triangle_; }
  bool operator==(const Likeness&) const = default;

 private:
  std::vector<std::int32_t> triangle_;
};

/// A mechanism as the specimen's own diagnosis ranks it.
struct OwnRank {
  std::string id;
  double probability = 0;
  bool operator==(const OwnRank&) const = default;
};

/// All that a cohort needs to know of one specimen. It does not grow with the number of rows.
struct SpecimenEvidence {
  std::string id;
  double p_value = 1;  ///< of the calibrated alarm
  bool alarm = false;
  diagnosis::Verdict verdict = diagnosis::Verdict::nothing_detected;
  std::vector<std::string> causes;              ///< of its best explanation
  std::vector<std::string> ambiguity_set;       ///< of its own claim
  std::vector<std::vector<std::string>> pairs;  ///< that were weighed and stayed in its set, likeliest first
  std::vector<OwnRank> ranking;                 ///< of the likeliest singles; empty without an alarm
  double p_after = 1;                           ///< of what its own explanation leaves
  std::size_t rows = 0;
  double squares = 0;             ///< |r|² of the base fit
  double rms = 0, rms_upper = 0;  ///< of its misfit beyond noise, as a share of the range; the bound has 95 %
  double tolerance = 0.02;        ///< what the specimen's own file says of it
  diagnosis::Tolerance::Origin tolerance_origin = diagnosis::Tolerance::Origin::standard;
  std::vector<Outline> outlines;
  std::vector<Profile> profiles;
  std::vector<double> shapes;  ///< b = B̃ᵀr of smooth shapes; their vectors stand behind those of the profiles
  std::size_t vectors = 0;     ///< of profiles
  Likeness likeness;           ///< of all vectors
  /// What refits leave of the residuals along all vectors, in thousandths of σ.
  std::vector<std::vector<std::int32_t>> left;

  bool operator==(const SpecimenEvidence&) const = default;
  static constexpr double left_unit = 1e-3;
};

/// From a diagnosis that is there: every mechanism that scores is fitted again at finite amplitude, its nuisance
/// parameters held. Rows that are outliers enter only where their score is above 6, among them those that the diagnosis
/// left out as gross errors. Deterministic for any number of
/// threads.
SpecimenEvidence evidence_of(std::string id, const experiment::Experiment& experiment,
                             const diagnosis::Diagnosis& diagnosis, const plugins::Catalogue& catalogue);

/// Diagnoses the specimen first. Throws as diagnose() does.
SpecimenEvidence evidence_of(std::string id, const experiment::Experiment& experiment,
                             const diagnosis::Request& request, const plugins::Catalogue& catalogue);

/// ln of the marginal weight of a mechanism in this specimen alone, as its own diagnosis weighs it: the mean over its
/// places and settings of exp(gain/2) · {1 two-sided, 2Φ(t) one-sided}; −∞ where it leaves no trace.
double own_log_weight(const SpecimenEvidence& specimen, const std::string& id);

}  // namespace tunica::cohort_diagnosis
