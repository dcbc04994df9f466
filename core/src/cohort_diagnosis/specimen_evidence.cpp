// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/specimen_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <tbb/parallel_for.h>

#include "diagnosis/hypotheses/places.hpp"
#include "diagnosis/naming/refits.hpp"
#include "diagnosis/naming/singles.hpp"

namespace tunica::cohort_diagnosis {
namespace {

using diagnosis::Analysis;
using diagnosis::Direction;
using diagnosis::Inquiry;
using Side = MechanismFactory::Side;

constexpr double worth_a_refit = 4;        ///< of T
constexpr double plain_effect = 25;        ///< of the gain, from which nuisance parameters are fitted too
constexpr double freedom_of_nuisance = 3;  ///< of the gain: what their fit has to be worth
constexpr double row_score = 6;            ///< of T, from which a single row is kept
constexpr std::size_t most_rows = 12;
constexpr double shape_left = 0.01;  ///< of a smooth shape, below which a refit absorbs it

/// A half before its refit, and where that begins.
struct Draft {
  Half half;
  Eigen::VectorXd along;  ///< the unit vector
  double start = 0;       ///< signed amplitude, of even mechanisms its square; 0: no refit is worth while
  double start_gain = 0;
  Eigen::VectorXd rest;  ///< residuals that its refit leaves
};

struct Sketch {
  Profile profile;
  std::size_t candidate;
  diagnosis::Addition addition;
  std::array<std::optional<Draft>, 2> halves;  ///< up, down
};

class Gathering {
 public:
  Gathering(const Inquiry& inquiry, const Analysis& analysis)
      : inquiry_(inquiry), analysis_(analysis), residuals_(-analysis.evidence.fit.residuals) {}

  std::vector<Sketch> sketches() {
    std::vector<Sketch> all = tangents();
    look_at_large(all);
    std::vector<std::pair<std::size_t, std::size_t>> jobs;
    for (std::size_t k = 0; k < all.size(); ++k)
      for (std::size_t h = 0; h < 2; ++h)
        if (all[k].halves[h] && all[k].halves[h]->start != 0) jobs.emplace_back(k, h);
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t j) {
      Sketch& sketch = all[jobs[j].first];
      refit(sketch, *sketch.halves[jobs[j].second], jobs[j].second == 0 ? 1 : -1, diagnosis::Nuisance::held);
    });
    free_nuisances(all);
    return all;
  }

 private:
  /// One sketch for each place and setting, with what the tangents at the null say.
  std::vector<Sketch> tangents() {
    std::vector<Sketch> all;
    const diagnosis::Hypotheses& hypotheses = analysis_.hypotheses;
    const std::vector<std::size_t> rows = rows_worth_keeping();
    for (std::size_t k = 0; k < hypotheses.directions.size(); ++k) {
      const Direction& direction = hypotheses.directions[k];
      const diagnosis::Hypothesis& hypothesis = hypotheses.hypothesis(k);
      // Specimens of a cohort share hypotheses, but not loading rates: a test without a clock counts as slow.
      if (hypothesis.at_large || hypothesis.addition.pace) continue;
      if (direction.row && std::find(rows.begin(), rows.end(), k) == rows.end()) continue;
      Sketch& sketch = sketch_of(all, direction.candidate, hypothesis);
      const double t = direction.unit.dot(residuals_);
      const auto draft = [&](double sign, bool refits) {
        Draft one{{sign * t, direction.length, 0, 1, false, false, sign * t, {}}, sign * direction.unit, 0, 0, {}};
        if (refits && sign * t > 0 && t * t >= worth_a_refit) {
          one.start_gain = t * t;
          one.start = direction.sign * t / direction.length;
        }
        return one;
      };
      const bool refits = !direction.row && hypothesis.mechanism->stage != Stage::data;
      if (direction.side == Side::both) {
        sketch.halves = {draft(1, refits), draft(-1, refits)};
      } else {
        sketch.halves[direction.sign > 0 ? 0 : 1] = draft(1, refits);
      }
    }
    return all;
  }

  [[nodiscard]] std::vector<std::size_t> rows_worth_keeping() const {
    std::vector<std::pair<double, std::size_t>> rows;
    const auto& directions = analysis_.hypotheses.directions;
    for (std::size_t k = 0; k < directions.size(); ++k)
      if (directions[k].row)
        if (const double T = diagnosis::score(directions[k], residuals_).T; T > row_score) rows.emplace_back(-T, k);
    std::sort(rows.begin(), rows.end());
    rows.resize(std::min(rows.size(), most_rows));
    std::vector<std::size_t> kept;
    for (const auto& [minus_T, k] : rows) kept.push_back(k);
    return kept;
  }

