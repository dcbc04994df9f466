// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "assembly/memory.hpp"
#include "diagnosis/hypotheses/amplitude_range.hpp"
#include "diagnosis/hypotheses/extension.hpp"
#include "diagnosis/hypotheses/isotropy.hpp"
#include "diagnosis/hypotheses/places.hpp"
#include "diagnosis/hypotheses/signatures.hpp"
#include "diagnosis/hypotheses/volume.hpp"
#include "plugins/guarded.hpp"
#include "tunica/error.hpp"

namespace tunica::diagnosis {
namespace {

using experiment::Experiment;
using experiment::RunEntry;

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

/// A field shows strains along all directions of its plane at once.
bool has_field(const assembly::Assembly& base) {
  return std::ranges::any_of(base.layout().channels, &assembly::MeasuredChannel::is_field);
}

/// Thrown where a mechanism changes the volume and no channel shows it.
struct VolumeIsNotSeen {};

bool lacks_size(const MechanismFactory& mechanism, const Options& of_test) {
  return std::any_of(mechanism.sizes.begin(), mechanism.sizes.end(),
                     [&](const std::string& name) { return !of_test.has(name) || !(of_test.number(name) > 0); });
}

class CandidateSearch {
 public:
  CandidateSearch(const Inquiry& inquiry, const Evidence& evidence, const Projection& projection)
      : experiment_(evidence.experiment),
        run_(evidence.run),
        base_(*evidence.base),
        fitted_(evidence.fit.free),
        projection_(projection),
        catalogue_(inquiry.catalogue),
        clock_(clock_of(evidence.experiment, evidence.run, inquiry.catalogue)),
        quick_(inquiry.request.quick),
        sees_volume_(sees_volume(*evidence.base, evidence.experiment, inquiry.catalogue)) {
    for (const assembly::TestPast& one : assembly::unknown_pasts(experiment_, run_, catalogue_))
      pasts_.emplace(one.test, one.past);
    const std::vector<std::string>& asked = inquiry.request.mechanisms;
    asked_.insert(asked.begin(), asked.end());
    for (std::size_t m = 0; m < base_.models().count() && !has_field(base_); ++m)
      if (is_isotropic(base_.models().model(m))) isotropic_.insert(base_.models().name(m));
  }

  Candidate find(const std::string& id, const MechanismFactory& mechanism) const {
    Candidate candidate{id, &mechanism, {}, {}};
    if (needs_clock(mechanism) && !(clock_.longest > 0)) {
      candidate.absent = "the data have no time";
      candidate.absence = Absence::no_clock;
      return candidate;
    }
    const std::vector<Place> places = places_of(mechanism, candidate);
    std::map<std::string, std::vector<MechanismFactory::Setting>> by_options;
    for (const auto& setting : settings_to_try(mechanism, clock_))
      by_options[options_key(mechanism, setting)].push_back(setting);
    for (const auto& [key, alike] : by_options) add_everywhere(places, alike, candidate);
    std::erase_if(candidate.hypotheses, [](const Hypothesis& hypothesis) {
      return hypothesis.signature.size() == 0 || !hypothesis.signature.allFinite() ||
             !(hypothesis.signature.norm() > 0);
    });
    if (!candidate.hypotheses.empty()) {
      candidate.absent.clear();
      candidate.absence = Absence::none;
    } else if (candidate.absent.empty()) {
      candidate.absent = "it leaves no trace in these data";
      candidate.absence = Absence::no_trace;
    }
    return candidate;
  }

 private:
  /// Whether it acts along directions that the model lacks, and was not requested by name.
  [[nodiscard]] bool lacks_directions(const MechanismFactory& mechanism, const std::string& model) const {
    return mechanism.directional && !asked_.contains(mechanism.id) && isotropic_.contains(model);
  }

  /// Whether it needs a history of this test that is unknown. A sensor needs only the order of rows; a specimen also
  /// needs its loading before the first row.
  [[nodiscard]] bool lacks_past(const MechanismFactory& mechanism, const std::string& test) const {
    if (!assembly::has_memory(mechanism) || asked_.contains(mechanism.id)) return false;
    const auto found = pasts_.find(test);
    return found != pasts_.end() &&
           (found->second == data::Past::order_unknown || group_of(mechanism) == CauseGroup::material);
  }
  /// The tests of the model without a past.
  [[nodiscard]] std::vector<std::string> forgotten_in(const MechanismFactory& mechanism,
                                                      const std::string& model) const {
    std::vector<std::string> tests;
    for (const std::string& test : run_.tests) {
      const std::vector<std::string> models = assembly::models_of_test(experiment_.test(test), run_);
      if (std::find(models.begin(), models.end(), model) != models.end() && lacks_past(mechanism, test))
        tests.push_back(test);
    }
    return tests;
  }

