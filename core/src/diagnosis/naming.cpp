// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/causes.hpp"
#include "diagnosis/claims.hpp"
#include "diagnosis/credible.hpp"
#include "diagnosis/groups.hpp"
#include "diagnosis/rest.hpp"
#include "diagnosis/squares.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double most_of_it = 0.8;

class Naming {
 public:
  Naming(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
         const plugins::Catalogue& catalogue)
      : d_(diagnosis), detection_(detection), draws_(draws), shapes_(shapes), catalogue_(catalogue) {}

  void run() {
    singles_ = fit_singles(d_, catalogue_);
    if (singles_.empty())
      return unexplained(d_.settings.mechanisms.empty()
                             ? "no mechanism of the catalogue leaves a trace in these data"
                             : "none of the mechanisms that were asked for leaves a trace in these data");
    if (!singles_.front().best) return unexplained("no mechanism could be fitted at finite amplitude");
    rank();
    const double p_one = p_of_rest(*singles_.front().best);
    // Where one may be enough, two must be worth their price.
    const double floor =
        p_one > second_alpha ? singles_.front().log_weight - log_odds_of_pair(singles_.size()) : -INFINITY;
    groups_ = fit_pairs(d_, detection_, singles_, floor, catalogue_);
    if (!groups_.empty() && groups_.front().log_weight < floor) groups_.clear();
    if (groups_.empty()) {
      claim(claim_one(d_, detection_, singles_, catalogue_), p_one);
      return p_one > second_alpha ? judge() : not_clean(d_, detection_, draws_, shapes_);
    }
    double p = p_of_rest(*groups_.front().refitted);
    if (p <= second_alpha) {
      if (auto triples = fit_triples(d_, detection_, groups_, catalogue_); !triples.empty()) {
        groups_ = std::move(triples);
        p = p_of_rest(*groups_.front().refitted);
      }
    }
    if (p > second_alpha) {
      claim(claim_several(d_, detection_, groups_, singles_, catalogue_), p);
      return judge();
    }
    // Nothing explains it all. What one mechanism does to most of it is worth more than what three do to a little more,
    // and so is what is likelier.
    const double rows = static_cast<double>(d_.fit.residuals.size());
    const double odds = static_cast<double>(groups_.front().additions.size() - 1) * log_odds_of_pair(singles_.size());
    if (d_.fit.chi2 - singles_.front().best->fit.chi2 > most_of_it * (d_.fit.chi2 - rows) ||
        singles_.front().log_weight > groups_.front().log_weight + odds)
      claim(claim_one(d_, detection_, singles_, catalogue_), p_one);
    else
      claim(claim_several(d_, detection_, groups_, singles_, catalogue_), p);
    not_clean(d_, detection_, draws_, shapes_);
  }

 private:
  [[nodiscard]] const std::string& id_of(std::size_t direction) const {
    return d_.candidates[d_.directions[direction].candidate].id;
  }

  [[nodiscard]] double p_of_rest(const Refitted& refitted) const {
    return diagnosis::p_of_rest(d_, refitted, shapes_, draws_);
  }

  void claim(Claim made, double p_after) { claim_ = std::move(made), d_.p_after = p_after; }

  void rank() {
    std::vector<double> logs;
    for (const Single& single : singles_) logs.push_back(single.log_weight);
    const double all = log_sum(logs);
    for (const Single& single : singles_) {
      d_.best_direction[single.candidate] = single.direction;
      const Direction& direction = d_.directions[single.direction];
      Ranked ranked{id_of(single.direction),
                    d_.candidates[direction.candidate].hypotheses[direction.hypothesis].addition.target,
                    std::exp(single.log_weight - all), score(direction, -d_.fit.residuals).T, std::nullopt};
      if (single.best) ranked.gain = d_.fit.chi2 - single.best->fit.chi2;
      d_.ranking.push_back(std::move(ranked));
    }
  }

