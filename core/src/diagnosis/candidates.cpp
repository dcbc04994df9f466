// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "diagnosis/hypotheses.hpp"
#include "diagnosis/scores.hpp"
#include "diagnosis/signatures.hpp"
#include "plugins/guarded.hpp"
#include "tunica/error.hpp"

namespace tunica::diagnosis {
namespace {

using experiment::Experiment;
using experiment::RunEntry;

bool takes(const MechanismFactory& mechanism, const std::string& option) {
  return std::any_of(mechanism.options.begin(), mechanism.options.end(),
                     [&](const Option& declared) { return declared.name == option; });
}

/// Shortest step and duration of the data's clocks, s; none where no fitted test has one.
struct Clock {
  double shortest = INFINITY, longest = 0;
};
Clock clock_of(const Experiment& experiment, const RunEntry& run, const plugins::Catalogue& catalogue) {
  Clock clock;
  for (const std::string& name : run.tests) {
    const auto& entry = experiment.test(name);
    const auto dataset = data::read_dataset(entry.data, catalogue.tests().find(entry.type)->second.factory.observables);
    if (dataset.time.size() < 2) continue;
    clock.longest = std::max(clock.longest, dataset.time.back() - dataset.time.front());
    for (std::size_t i = 1; i < dataset.time.size(); ++i)
      if (const double step = dataset.time[i] - dataset.time[i - 1]; step > 0)
        clock.shortest = std::min(clock.shortest, step);
  }
  return clock;
}

constexpr std::size_t clock_points = 6;

/// Where to look for a mechanism: as it declares, or over the clock of the data for nuisance parameters in seconds.
std::vector<MechanismFactory::Setting> settings_of(const MechanismFactory& mechanism, const Clock& clock) {
  if (!mechanism.scan.empty()) return mechanism.scan;
  std::vector<MechanismFactory::Setting> found;
  for (std::size_t k = 1; k < mechanism.parameters.size(); ++k) {
    const Parameter& nuisance = mechanism.parameters[k];
    if (nuisance.unit != "s" || !(clock.longest > 0)) continue;
    const double low = std::clamp(clock.shortest, nuisance.min, nuisance.max),
                 high = std::clamp(clock.longest, nuisance.min, nuisance.max);
    for (std::size_t i = 0; i < clock_points; ++i)
      found.push_back({{nuisance.name, low * std::pow(high / low, static_cast<double>(i) / (clock_points - 1))}});
    break;
  }
  if (found.empty()) found.emplace_back();
  return found;
}

bool needs_clock(const MechanismFactory& mechanism) {
  return std::any_of(mechanism.parameters.begin(), mechanism.parameters.end(),
                     [](const Parameter& parameter) { return parameter.unit == "s"; });
}

/// Single tests and channels where the mechanism may act; nothing for one that acts on the model.
std::vector<Target> single_targets(const MechanismFactory& mechanism, const Experiment& experiment, const RunEntry& run,
                                   const calibration::Assembly& base) {
  std::vector<Target> targets;
  for (const std::string& name : run.tests) {
    const auto& entry = experiment.test(name);
    if (entry.hold_out.all) continue;
    const auto& types = mechanism.applies_to;
    if (!types.empty() && std::find(types.begin(), types.end(), entry.type) == types.end()) continue;
    if (!takes(mechanism, "channel")) {
      targets.push_back({{name}});
      continue;
    }
    for (const calibration::ChannelView& view : base.channels())
      if (view.test == name && std::find(view.fitted.begin(), view.fitted.end(), true) != view.fitted.end())
        targets.push_back({{name}, view.observable});
  }
  return targets;
}

/// A curve's mean shift restricted to single rows: one column a row, whitened like the residuals.
void add_rows(const Hypothesis& whole, const calibration::Assembly& base, std::vector<Hypothesis>& into) {
  const std::size_t rows = base.residual_count(), predictions = base.prediction_count();
  std::vector<double> unit(rows, 0.0), map(predictions);
  // Row k of the whitening, read off its transpose.
  std::vector<std::vector<std::pair<std::size_t, double>>> columns(predictions);
  for (std::size_t k = 0; k < rows; ++k) {
    unit[k] = 1;
    base.transpose_residuals(unit, map);
    unit[k] = 0;
    for (std::size_t i = 0; i < predictions; ++i)
      if (map[i] != 0) columns[i].emplace_back(k, map[i]);
  }
  for (const calibration::ChannelView& view : base.channels()) {
    if (view.test != whole.addition.target.tests.front() || view.observable != whole.addition.target.channel) continue;
    for (std::size_t i = 0; i < view.count; ++i) {
      if (!view.fitted[i]) continue;
      Hypothesis one = whole;
      one.addition.target.row = i;
      one.signature = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows));
      for (const auto& [k, value] : columns[view.offset + i]) one.signature[static_cast<Eigen::Index>(k)] = value;
      into.push_back(std::move(one));
    }
  }
}