  Sketch& sketch_of(std::vector<Sketch>& all, std::size_t candidate, const diagnosis::Hypothesis& hypothesis) {
    Profile profile;
    profile.id = hypothesis.addition.id;
    profile.place = hypothesis.addition.place;
    profile.setting = hypothesis.addition.setting;
    profile.amplitude = hypothesis.mechanism->parameters.front().name;
    profile.unit = hypothesis.mechanism->parameters.front().unit;
    profile.null = hypothesis.mechanism->null;
    profile.even = hypothesis.mechanism->side == Side::even;
    const auto [found, fresh] = index_.try_emplace(profile.key(), all.size());
    if (fresh) all.push_back({std::move(profile), candidate, hypothesis.addition, {}});
    return all[found->second];
  }

  /// Where the secant at a large amplitude sees more than the tangent does, the refit begins there.
  void look_at_large(std::vector<Sketch>& all) {
    const diagnosis::Hypotheses& hypotheses = analysis_.hypotheses;
    for (std::size_t k = 0; k < hypotheses.directions.size(); ++k) {
      const Direction& direction = hypotheses.directions[k];
      const diagnosis::Hypothesis& hypothesis = hypotheses.hypothesis(k);
      if (!hypothesis.at_large || hypothesis.addition.pace) continue;
      Profile like;
      like.id = hypothesis.addition.id;
      like.place = hypothesis.addition.place;
      like.setting = hypothesis.addition.setting;
      const auto found = index_.find(like.key());
      if (found == index_.end()) continue;  // the tangent is absorbed
      std::optional<Draft>& half = all[found->second].halves[direction.sign > 0 ? 0 : 1];
      if (!half) continue;
      const auto [T, amplitude] = diagnosis::score(direction, residuals_);
      if (T < worth_a_refit || T <= half->start_gain) continue;
      half->start_gain = T;
      half->start = amplitude;
    }
  }

  /// Where the effect is plain, the nuisance parameters may lie between those that were tried: one more hypothesis, in
  /// which every specimen has its own. What it gains has to be worth its freedom.
  void free_nuisances(std::vector<Sketch>& all) {
    struct Best {
      std::size_t sketch = 0, half = 0;
      double gain = 0;
    };
    std::map<std::string, Best> by_place;
    for (std::size_t k = 0; k < all.size(); ++k)
      for (std::size_t h = 0; h < 2; ++h) {
        const MechanismFactory& mechanism = *analysis_.hypotheses.candidates[all[k].candidate].mechanism;
        const std::optional<Draft>& draft = all[k].halves[h];
        if (!draft || !draft->half.refitted || all[k].profile.setting.empty() || mechanism.parameters.size() < 2)
          continue;
        Best& best = by_place[all[k].profile.key_of_place()];
        if (draft->half.t * draft->half.t > best.gain) best = {k, h, draft->half.t * draft->half.t};
      }
    std::vector<Best> jobs;
    for (const auto& [place, best] : by_place)
      if (best.gain > plain_effect) jobs.push_back(best);
    std::vector<std::optional<Sketch>> found(jobs.size());
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t j) {
      Sketch sketch = all[jobs[j].sketch];
      const double side = jobs[j].half == 0 ? 1 : -1;
      Draft& draft = *sketch.halves[jobs[j].half];
      draft.start = side * draft.half.t / draft.half.length;
      if (sketch.profile.even) draft.start = std::abs(draft.start);
      draft.half.t = 0;
      refit(sketch, draft, side, diagnosis::Nuisance::fitted);
      const double left = draft.half.t * draft.half.t - freedom_of_nuisance;
      if (left < jobs[j].gain) return;
      const double distance = draft.half.t / draft.half.length;
      draft.half.t = std::sqrt(left);
      draft.half.length = draft.half.t / distance;
      sketch.profile.setting.clear();
      found[j] = std::move(sketch);
    });
    for (std::optional<Sketch>& one : found)
      if (one) all.push_back(std::move(*one));
  }

  /// The parabola through the null and the fit at finite amplitude, where that lies on this side.
  void refit(const Sketch& sketch, Draft& draft, double side, diagnosis::Nuisance nuisance) const {
    const diagnosis::Fit& base = analysis_.evidence.fit;
    const auto found =
        diagnosis::fit_with(inquiry_, analysis_, {sketch.addition}, std::array{draft.start}, nullptr, nuisance);
    if (!found) return;
    const auto& part = found->extension->parts().front();
    const double amplitude = found->fit.free[part.amplitude.front()] - part.null;
    const double distance = sketch.profile.even ? amplitude * amplitude : side * amplitude;
    const double gain = base.chi2 - found->fit.chi2;
    if (!(gain > 0) || !(distance > 0)) return;
    const Eigen::VectorXd moved = analysis_.hypotheses.projection.off(found->fit.residuals - base.residuals);
    if (!(moved.norm() > 0)) return;
    draft.along = moved / moved.norm();
    draft.half.t = std::sqrt(gain);
    draft.half.length = draft.half.t / distance;
    draft.half.refitted = true;
    draft.half.shown = draft.along.dot(residuals_);
    draft.rest = -found->fit.residuals;
  }

  const Inquiry& inquiry_;
  const Analysis& analysis_;
  const Eigen::VectorXd residuals_;
  std::map<std::string, std::size_t> index_;
};

