// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/naming.hpp"

namespace tunica::diagnosis {

/// Twelve rows of one test, of which the first show these values beyond the base, and the last what no mechanism makes
/// but a smooth shape: without that, whatever is explained leaves nothing.
class Contested : public MadeUpCauses {
 public:
  static constexpr Eigen::Index size = 12;
  explicit Contested(const std::vector<double>& shown, double unlisted = 0)
      : MadeUpCauses({size}, beyond(shown, unlisted)) {}
  static Eigen::VectorXd beyond(const std::vector<double>& shown, double unlisted) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(size);
    for (std::size_t k = 0; k < shown.size(); ++k) all[static_cast<Eigen::Index>(k)] = shown[k];
    all[size - 1] = unlisted;
    return all;
  }
  static MadeUp shaped(const std::string& id, const std::vector<double>& shape) { return {id, beyond(shape, 0)}; }
  static MadeUp in_row(std::size_t k) {
    MadeUp one{"m" + std::to_string(k), at_rows(size, {{static_cast<Eigen::Index>(k), 1}})};
    return one;
  }
  /// "m0", "m1", …: one a row.
  Contested& with_rows(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) add(in_row(k));
    return *this;
  }
  /// What is left is tested by draws of noise; of a member of a group any loss is enough, unless the noise says how
  /// much is needed.
  Contested& settled(bool noise_says_what_is_needed = true) {
    close();
    const auto nothing = analysis.alarm.detector;
    calibrate_by_noise();
    if (!noise_says_what_is_needed) analysis.alarm.detector = nothing;
    analysis.alarm.shapes = {at_rows(size, {{size - 1, 1}}), {0}};
    return *this;
  }
  [[nodiscard]] Explanation named() const { return named_causes(inquiry(), analysis); }
};

/// "m0 m1": the causes that make up the best explanation.
inline std::string named_in(const Claim& claim) {
  std::string names;
  for (std::size_t k = 0; k < claim.named; ++k) names += (k == 0 ? "" : " ") + claim.causes[k].id;
  return names;
}

inline std::vector<ReasonKind> reasons_of(const Explanation& found) {
  std::vector<ReasonKind> kinds;
  for (const Reason& reason : found.reasons) kinds.push_back(reason.kind);
  return kinds;
}

}  // namespace tunica::diagnosis