/// Number options of a setting: different ones need different tests.
std::string options_key(const MechanismFactory& mechanism, const MechanismFactory::Setting& setting) {
  std::string key;
  for (const auto& [name, value] : setting)
    if (takes(mechanism, name)) key += fmt::format("{}={};", name, value);
  return key;
}

bool already_there(const std::vector<experiment::MechanismEntry>& entries, const std::string& id) {
  return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return entry.type == id; });
}

class Search {
 public:
  Search(const Experiment& experiment, const RunEntry& run, const calibration::Assembly& base,
         std::span<const double> fitted, const Projection& projection, const plugins::Catalogue& catalogue)
      : experiment_(experiment),
        run_(run),
        base_(base),
        fitted_(fitted),
        projection_(projection),
        catalogue_(catalogue),
        clock_(clock_of(experiment, run, catalogue)) {}

  Candidate find(const std::string& id, const MechanismFactory& mechanism) const {
    Candidate candidate{id, &mechanism, {}, {}};
    if (needs_clock(mechanism) && !(clock_.longest > 0)) {
      candidate.absent = "the data have no time";
      return candidate;
    }
    std::vector<Target> targets;
    if (mechanism.stage < Stage::test) {
      const auto& owner = experiment_.model(experiment_.models_of(run_).front());
      if (already_there(owner.mechanisms, id)) {
        candidate.absent = "the model has it already";
        return candidate;
      }
      targets.emplace_back();
    } else {
      targets = single_targets(mechanism, experiment_, run_, base_);
      std::erase_if(targets, [&](const Target& target) {
        return already_there(experiment_.test(target.tests.front()).mechanisms, id);
      });
      if (targets.empty()) candidate.absent = "no test that it applies to";
    }
    const auto settings = settings_of(mechanism, clock_);
    std::map<std::string, std::vector<MechanismFactory::Setting>> by_options;
    for (const auto& setting : settings) by_options[options_key(mechanism, setting)].push_back(setting);
    for (const auto& [key, alike] : by_options) {
      std::vector<Hypothesis> singles;
      Target all;  // one amplitude in every test where the mechanism can act
      for (const Target& target : targets) {
        try {
          add(mechanism, {id, target, alike.front()}, alike, singles);
          if (!target.tests.empty()) all.tests.push_back(target.tests.front());
        } catch (const InputError& problem) {
          if (candidate.absent.empty()) candidate.absent = problem.what();
        }
      }
      const std::size_t count = singles.size();
      if (mechanism.shared && all.tests.size() > 1) add(mechanism, {id, all, alike.front()}, alike, singles);
      if (takes(mechanism, "rows"))
        for (std::size_t k = 0; k < count; ++k) {
          std::vector<Hypothesis> rows;
          add_rows(singles[k], base_, rows);
          std::move(rows.begin(), rows.end(), std::back_inserter(singles));
        }
      std::move(singles.begin(), singles.end(), std::back_inserter(candidate.hypotheses));
    }
    std::erase_if(candidate.hypotheses, [](const Hypothesis& hypothesis) {
      return hypothesis.signature.size() == 0 || !hypothesis.signature.allFinite() ||
             !(hypothesis.signature.norm() > 0);
    });
    if (!candidate.hypotheses.empty())
      candidate.absent.clear();
    else if (candidate.absent.empty())
      candidate.absent = "it leaves no trace in these data";
    return candidate;
  }

 private:
  void add(const MechanismFactory& mechanism, const Addition& first,
           const std::vector<MechanismFactory::Setting>& settings, std::vector<Hypothesis>& into) const {
    const Extended extended(experiment_, run_of(first.target), {first}, catalogue_);
    const calibration::Assembly& assembly = extended.assembly();
    const auto workspace = assembly.make_workspace();
    const Extended::Part& part = extended.parts().front();
    const std::vector<double> at_null = extended.at_null(fitted_in(extended));
    Eigen::VectorXd bare;
    Eigen::MatrixXd J;
    for (std::size_t s = 0; s < settings.size(); ++s) {
      std::vector<double> null = at_null;
      for (std::size_t k = 0; k < part.nuisance.size(); ++k)
        for (const auto& [name, value] : settings[s])
          if (name == mechanism.parameters[k + 1].name)
            for (const std::size_t member : part.nuisance[k])
              null[member] = std::clamp(value, assembly.parameters()[member].min, assembly.parameters()[member].max);
      const bool exact = assembly.jacobian_is_exact();
      // At the null nuisance parameters do nothing: without a Jacobian, one simulation serves all settings.
      if ((exact || s == 0) && !whitened(assembly, null, *workspace, bare, exact ? &J : nullptr).ok()) continue;
      for (Slope& slope : slopes_of(extended, mechanism, null, bare, J, *workspace)) {
        if (slope.signature.size() == 0) continue;
        Hypothesis tangent{&mechanism,
                           {first.id, first.target, settings[s]},
                           embedded(slope.signature, assembly),
                           slope.side,
                           slope.sign};
        if (tangent.side != MechanismFactory::Side::even)
          for (const double sign : {1.0, -1.0}) add_secant(extended, tangent, sign, null, bare, *workspace, into);
        into.push_back(std::move(tangent));
      }
    }
  }

