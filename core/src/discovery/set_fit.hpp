// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/evidence/projection.hpp"
#include "discovery/bound_set.hpp"

namespace tunica::discovery {

/// A set of terms at its best fit, or the base without any.
struct SetFit {
  std::vector<KindPointer> kinds;
  std::shared_ptr<const BoundSet> set;  ///< null: from nothing, and no term yet
  diagnosis::Fit fit;
  double log_evidence = -INFINITY;  ///< with the prior of the set

  [[nodiscard]] double chi2() const { return fit.chi2; }
  /// Whether a term acts along directions.
  [[nodiscard]] bool has_fibres() const {
    return std::ranges::any_of(kinds, [](const KindPointer& kind) { return !kind->isotropic(); });
  }
  /// By evidence and by at least a tenth of |r|² beyond noise.
  [[nodiscard]] bool is_clearly_better_than(const SetFit& other) const {
    constexpr double clear = 10, much = 0.1;
    const auto beyond_noise = [](const SetFit& one) {
      return one.chi2() - static_cast<double>(one.fit.residuals.size());
    };
    return log_evidence > other.log_evidence + clear && beyond_noise(*this) < (1 - much) * beyond_noise(other);
  }
  [[nodiscard]] std::size_t parameter_count() const { return set ? set->assembly().layout().parameters.size() : 0; }
};

/// What the linearisation promises of a term: amplitude, fall of |r|², and its signature.
struct Promise {
  std::vector<double> shapes;
  double amplitude = 0, gain = 0;
  Eigen::VectorXd signature;
};

/// A set with one more kind before it is fitted.
struct Growth {
  SetFit larger;
  std::size_t own;                ///< the place of the kind in the larger set
  std::vector<Promise> promises;  ///< of its best first shapes, largest gain first
  double most;                    ///< that ln of the evidence can come to
};

/// What a fit of a set may cost.
struct Effort {
  std::size_t evaluations = 60;  ///< from a start
  std::size_t starts = 2;        ///< of a kind with shapes, until a fit takes what the linearisation promises
};

/// Fits sets of terms and weighs them. Const and thread-safe.
class Fitter {
 public:
  /// `evidence`: of the base; from nothing of one neo-Hookean term.
  Fitter(const Subject& subject, const diagnosis::Evidence& evidence, Effort effort = {});

  /// The base alone, or nothing: what every set grows from. After begin_with() the first terms of a material that
  /// changes its volume, of which no single term holds a specimen together.
  [[nodiscard]] const SetFit& root() const { return root_; }
  /// Before a search from nothing; `kinds` are those that are searched. Throws InputError where a first term is not
  /// among them, or cannot be fitted.
  void begin_with(const std::vector<KindPointer>& kinds);

  /// The set without one of its terms, fitted again; none where it cannot be fitted.
  [[nodiscard]] std::optional<SetFit> without(const SetFit& from, std::size_t out, double worth = -INFINITY) const;

  /// The set with one more kind and what a fit of it can come to; none where the term has nothing to do, and where no
  /// start can be evaluated.
  [[nodiscard]] std::optional<Growth> growth(const SetFit& from, const KindPointer& kind) const;

  /// The set with one more kind: from where the smaller set ended, with the amplitude that the linearisation promises
  /// at the best of the kind's first shapes. None where the term has nothing to do, where no start can be evaluated,
  /// where a shape ends at its bound, and where the evidence cannot come to `worth`.
  [[nodiscard]] std::optional<SetFit> grown(const SetFit& from, const KindPointer& kind, double worth) const;
  /// The same of what growth() found.
  [[nodiscard]] std::optional<SetFit> grown(const SetFit& from, Growth growth, double worth) const;

  /// The set with the term `out`, of powers of the stretches, as the linear law that its exponent is close to: μ α/2 is
  /// the modulus at rest, λ² that of I1 and λ⁻² that of I2. None where it cannot be fitted.
  [[nodiscard]] std::optional<SetFit> with_linear(const SetFit& from, std::size_t out, const KindPointer& linear) const;

  /// The set in which one law takes the place of all terms of its invariant: a fit begins where the law comes closest
  /// to what they add to dψ/dx. None where it cannot be fitted; a fit ends early where its evidence cannot come to
  /// `worth`.
  [[nodiscard]] std::optional<SetFit> distilled(const SetFit& from, const KindPointer& law,
                                                double worth = -INFINITY) const;

  /// A set that was fitted to the same rows with another noise, from where that ended. None where it cannot be fitted;
  /// a fit ends early where its evidence cannot come to `worth`.
  [[nodiscard]] std::optional<SetFit> refitted(const SetFit& before, const std::vector<KindPointer>& kinds,
                                               double worth = -INFINITY) const;

  /// ln of the evidence of a fit with its prior: Laplace's approximation,
  ///
  ///   ln E = −|r|²/2 − ½ ln det(I + W JᵀJ W) + ln prior of the set,
  ///
  /// J by the coordinates of the search, for amplitudes by their logarithm, W their prior standard deviations: those of
  /// a Gaussian as high as the uniform prior. Amplitudes are uniform in the logarithm from an effect of σ to all that
  /// is measured.
  [[nodiscard]] double log_evidence(const SetFit& fit) const;

  /// The largest amplitude that is looked for: an effect of several times all that is measured.
  [[nodiscard]] double largest_amplitude(const Kind& kind) const;

 private:
  /// Bound to the data, sorted by name; none where a term cannot act there.
  [[nodiscard]] std::optional<SetFit> bound(std::vector<KindPointer> kinds) const;
  [[nodiscard]] std::vector<double> start_of(const SetFit& from, const BoundSet& set) const;
  /// Whether every term shows in a tenth of the rows at least: a steep one can fit a single last point.
  [[nodiscard]] bool has_support(const SetFit& fit) const;
  /// Fitted from a start; none where it cannot be evaluated, or where a term has nothing to do or leaves its range.
  [[nodiscard]] std::optional<SetFit> fitted(SetFit set, const std::vector<double>& start,
                                             double worth = -INFINITY) const;

  const Subject& subject_;
  const diagnosis::Evidence& evidence_;
  Effort effort_;
  SetFit root_;
  double measured_ = 1;  ///< √Σ(y/σ)²
};

/// All combinations of the first shapes of a kind.
std::vector<std::vector<double>> combinations(const Kind& kind);

/// ln of the prior of a set: each further term is in one data set of ten beside a base and in one of two from nothing;
/// the order in which terms are listed says nothing.
double log_prior(const std::vector<KindPointer>& kinds, bool from_nothing);

}  // namespace tunica::discovery
