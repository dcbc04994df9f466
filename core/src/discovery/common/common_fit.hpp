// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "discovery/set_fit.hpp"

namespace tunica::discovery {

/// One set of terms in one or several specimens, each with parameters of its own.
struct CommonFit {
  std::vector<KindPointer> kinds;  ///< sorted by name
  std::vector<SetFit> specimens;   ///< each with those of the kinds that show in it
  double log_evidence = -INFINITY;

  [[nodiscard]] double chi2() const;
  /// Of all specimens together.
  [[nodiscard]] std::size_t parameter_count() const;
  /// From nothing, and a specimen has no term yet.
  [[nodiscard]] bool lacks_a_term() const;
};

/// What the data of a specimen say of a set, without the prior of the set.
double data_evidence(const SetFit& fit, bool from_nothing);

/// Fits one set of terms to all specimens, and weighs it:
///
///   ln E = ln prior of the set + Σ_s (ln E_s − m ln 2),
///
/// m the number of terms: in each specimen a term is too weak to see, or seen, with even odds. ln E_s is that of the
/// terms that show there. For one specimen it is what a Fitter says. Const and thread-safe.
class CommonFitter {
 public:
  /// `kinds`: what is searched in each specimen, ranges and largest amplitudes its own.
  CommonFitter(std::vector<const Fitter*> fitters, const std::vector<std::vector<KindPointer>>& kinds,
               bool from_nothing);

  /// Kinds that act in half of the specimens at least, as the first one has them.
  [[nodiscard]] const std::vector<KindPointer>& kinds() const { return kinds_; }
  [[nodiscard]] const CommonFit& root() const { return root_; }

  /// Of several specimens nobody knows before the fits what a set can come to.
  [[nodiscard]] bool of_several() const { return fitters_.size() > 1; }
  /// As Fitter::growth; of one specimen only.
  [[nodiscard]] std::optional<Growth> growth(const CommonFit& from, const KindPointer& kind) const;
  /// The set with one more kind, as Fitter::grown. A specimen in which it does not show keeps what it has; none where
  /// the term shows in fewer than half of the specimens.
  [[nodiscard]] std::optional<CommonFit> grown(const CommonFit& from, const KindPointer& kind, double worth) const;
  /// The same of what growth() found.
  [[nodiscard]] std::optional<CommonFit> grown(const CommonFit& from, const KindPointer& kind, Growth growth,
                                               double worth) const;
  /// As Fitter::refitted; none where a kind is not searched here. `worth`: of one specimen only.
  [[nodiscard]] std::optional<CommonFit> refitted(const CommonFit& before, double worth = -INFINITY) const;
  /// As Fitter::with_linear.
  [[nodiscard]] std::optional<CommonFit> with_linear(const CommonFit& from, std::size_t out,
                                                     const KindPointer& linear) const;
  /// As Fitter::without; of one specimen only.
  [[nodiscard]] std::optional<CommonFit> without(const CommonFit& from, std::size_t out, double worth) const;
  /// As Fitter::distilled.
  [[nodiscard]] std::optional<CommonFit> distilled(const CommonFit& from, const KindPointer& law,
                                                   double worth = -INFINITY) const;

  /// The evidence of these specimens alone.
  [[nodiscard]] double log_evidence(const CommonFit& fit, const std::vector<std::size_t>& specimens) const;

 private:
  [[nodiscard]] KindPointer own(std::size_t specimen, const Kind& kind) const;
  [[nodiscard]] std::optional<CommonFit> weighed(CommonFit fit) const;

  std::vector<const Fitter*> fitters_;
  std::vector<std::map<std::string, KindPointer>> own_;
  std::vector<KindPointer> kinds_;
  bool from_nothing_;
  CommonFit root_;
};

}  // namespace tunica::discovery