  /// Only the tests that a mechanism acts on have to be simulated; not so where that changes which models there are,
  /// and with them the names of parameters.
  [[nodiscard]] RunEntry run_of(const Target& target) const {
    RunEntry run = run_;
    if (target.tests.empty()) return run;
    run.tests = target.tests;
    return experiment_.models_of(run) == experiment_.models_of(run_) ? run : run_;
  }

  /// The fitted parameters that an extension has of the base, in its order.
  [[nodiscard]] std::vector<double> fitted_in(const Extended& extended) const {
    std::vector<double> values;
    for (const std::size_t j : extended.base())
      for (std::size_t k = 0; k < fitted_.size(); ++k)
        if (base_.parameters()[k].name == extended.assembly().parameters()[j].name) values.push_back(fitted_[k]);
    return values;
  }

  /// Residual rows of some tests among those of all.
  [[nodiscard]] Eigen::VectorXd embedded(const Eigen::VectorXd& rows, const calibration::Assembly& from) const {
    const auto fitted = [](const calibration::ChannelView& view) {
      return static_cast<Eigen::Index>(std::count(view.fitted.begin(), view.fitted.end(), true));
    };
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(base_.residual_count()));
    Eigen::Index at = 0;
    for (const calibration::ChannelView& view : from.channels()) {
      Eigen::Index into = 0;
      for (const calibration::ChannelView& own : base_.channels()) {
        if (own.test == view.test && own.observable == view.observable)
          all.segment(into, fitted(own)) = rows.segment(at, fitted(own));
        into += fitted(own);
      }
      at += fitted(view);
    }
    return all;
  }

  /// The signature at half a plausible amplitude on one side, where a refit leaves another shape of it than of the
  /// tangent: then it is one more place to look at.
  void add_secant(const Extended& extended, const Hypothesis& tangent, double sign, const std::vector<double>& null,
                  const Eigen::VectorXd& bare, calibration::Assembly::Workspace& workspace,
                  std::vector<Hypothesis>& into) const {
    const MechanismFactory& mechanism = *tangent.mechanism;
    if (tangent.side == MechanismFactory::Side::positive && sign != tangent.sign) return;
    // A channel's unit is not the mechanism's to know, and what acts on data rows is linear; so is memory, nearly.
    if (!tangent.addition.target.channel.empty() || mechanism.stage == Stage::history) return;
    const double reach = sign > 0 ? mechanism.plausible_max - mechanism.null : mechanism.null - mechanism.plausible_min;
    if (!(reach > 0)) return;
    const Extended::Part& part = extended.parts().front();
    Eigen::VectorXd there;
    for (const double share : {0.5, 0.2}) {
      std::vector<double> free = null;
      for (const std::size_t member : part.amplitude) free[member] = part.null + sign * share * reach;
      if (!whitened(extended.assembly(), free, workspace, there, nullptr).ok()) continue;
      Hypothesis secant = tangent;
      secant.signature = embedded((there - bare) / (share * reach), extended.assembly());
      secant.side = MechanismFactory::Side::positive, secant.sign = sign, secant.at_large = true;
      const Eigen::VectorXd a = projection_.off(secant.signature), b = projection_.off(tangent.signature);
      constexpr double another_shape = 0.97;
      if (std::abs(a.dot(b)) < another_shape * a.norm() * b.norm()) into.push_back(std::move(secant));
      return;
    }
  }

  const Experiment& experiment_;
  const RunEntry& run_;
  const calibration::Assembly& base_;
  std::span<const double> fitted_;
  const Projection& projection_;
  const plugins::Catalogue& catalogue_;
  Clock clock_;
};

}  // namespace

std::vector<Candidate> candidates(const Experiment& experiment, const RunEntry& run, const Settings& settings,
                                  const calibration::Assembly& base, std::span<const double> fitted,
                                  const Projection& projection, const plugins::Catalogue& catalogue) {
  const Search search(experiment, run, base, fitted, projection, catalogue);
  std::vector<const plugins::Catalogue::Entry<MechanismFactory>*> asked;
  for (const auto& [id, entry] : catalogue.mechanisms())
    if (settings.mechanisms.empty() ||
        std::find(settings.mechanisms.begin(), settings.mechanisms.end(), id) != settings.mechanisms.end())
      asked.push_back(&entry);
  std::vector<Candidate> found(asked.size());
  tbb::parallel_for(std::size_t{0}, asked.size(),
                    [&](std::size_t k) { found[k] = search.find(asked[k]->factory.id, asked[k]->factory); });
  return found;
}

}  // namespace tunica::diagnosis
