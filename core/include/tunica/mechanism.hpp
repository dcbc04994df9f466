// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tunica/card_energy.hpp"
#include "tunica/model.hpp"
#include "tunica/options.hpp"
#include "tunica/test.hpp"

namespace tunica {

/// Where a mechanism acts. Mechanisms are composed in this order, whatever the order in the experiment file.
enum class Stage {
  invariants,  ///< on the invariants of energy parts
  energy,      ///< on the energy: a part is changed or added
  stress,      ///< on the stress
  history,     ///< on the response to the past
  test,        ///< on the simulated experiment: its geometry, its rig, its sensors
  data         ///< on single readings
};

/// A mechanism: something that a base simulation leaves out, with an amplitude whose null value switches it off.
///
/// It is not a fourth interface: a mechanism is this declaration and one function, which wraps a Model or a Test. The
/// wrapper appends the mechanism's parameters to those of the wrapped object, the amplitude first.
///
/// At the null, the wrapper delegates to the bare object, bit for bit. Near the null, it agrees with the bare object to
/// 1e-12, and derivatives by the amplitude are those of the formula. Diagnosis depends on all three properties, and
/// `tunica plugin check` tests them.
///
/// Bases: DecoratedModel for changed or added energy parts, HistoryModel for memory, DecoratedTest for tests.
struct MechanismFactory {
  /// Where amplitudes lie relative to the null. It decides which test against the null is right.
  enum class Side {
    positive,  ///< at the null or above
    both,      ///< on either side
    even       ///< on either side, with equal effect: the first derivative vanishes at the null
  };

  /// The part of reality that differs from the base simulation. Diagnosis lists causes in the material and in the rig
  /// separately.
  enum class Origin {
    by_stage,  ///< the material for stages before `test`, else the rig
    material,  ///< the specimen: its substance, its layers, its residual stress, what surrounds it
    rig        ///< the experiment: errors in prescribing, reading, measuring or cutting
  };

  /// Name in experiment files and reports, for example "fibre_dispersion".
  std::string id = {};
  /// One sentence for the report: what happens physically.
  std::string cause = {};
  /// Where it acts. Stages before `test` need wrap_model, the others wrap_test or `native`.
  Stage stage = Stage::energy;
  /// The test types that it applies to; empty = all. For the stages test and data.
  std::vector<std::string> applies_to = {};
  /// Its parameters: the amplitude first, nuisance parameters after it.
  std::vector<Parameter> parameters = {};
  /// Set if the parameters depend on the options: the parameters of an object with these options. `parameters` then
  /// holds those of the default options. Such a mechanism is too general for diagnosis, which ignores it; discovery
  /// considers it.
  std::function<std::vector<Parameter>(const Options&)> parameters_of = {};
  /// The null of the amplitude.
  double null = 0;
  /// The side of the null on which amplitudes lie.
  Side side = Side::positive;
  double plausible_min = 0,  ///< smallest amplitude that is physically plausible
      plausible_max = 0;     ///< largest plausible amplitude
  /// Set for an amplitude in units of stress or of a channel, whose size depends on the specimen. The effect of the
  /// largest plausible amplitude, with all else held, is then this multiple of the range of the measured values. The
  /// bound is five times as large. Diagnosis uses both in place of the declared ones. Without a unit, the amplitude
  /// keeps at least its declared range. 0: the declared range holds for all data.
  double plausible_effect = 0;
  /// Ids of mechanisms with a similar effect; an explanation names them.
  std::vector<std::string> look_alikes = {};
  /// The experiment that distinguishes it from its look-alikes.
  std::string isolated_by = {};
  /// Source of formula and range.
  std::string reference = {};
  /// The group that it belongs to in results.
  Origin origin = Origin::by_stage;
  /// Whether it acts along directions of the material, as fibres and muscle do. If the base model is isotropic,
  /// diagnosis leaves it out unless the request names it.
  bool directional = false;
  /// Whether several instances can describe more than one, as with several relaxation times. Diagnosis then tries a
  /// second one if the first leaves more than noise.
  bool several = false;
  /// Whether a row depends on earlier rows, so their order matters. Every mechanism of the stage `history` has memory.
  /// Mechanisms of later stages declare it here, and then wrap the others of their stage.
  bool memory = false;
  /// Options of its object in the experiment file.
  std::vector<Option> options = {};
  /// Options of the test that it needs as sizes above 0, for example a length. If one is 0, diagnosis does not consider
  /// the mechanism, and says so.
  std::vector<std::string> sizes = {};

  /// An error in the record of tests, with its fitted amplitude.
  struct Misrecorded {
    std::string tests;      ///< quoted: "'a' and 'b'"
    std::string direction;  ///< "axial " of a sheet whose directions err by themselves; "" otherwise
    double amplitude;       ///< in the unit of its parameter
  };
  /// Set if a calibration of the rig can settle the question: the meaning of an amplitude in words, without a full
  /// stop. Diagnosis then also asks whether all tests were recorded so, as a question about the file.
  std::function<std::string(const Misrecorded&)> calibration = {};
  /// Whether it is only such a question, because its effect can equal that of a stiffer material. Otherwise it is also
  /// a cause in the rig, in single tests.
  bool question_only = false;
  /// Whether its option "channel" must name a channel. Each channel then has its own amplitude.
  bool by_channel = false;

  /// In place of wrap_test: the name of a parameter of the tests themselves, a native imperfection. It rests at its
  /// null unless this mechanism frees it. An option of the mechanism overrides an option of the test with the same
  /// name.
  std::string native = {};
  /// Whether diagnosis also tries one common amplitude in all tests that it applies to.
  bool shared = false;
  /// Values of nuisance parameters and of number options, by name.
  using Setting = std::vector<std::pair<std::string, double>>;
  /// The settings at which diagnosis looks for the effect, one search each. Empty: every nuisance parameter at its
  /// initial value, except those in s, which range from the shortest time step to the duration of the data.
  std::vector<Setting> scan = {};

  /// Wraps a model, for the stages invariants to history. Throws InputError if it cannot apply, for example without
  /// fibre parts.
  std::function<std::unique_ptr<Model>(std::unique_ptr<Model>, const Options&)> wrap_model = {};
  /// Wraps a test, for the stages test and data. Throws InputError if it cannot apply. Besides its own options it
  /// receives those of the test, under names that it does not declare itself.
  std::function<std::unique_ptr<Test>(std::unique_ptr<Test>, const Options&)> wrap_test = {};

  /// Whether its options are those of a term of the energy, as `added_term` documents them. Discovery adds found terms
  /// to a model with the mechanism that has this role.
  bool writes_terms = false;
  /// Optional, for a mechanism of models that finite-element programs offer as an energy of the volume: this energy at
  /// given values of its parameters. Throws InputError if no program has it with these options.
  std::function<CardVolume(const Options&, std::span<const double>)> card_volume = {};
  /// Optional, for a mechanism of models that finite-element programs offer as softening: its constants at given values
  /// of its parameters. Throws InputError if no program has it with these values.
  std::function<CardSoftening(const Options&, std::span<const double>)> card_softening = {};

  /// The parameters of an object with these options.
  [[nodiscard]] std::vector<Parameter> parameters_with(const Options& with) const {
    return parameters_of ? parameters_of(with) : parameters;
  }
};

}  // namespace tunica