/// How far a row that no fit sees lies from what the base fit predicts, in σ; and σ.
std::optional<std::pair<double, double>> deviation_of(const diagnosis::Evidence& evidence,
                                                      const diagnosis::GrossRow& row) {
  const assembly::Assembly& base = *evidence.base;
  std::vector<double> predicted(base.layout().prediction_count);
  if (!base.evaluator().predict(evidence.fit.free, predicted, {}, *base.evaluator().make_workspace()).ok())
    return std::nullopt;
  for (const assembly::MeasuredChannel& view : base.layout().channels) {
    if (view.test != row.test || view.observable != row.channel || !view.fitted[row.row]) continue;
    const auto before = static_cast<std::size_t>(
        std::count(view.fitted.begin(), view.fitted.begin() + static_cast<std::ptrdiff_t>(row.row), true));
    const double sd = diagnosis::row_deviations(view)[before];
    return std::pair((view.measured[row.row] - predicted[view.offset + row.row]) / sd, sd);
  }
  return std::nullopt;
}

/// Rows that are left out as gross errors are still outliers. No fit uses them, so they resemble no other mechanism.
void add_rows_left_out(const Analysis& analysis, std::vector<Sketch>& sketches) {
  std::vector<Sketch> rows;
  for (const diagnosis::GrossRow& row : analysis.evidence.gross)
    for (const Sketch& whole : sketches) {
      const diagnosis::Place& place = whole.profile.place;
      if (place.tests != std::vector{row.test} || place.channel != row.channel || place.row) continue;
      if (!diagnosis::takes(*analysis.hypotheses.candidates[whole.candidate].mechanism, "rows")) continue;
      const auto far = deviation_of(analysis.evidence, row);
      if (!far) continue;
      Sketch single = whole;
      single.profile.place.row = row.row;
      single.profile.place.file_row = row.file_row;
      const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(analysis.evidence.fit.residuals.size());
      for (std::size_t h = 0; h < 2; ++h) {
        const double t = h == 0 ? far->first : -far->first;
        single.halves[h] = Draft{{t, 1 / far->second, 0, 1, false, true, t, {}}, nothing, 0, 0, {}};
      }
      rows.push_back(std::move(single));
    }
  for (Sketch& row : rows) sketches.push_back(std::move(row));
}

/// The vectors of all halves; those that two sides share once.
std::vector<Eigen::VectorXd> number_vectors(std::vector<Sketch>& sketches) {
  std::vector<Eigen::VectorXd> vectors;
  for (Sketch& sketch : sketches) {
    auto& [up, down] = sketch.halves;
    for (std::optional<Draft>* half : {&up, &down}) {
      if (!*half) continue;
      if (half == &down && up && !up->half.refitted && !down->half.refitted) {
        down->half.vector = up->half.vector;
        down->half.sign = -1;
        const bool kinked = (up->along + down->along).norm() > 1e-9;
        if (!kinked) continue;
        down->half.sign = 1;
      }
      (*half)->half.vector = vectors.size();
      vectors.push_back((*half)->along);
    }
    if (up) sketch.profile.up = up->half;
    if (down) sketch.profile.down = down->half;
  }
  return vectors;
}

/// An orthonormal basis of the smooth shapes that a refit leaves.
Eigen::MatrixXd smooth_basis(const Analysis& analysis) {
  const Eigen::MatrixXd& columns = analysis.alarm.shapes.columns;
  const Eigen::MatrixXd projected = analysis.hypotheses.projection.off(columns);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < projected.cols(); ++k)
    if (projected.col(k).norm() > shape_left * columns.col(k).norm()) kept.push_back(k);
  return diagnosis::basis(projected(Eigen::all, kept), 1e-3);
}

/// The vectors, a column each, and the shapes behind them.
Eigen::MatrixXd side_by_side(const std::vector<Eigen::VectorXd>& vectors, const Eigen::MatrixXd& shapes) {
  const auto count = static_cast<Eigen::Index>(vectors.size());
  Eigen::MatrixXd all(shapes.rows(), count + shapes.cols());
  for (Eigen::Index k = 0; k < count; ++k) all.col(k) = vectors[static_cast<std::size_t>(k)];
  all.rightCols(shapes.cols()) = shapes;
  return all;
}