  /// Whether a memory of the model shows in a test whose past is known, while the others can take part as a first
  /// loading: their rows of unknown order stand by their values.
  [[nodiscard]] bool remembers_elsewhere(const std::string& model, const std::vector<std::string>& forgotten) const {
    if (std::any_of(forgotten.begin(), forgotten.end(),
                    [&](const std::string& test) { return pasts_.at(test) != data::Past::order_unknown; }))
      return false;
    return std::any_of(run_.tests.begin(), run_.tests.end(), [&](const std::string& test) {
      const std::vector<std::string> models = assembly::models_of_test(experiment_.test(test), run_);
      return std::find(models.begin(), models.end(), model) != models.end() && !pasts_.contains(test) &&
             unloads(base_, test);
    });
  }

  /// The models, or the tests and channels, that have not got it yet; the candidate says why there is nowhere.
  std::vector<Place> places_of(const MechanismFactory& mechanism, Candidate& candidate) const {
    const std::string& id = candidate.id;
    const std::vector<std::string> models = experiment_.models_of(run_);
    const auto nowhere = [&candidate](Absence absence, const char* why) {
      candidate.absence = absence;
      candidate.absent = why;
      return std::vector<Place>();
    };
    if (std::all_of(models.begin(), models.end(),
                    [&](const std::string& name) { return lacks_directions(mechanism, name); }))
      return nowhere(Absence::isotropic,
                     "the base model is isotropic, and the mechanism acts along directions; ask for it by name");
    const char* const no_past = "the past of the rows is not known";
    if (mechanism.stage < Stage::test) {
      std::vector<Place> materials;
      for (const std::string& name : models) {
        const bool has_it = !mechanism.several && already_there(experiment_.model(name).mechanisms, id);
        if (has_it || lacks_directions(mechanism, name)) continue;
        const std::vector<std::string> forgotten = forgotten_in(mechanism, name);
        candidate.without_past.insert(forgotten.begin(), forgotten.end());
        if (!forgotten.empty() && !remembers_elsewhere(name, forgotten)) continue;
        Place material;
        if (models.size() > 1) material.model = name;
        materials.push_back(std::move(material));
      }
      if (materials.empty() && !candidate.without_past.empty()) return nowhere(Absence::no_past, no_past);
      return materials.empty() ? nowhere(Absence::already_there, "the model has it already") : materials;
    }
    std::vector<Place> places = single_places(mechanism, experiment_, run_, base_);
    if (!places.empty() && !mechanism.sizes.empty()) {
      std::erase_if(places, [&](const Place& place) {
        return lacks_size(mechanism, experiment_.test(place.tests.front()).options);
      });
      if (places.empty())
        return nowhere(Absence::no_size, "the file does not say the sizes of the specimen that it needs");
    }
    std::erase_if(places, [&](const Place& place) {
      return already_there(experiment_.test(place.tests.front()).mechanisms, id);
    });
    std::erase_if(places, [&](const Place& place) {
      const bool forgotten = lacks_past(mechanism, place.tests.front());
      if (forgotten) candidate.without_past.insert(place.tests.front());
      return forgotten;
    });
    if (places.empty() && !candidate.without_past.empty()) return nowhere(Absence::no_past, no_past);
    if (places.empty()) return nowhere(Absence::no_place, "no test that it applies to");
    // On a first loading a memory is part of what the base model says.
    if (mechanism.memory && group_of(mechanism) == CauseGroup::material)
      std::erase_if(places, [&](const Place& place) { return !unloads(base_, place.tests.front()); });
    return places.empty() ? nowhere(Absence::no_trace, "no test takes the load off again") : places;
  }