  /// The table of verdicts, for an explanation after which the residuals are clean.
  void judge() {
    d_.verdict = claim_.alone                               ? Verdict::named
                 : claim_.explanations <= most_explanations ? Verdict::indistinguishable
                                                            : Verdict::unknown;
    if (d_.verdict == Verdict::unknown)
      d_.reasons.push_back(
          fmt::format("{} explanations that do not look alike are about as likely as each other", claim_.explanations));
    if (d_.verdict != Verdict::unknown && !claim_.correction.empty()) {
      d_.verdict = Verdict::indistinguishable, d_.unlisted = true;
      d_.reasons.push_back(fmt::format(
          "{} explains next to nothing without the others, and may only correct their shape", claim_.correction));
    }
    if (d_.verdict != Verdict::named) return;
    const auto suspect = [this](std::string why) {
      d_.verdict = Verdict::suspect_data;
      d_.reasons.push_back(std::move(why));
    };
    const Cause& first = d_.causes.front();
    if (d_.named == 1 && catalogue_.mechanisms().at(first.id).factory.stage == Stage::data)
      return suspect(fmt::format("the misfit sits {}, and nowhere else", first.target.words()));
    for (std::size_t k = 0; k < d_.named; ++k) {
      const Cause& cause = d_.causes[k];
      if (cause.amplitude.plausible && !cause.amplitude.at_bound) continue;
      const std::string unit = cause.amplitude.unit == "1" ? "" : " " + cause.amplitude.unit;
      return suspect(fmt::format("{} would have to be {:.3g}{}, which is {}", cause.id, cause.amplitude.value, unit,
                                 cause.amplitude.at_bound ? "at its bound" : "beyond what is plausible"));
    }
    if (d_.named > 1) return;
    if (const std::string curve = carrier(d_, d_.directions[singles_.front().direction], -d_.fit.residuals);
        !curve.empty())
      suspect("the effect should show in several curves and is carried by one: " + curve);
  }

  void unexplained(std::string why) {
    d_.verdict = Verdict::unknown;
    d_.reasons.push_back(std::move(why));
  }

  Diagnosis& d_;
  const Detection& detection_;
  const Eigen::MatrixXf& draws_;
  const Shapes& shapes_;
  const plugins::Catalogue& catalogue_;
  std::vector<Single> singles_;
  std::vector<Group> groups_;
  Claim claim_;
};

}  // namespace

void not_clean(Diagnosis& d, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes) {
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < d.named; ++k) ids.push_back(d.causes[k].id);
  const double rows = static_cast<double>(d.fit.residuals.size());
  const double share = (d.fit.chi2 - d.extension->fit.chi2) / std::max(d.fit.chi2 - rows, 1.0);
  d.verdict = Verdict::unknown;
  d.reasons.push_back(fmt::format("{} {} {:.0f} % of the misfit beyond noise; what is left is no noise (p {})",
                                  fmt::join(ids, " and "), ids.size() == 1 ? "takes" : "take",
                                  100 * std::clamp(share, 0.0, 1.0),
                                  d.p_after < 1e-4 ? "< 0.0001" : fmt::format("= {:.2g}", d.p_after)));
  const Rest rest(d, *d.extension, shapes, draws);
  Fit fit = d.extension->fit;
  for (double factor = 1.1; factor < 20; factor *= 1.1) {
    fit.residuals = d.extension->fit.residuals / factor;
    if (std::min(rest.detection->judge(-fit.residuals).p, p_of_squares(d, fit)) <= second_alpha) continue;
    fit.residuals = d.fit.residuals / factor;
    const double alarm = std::min(detection.judge(-fit.residuals).p, p_of_squares(d, fit));
    d.noise_factor = factor;
    d.reasons.push_back(fmt::format("with noise {:.1f} times as large it would be, and the base model {}", factor,
                                    alarm <= d.settings.alpha ? "would still be wrong" : "would be right too"));
    return;
  }
}

void name_causes(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
                 const plugins::Catalogue& catalogue) {
  Naming(diagnosis, detection, draws, shapes, catalogue).run();
}

}  // namespace tunica::diagnosis