Likeness likeness_of(const Eigen::MatrixXd& all) {
  const Eigen::MatrixXd cosines = all.transpose() * all;
  std::vector<std::int32_t> triangle;
  for (Eigen::Index i = 0; i < cosines.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      triangle.push_back(static_cast<std::int32_t>(std::lround(cosines(i, j) / Likeness::unit)));
  return Likeness(std::move(triangle));
}

void note_what_is_left(Sketch& sketch, const Eigen::MatrixXd& all, SpecimenEvidence& found) {
  for (auto [half, draft] :
       {std::pair{&sketch.profile.up, &sketch.halves[0]}, {&sketch.profile.down, &sketch.halves[1]}}) {
    if (!*half || !(*half)->refitted) continue;
    (*half)->left = found.left.size();
    std::vector<std::int32_t>& left = found.left.emplace_back();
    for (const double value : all.transpose() * (*draft)->rest)
      left.push_back(static_cast<std::int32_t>(std::lround(value / SpecimenEvidence::left_unit)));
  }
}

/// The verdict of the specimen's own diagnosis.
void own_answer(const diagnosis::Diagnosis& diagnosis, SpecimenEvidence& found) {
  const diagnosis::Explanation& explanation = diagnosis.explanation;
  found.p_value = diagnosis.analysis.alarm.p();
  found.alarm = diagnosis.analysis.alarm.raised;
  found.verdict = explanation.verdict;
  for (std::size_t k = 0; k < explanation.claim.named; ++k) found.causes.push_back(explanation.claim.causes[k].id);
  found.ambiguity_set = explanation.claim.ambiguity_set;
  if (explanation.claim.named > 1) {
    found.pairs.push_back(found.causes);
    for (const auto& other : explanation.claim.alternatives) found.pairs.push_back(other);
  }
  for (const diagnosis::RankedMechanism& one : explanation.ranking)
    if (one.probability > 1e-6) found.ranking.push_back({one.id, one.probability});
  found.p_after = explanation.p_after;
  found.rows = static_cast<std::size_t>(diagnosis.analysis.evidence.fit.residuals.size());
  found.squares = diagnosis.analysis.evidence.fit.chi2;
  const diagnosis::Evidence& evidence = diagnosis.analysis.evidence;
  const diagnosis::Size size = diagnosis::MisfitSize(evidence).of(evidence.fit);
  const diagnosis::Tolerance tolerance = diagnosis::tolerance_of(diagnosis.request, evidence);
  found.rms = size.rms;
  found.rms_upper = size.upper;
  found.tolerance = tolerance.share;
  found.tolerance_origin = tolerance.origin;
  found.outlines = outlines_of(evidence);
}

}  // namespace

SpecimenEvidence evidence_of(std::string id, const experiment::Experiment& experiment,
                             const diagnosis::Diagnosis& diagnosis, const plugins::Catalogue& catalogue) {
  const experiment::Experiment measured = experiment::measured_only(experiment);
  const diagnosis::Progress silent;
  const Inquiry inquiry{measured, diagnosis.request, catalogue, silent};
  const Analysis& analysis = diagnosis.analysis;
  SpecimenEvidence found;
  found.id = std::move(id);
  own_answer(diagnosis, found);
  std::vector<Sketch> sketches = Gathering(inquiry, analysis).sketches();
  add_rows_left_out(analysis, sketches);
  const std::vector<Eigen::VectorXd> vectors = number_vectors(sketches);
  const Eigen::MatrixXd shapes = smooth_basis(analysis);
  const Eigen::VectorXd seen = -shapes.transpose() * analysis.evidence.fit.residuals;
  found.shapes.assign(seen.begin(), seen.end());
  found.vectors = vectors.size();
  const Eigen::MatrixXd all = side_by_side(vectors, shapes);
  found.likeness = likeness_of(all);
  for (Sketch& sketch : sketches) {
    note_what_is_left(sketch, all, found);
    found.profiles.push_back(std::move(sketch.profile));
  }
  return found;
}

SpecimenEvidence evidence_of(std::string id, const experiment::Experiment& experiment,
                             const diagnosis::Request& request, const plugins::Catalogue& catalogue) {
  // A mistake in the file of one specimen is no evidence about the tissue.
  diagnosis::Request physical = request;
  std::erase(physical.groups, "file");
  return evidence_of(std::move(id), experiment, diagnosis::diagnose(experiment, physical, catalogue), catalogue);
}

double own_log_weight(const SpecimenEvidence& specimen, const std::string& id) {
  std::vector<double> curves;
  for (const Profile& profile : specimen.profiles) {
    if (profile.id != id || profile.place.row) continue;
    const double side =
        profile.up && profile.down ? 0 : std::log(std::erfc(-std::max(profile.active().t, 0.0) / M_SQRT2));
    curves.push_back(profile.gain() / 2 + side);
  }
  return diagnosis::log_sum(curves) - std::log(static_cast<double>(std::max<std::size_t>(curves.size(), 1)));
}

}  // namespace tunica::cohort_diagnosis