  /// On each place by itself, where the mechanism is shared with one amplitude on all of them, and on single rows.
  void add_everywhere(const std::vector<Place>& places, const std::vector<MechanismFactory::Setting>& alike,
                      Candidate& candidate) const {
    const MechanismFactory& mechanism = *candidate.mechanism;
    std::vector<Hypothesis> found;
    Place all;
    for (const Place& place : places) {
      try {
        add(mechanism, {candidate.id, place, alike.front()}, alike, found);
        if (place.tests.empty() && needs_clock(mechanism))
          for (const double pace : clock_.paces())
            add(mechanism, {candidate.id, place, alike.front(), {}, {}, pace}, alike, found);
        if (!place.tests.empty()) all.tests.push_back(place.tests.front());
      } catch (const VolumeIsNotSeen&) {
        candidate.absent = "neither a lateral stretch nor a volume was measured; ask for it by name";
        candidate.absence = Absence::no_volume;
      } catch (const InputError& problem) {
        if (!candidate.absent.empty()) continue;
        candidate.absent = problem.what();
        candidate.absence = Absence::not_applicable;
      }
    }
    const std::size_t singles = found.size();
    if (mechanism.shared && all.tests.size() > 1) add(mechanism, {candidate.id, all, alike.front()}, alike, found);
    if (takes(mechanism, "rows"))
      for (std::size_t k = 0; k < singles; ++k) {
        const Hypothesis whole = found[k];
        add_rows(whole, base_, found);
      }
    std::move(found.begin(), found.end(), std::back_inserter(candidate.hypotheses));
  }

  void add(const MechanismFactory& mechanism, const Addition& first,
           const std::vector<MechanismFactory::Setting>& settings, std::vector<Hypothesis>& into) const {
    const Addition ranged = with_range(mechanism, first, settings);
    const Extension extended(experiment_, run_of(first.place), {ranged}, catalogue_);
    const assembly::Assembly& assembly = extended.assembly();
    if (!sees_volume_ && !asked_.contains(first.id) && changes_volume(assembly) && !changes_volume(base_))
      throw VolumeIsNotSeen();
    const auto workspace = assembly.evaluator().make_workspace();
    const std::vector<double> at_null = extended.at_null(fitted_in(extended));
    Eigen::VectorXd bare;
    Eigen::MatrixXd J;
    for (std::size_t s = 0; s < settings.size(); ++s) {
      const std::vector<double> null = with_setting(extended, mechanism, settings[s], at_null);
      const bool exact = assembly.layout().jacobian_is_exact;
      // At the null, nuisance parameters have no effect. Without a Jacobian, one simulation therefore serves all
      // settings.
      if ((exact || s == 0) && !whitened(assembly, null, *workspace, bare, exact ? &J : nullptr).ok()) continue;
      for (Slope& slope : slopes_of(extended, mechanism, null, bare, J, *workspace, quick_)) {
        if (slope.signature.size() == 0) continue;
        Hypothesis tangent{&mechanism,
                           {first.id, first.place, settings[s], ranged.range, {}, first.pace},
                           embedded(slope.signature, assembly),
                           slope.side,
                           slope.sign};
        if (tangent.side != MechanismFactory::Side::even)
          for (const double sign : {1.0, -1.0}) add_secant(extended, tangent, sign, null, bare, *workspace, into);
        into.push_back(std::move(tangent));
      }
    }
  }

  /// With the amplitudes that the data allow.
  [[nodiscard]] Addition with_range(const MechanismFactory& mechanism, Addition addition,
                                    const std::vector<MechanismFactory::Setting>& settings) const {
    if (addition.place.channel.empty() && !(mechanism.plausible_effect > 0)) return addition;
    const Extension declared(experiment_, run_of(addition.place), {addition}, catalogue_);
    addition.range = range_from_data(declared, mechanism, settings, declared.at_null(fitted_in(declared)),
                                     *declared.assembly().evaluator().make_workspace());
    return addition;
  }

  /// Only the tests that a mechanism acts on have to be simulated; not so where that changes which models there are,
  /// and with them the names of parameters.
  [[nodiscard]] RunEntry run_of(const Place& place) const {
    RunEntry run = run_;
    if (place.tests.empty()) return run;
    run.tests = place.tests;
    return experiment_.models_of(run) == experiment_.models_of(run_) ? run : run_;
  }

  /// The fitted parameters that an extension has of the base, in its order.
  [[nodiscard]] std::vector<double> fitted_in(const Extension& extended) const {
    std::vector<double> values;
    for (const std::size_t j : extended.base())
      for (std::size_t k = 0; k < fitted_.size(); ++k)
        if (base_.layout().parameters[k].name == extended.assembly().layout().parameters[j].name)
          values.push_back(fitted_[k]);
    return values;
  }

