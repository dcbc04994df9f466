// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/gain.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "numerics/distributions.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double extrapolated_from = 0.7;  ///< of the range of the abscissa

struct Block {
  std::string name;
  std::vector<bool> counted;  ///< rows that are fitted
};

std::vector<Block> blocks_of(const Evidence& evidence) {
  const auto rows = static_cast<std::size_t>(evidence.fit.residuals.size());
  std::vector<Block> blocks;
  const auto leave_out = [&](const std::string& name, const auto& left_out) {
    Block block{name, std::vector<bool>(rows, true)};
    std::size_t out = 0;
    for (const Curve& curve : evidence.curves)
      for (Eigen::Index i = 0; i < curve.count; ++i)
        if (left_out(curve, static_cast<std::size_t>(i))) {
          block.counted[static_cast<std::size_t>(curve.first + i)] = false;
          ++out;
        }
    // The remaining rows must determine the parameters.
    if (out > 0 && rows - out > 2 * evidence.base->layout().parameters.size()) blocks.push_back(std::move(block));
  };
  std::vector<std::string> tests;
  std::map<std::string, std::size_t> types;
  for (const Curve& curve : evidence.curves)
    if (std::find(tests.begin(), tests.end(), curve.test) == tests.end()) {
      tests.push_back(curve.test);
      ++types[evidence.experiment.test(curve.test).type];
    }
  if (tests.size() > 1)
    for (const std::string& test : tests)
      leave_out("test " + test, [&](const Curve& curve, std::size_t) { return curve.test == test; });
  if (types.size() > 1)
    for (const auto& entry : types)
      if (entry.second > 1)
        leave_out("protocol " + entry.first, [&](const Curve& curve, std::size_t) {
          return evidence.experiment.test(curve.test).type == entry.first;
        });
  leave_out("beyond 70 % of the range", [](const Curve& curve, std::size_t i) {
    const auto [low, high] = std::minmax_element(curve.abscissa.begin(), curve.abscissa.end());
    return curve.abscissa[i] > *low + extrapolated_from * (*high - *low);
  });
  return blocks;
}

/// All residuals at a fit to some of the rows, and the Jacobian by the variables.
struct Prediction {
  bool ok = false;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  double chi2 = 0;  ///< |r|² of the rows that were fitted
};

Prediction prediction_of(const assembly::Assembly& assembly, const std::vector<Variable>& variables,
                         std::span<const double> start, const std::vector<bool>& counted) {
  const auto workspace = assembly.evaluator().make_workspace();
  const Fit fit =
      least_squares(assembly, variables, start, *workspace, 60, {.counted = &counted, .negligible = says_nothing});
  Prediction prediction;
  Eigen::MatrixXd all;
  if (!fit.status.ok() || !whitened(assembly, fit.free, *workspace, prediction.residuals, &all).ok()) return prediction;
  prediction.chi2 = fit.chi2;
  prediction.jacobian.setZero(all.rows(), static_cast<Eigen::Index>(variables.size()));
  for (std::size_t k = 0; k < variables.size(); ++k) {
    if (fit.at_bound[k]) continue;  // it says nothing, and leaves a column of zeros
    for (const std::size_t member : variables[k])
      prediction.jacobian.col(static_cast<Eigen::Index>(k)) += all.col(static_cast<Eigen::Index>(member));
  }
  prediction.ok = true;
  return prediction;
}

double root_mean_square(const Eigen::VectorXd& r, const std::vector<Eigen::Index>& rows) {
  return r(rows).norm() / std::sqrt(static_cast<double>(rows.size()));
}

/// P-value of a block of n rows under the extension, uncertainty of the parameters included (Chow, Econometrica 28:591,
/// 1960): by as much as |r|² of the other rows falls when the block is left out the block disagrees with them,
///
///   |r|² of all − |r|² of the others, each at its own fit  ~  χ²(n)
///
/// In a linear model this is rᵀ(I + J C Jᵀ)⁻¹ r of the predicted block, with C = (JᵀJ)⁻¹ of the others. The
/// difference also holds where exponentials make the error of a prediction nonlinear.
double predictive_p(double all, double others, std::size_t n) {
  return numerics::chi_squared_above(std::max(all - others, 0.0), static_cast<double>(n));
}

/// Whether the rows that are fitted show what the extension adds.
bool shows(const Prediction& prediction, const FittedExtension& best, const std::vector<Eigen::Index>& in) {
  return std::all_of(best.needed.begin(), best.needed.end(), [&](std::size_t k) {
    const auto column = prediction.jacobian.col(static_cast<Eigen::Index>(k));
    return column(in).norm() >= 0.1 * column.norm();
  });
}

/// The amplitudes of a refit among its variables.
std::vector<std::size_t> amplitudes_of(const Refit& refit) {
  std::vector<std::size_t> found;
  std::size_t at = refit.extension->base().size();
  for (const Extension::Part& part : refit.extension->parts()) {
    found.push_back(at);
    at += 1 + part.nuisance.size();
  }
  return found;
}

}  // namespace

BlockVerdict verdict_of(double before, double after, double p_value) {
  constexpr double near = 2, better = 0.98, worse = 1.2;  // of σ, of the error without the extension
  constexpr double contradicts = 0.05;
  if (after < near && after < better * before) return BlockVerdict::predicted;
  const bool off = after >= near || after > worse * before;
  return off && p_value < contradicts ? BlockVerdict::not_predicted : BlockVerdict::inconclusive;
}

Gain gain_of(const Inquiry& inquiry, const Analysis& analysis, const Claim& claim) {
  const Evidence& evidence = analysis.evidence;
  const Refit& best = *claim.best;
  Gain gain;
  gain.before = evidence.fit.chi2;
  gain.after = best.fit.chi2;
  gain.expected_under_nothing = analysis.alarm.detector->gain_of_nothing();
  gain.best_rejected = claim.best_rejected;
  const std::vector<Variable> variables = best.extension->variables();
  gain.held_out =
      held_out_blocks(inquiry, evidence, {best.extension->assembly(), variables, best.fit, amplitudes_of(best)});
  return gain;
}

std::vector<HeldOut> held_out_blocks(const Inquiry& inquiry, const Evidence& evidence, const FittedExtension& best) {
  const std::vector<Block> blocks = blocks_of(evidence);
  std::vector<std::optional<HeldOut>> found(blocks.size());
  const auto done = inquiry.steps("gain on rows that were not fitted", 0.7, 0.85, blocks.size());
  const auto hold_out = [&](std::size_t b) {
    std::vector<Eigen::Index> in, out;
    for (std::size_t i = 0; i < blocks[b].counted.size(); ++i)
      (blocks[b].counted[i] ? in : out).push_back(static_cast<Eigen::Index>(i));
    const Prediction before =
        prediction_of(*evidence.base, all_variables(*evidence.base), evidence.fit.free, blocks[b].counted);
    const Prediction after = prediction_of(best.assembly, best.variables, best.fit.free, blocks[b].counted);
    if (!before.ok || !after.ok || !shows(after, best, in)) return;
    HeldOut block{blocks[b].name, root_mean_square(before.residuals, out), root_mean_square(after.residuals, out),
                  predictive_p(best.fit.chi2, after.chi2, out.size()), out.size()};
    block.verdict = verdict_of(block.before, block.after, block.p_value);
    found[b] = std::move(block);
  };
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    hold_out(b);
    done();
  });
  std::vector<HeldOut> blocks_found;
  for (auto& block : found)
    if (block) blocks_found.push_back(std::move(*block));
  return blocks_found;
}

}  // namespace tunica::diagnosis
