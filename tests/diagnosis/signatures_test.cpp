// SPDX-License-Identifier: Apache-2.0
// Signatures of the whole catalogue against differences of what the extension predicts.
#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/hypotheses/candidates.hpp"
#include "diagnosis/hypotheses/extension.hpp"
#include "measured.hpp"
#include "support/loaded.hpp"

namespace tunica::diagnosis {
namespace {

constexpr int levels = 5;

/// f′(0) on one side by steps h, h/2, … and Neville's extrapolation to 0; with `power` 2 the derivative by δ², of a
/// function of it.
template <class Function>
Eigen::VectorXd slope(const Function& f, const Eigen::VectorXd& at_null, double h, int power) {
  std::vector<Eigen::VectorXd> table;
  for (int k = 0; k < levels; ++k) {
    const double step = h / std::pow(2, k);
    table.push_back((f(step) - at_null) / std::pow(std::abs(step), power));
    for (int j = k - 1; j >= 0; --j) {
      const double factor = std::pow(2, power * (k - j));
      table[static_cast<std::size_t>(j)] =
          (factor * table[static_cast<std::size_t>(j + 1)] - table[static_cast<std::size_t>(j)]) / (factor - 1);
    }
  }
  return table.front();
}

// Two cyclic strips and three inflations; all that may be looked for in them, but for single rows, which are shifts.
TEST(Signatures, OfTheWholeCatalogueAreTheSlopesOfWhatTheExtensionPredicts) {
  const auto& catalogue = testing::catalogue();
  const auto experiment =
      experiment::read_experiment(TUNICA_SOURCE_DIR "/examples/hidden_effect/experiment.json", catalogue);
  const Request request = request_of(experiment);
  const Progress silent;
  const Inquiry inquiry{experiment, request, catalogue, silent};
  const Evidence evidence = evidence_of(inquiry, {});
  // At rest fibres begin to pull: a kink, of which either slope is right.
  std::vector<Eigen::Index> smooth;
  for (const Curve& curve : evidence.curves)
    for (Eigen::Index i = 0; i < curve.count; ++i)
      if (curve.abscissa[static_cast<std::size_t>(i)] != 1) smooth.push_back(curve.first + i);
  const Projection projection(interior(evidence.fit));
  std::set<std::string> seen;
  for (const Candidate& candidate : candidates(inquiry, evidence, projection))
    for (const Hypothesis& hypothesis : candidate.hypotheses) {
      if (hypothesis.at_large || hypothesis.addition.place.row) continue;
      const Extension extended(evidence.experiment, evidence.run, {hypothesis.addition}, catalogue);
      const auto workspace = extended.assembly().evaluator().make_workspace();
      const auto predicted = [&](double amplitude) {
        std::vector<double> free = extended.at_null(evidence.fit.free);
        for (const std::size_t member : extended.parts().front().amplitude)
          free[member] = extended.parts().front().null + amplitude;
        Eigen::VectorXd values;
        EXPECT_TRUE(whitened(extended.assembly(), free, *workspace, values, nullptr).ok()) << candidate.id;
        return values;
      };
      const MechanismFactory& mechanism = *hypothesis.mechanism;
      const bool even = hypothesis.side == MechanismFactory::Side::even;
      const bool upwards = hypothesis.sign > 0 && mechanism.plausible_max > mechanism.null;
      const double reach =
          upwards ? mechanism.plausible_max - mechanism.null : mechanism.plausible_min - mechanism.null;
      // No further than what changes the residuals by one σ in all, for some grow as exponentials; and as near as what
      // passes no kink, for fibres that are taken up late.
      const double largest = even ? 1 / std::sqrt(hypothesis.signature.norm()) : 1 / hypothesis.signature.norm();
      const double sign = even || upwards || hypothesis.sign < 0 ? 1 : -1;
      double off = INFINITY;
      for (const double share : {1.0, 0.1, 0.01, 0.001}) {
        const double h = share * std::copysign(std::min(0.01 * std::abs(reach), largest), reach);
        const Eigen::VectorXd expected = sign * slope(predicted, predicted(0), h, even ? 2 : 1);
        off = std::min(off, (hypothesis.signature - expected)(smooth).norm() / hypothesis.signature.norm());
      }
      EXPECT_LT(off, 1e-6) << candidate.id << ' ' << hypothesis.addition.place.words();
      seen.insert(candidate.id);
    }
  // Those that leave a trace there: all but what tubes without layers, or strips, cannot show.
  // `added_term` is for discovery, `damage` is not looked for, errors of the record are weighed in the group `file`,
  // tubes carry no `compressibility`, `clamped_ends` needs sizes that this file does not say, and five are of fields.
  const auto of_the_record = std::count_if(catalogue.mechanisms().begin(), catalogue.mechanisms().end(),
                                           [](const auto& one) { return one.second.factory.question_only; });
  EXPECT_EQ(seen.size(), catalogue.mechanisms().size() - 9 - static_cast<std::size_t>(of_the_record));
}

}  // namespace
}  // namespace tunica::diagnosis