  /// Residual rows of some tests among those of all.
  [[nodiscard]] Eigen::VectorXd embedded(const Eigen::VectorXd& rows, const assembly::Assembly& from) const {
    const auto fitted = [](const assembly::MeasuredChannel& view) {
      return static_cast<Eigen::Index>(std::count(view.fitted.begin(), view.fitted.end(), true));
    };
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(base_.layout().residual_count));
    Eigen::Index at = 0;
    for (const assembly::MeasuredChannel& view : from.layout().channels) {
      Eigen::Index into = 0;
      for (const assembly::MeasuredChannel& own : base_.layout().channels) {
        if (own.test == view.test && own.observable == view.observable)
          all.segment(into, fitted(own)) = rows.segment(at, fitted(own));
        into += fitted(own);
      }
      at += fitted(view);
    }
    return all;
  }

  /// The signature at half a plausible amplitude on one side, if its shape after a refit differs from that of the
  /// tangent. It is then one more hypothesis.
  void add_secant(const Extension& extended, const Hypothesis& tangent, double sign, const std::vector<double>& null,
                  const Eigen::VectorXd& bare, assembly::Workspace& workspace, std::vector<Hypothesis>& into) const {
    const MechanismFactory& mechanism = *tangent.mechanism;
    if (tangent.side == MechanismFactory::Side::positive && sign != tangent.sign) return;
    // A mechanism does not know the unit of a channel. Mechanisms on data rows are linear, and those with memory nearly
    // so.
    if (!tangent.addition.place.channel.empty() || mechanism.stage == Stage::history) return;
    const AmplitudeRange range = range_of(mechanism, tangent.addition);
    const double reach = sign > 0 ? range.plausible_max - mechanism.null : mechanism.null - range.plausible_min;
    if (!(reach > 0)) return;
    const Extension::Part& part = extended.parts().front();
    Eigen::VectorXd there;
    for (const double share : {0.5, 0.2}) {
      std::vector<double> free = null;
      for (const std::size_t member : part.amplitude) free[member] = part.null + sign * share * reach;
      if (!whitened(extended.assembly(), free, workspace, there, nullptr).ok()) continue;
      Hypothesis secant = tangent;
      secant.signature = embedded((there - bare) / (share * reach), extended.assembly());
      secant.side = MechanismFactory::Side::positive;
      secant.sign = sign;
      secant.at_large = true;
      const Eigen::VectorXd a = projection_.off(secant.signature), b = projection_.off(tangent.signature);
      constexpr double another_shape = 0.97;
      if (std::abs(a.dot(b)) < another_shape * a.norm() * b.norm()) into.push_back(std::move(secant));
      return;
    }
  }

  const Experiment& experiment_;
  const RunEntry& run_;
  const assembly::Assembly& base_;
  std::span<const double> fitted_;
  const Projection& projection_;
  const plugins::Catalogue& catalogue_;
  Clock clock_;
  bool quick_;
  bool sees_volume_;
  std::map<std::string, data::Past> pasts_;  ///< of tests with an unknown past
  std::set<std::string> asked_;              ///< mechanisms, by name
  std::set<std::string> isotropic_;          ///< models, where the tests cannot tell directions apart
};

}  // namespace

std::vector<Candidate> candidates(const Inquiry& inquiry, const Evidence& evidence, const Projection& projection) {
  const CandidateSearch search(inquiry, evidence, projection);
  // What is asked for by name is looked for in every group.
  const std::vector<std::string>& requested = inquiry.request.mechanisms;
  std::vector<const plugins::Catalogue::Entry<MechanismFactory>*> asked;
  for (const auto& [id, entry] : inquiry.catalogue.mechanisms())
    if (!entry.factory.parameters_of &&
        (requested.empty() ? !entry.factory.question_only && inquiry.request.considers(code_of(group_of(entry.factory)))
                           : std::find(requested.begin(), requested.end(), id) != requested.end()))
      asked.push_back(&entry);
  std::vector<Candidate> found(asked.size());
  const auto done = inquiry.steps("signatures of the mechanisms", 0.1, 0.2, asked.size());
  tbb::parallel_for(std::size_t{0}, asked.size(), [&](std::size_t k) {
    found[k] = search.find(asked[k]->factory.id, asked[k]->factory);
    done();
  });
  return found;
}

}  // namespace tunica::diagnosis
