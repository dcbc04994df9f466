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
/// It is no fourth interface. A mechanism is this declaration and one function, which wraps a Model or a Test. The
/// wrapper appends the mechanism's parameters to those of the wrapped object, the amplitude first.
///
/// At the null: the wrapper delegates to the bare object, bit for bit. Beside the null it agrees with it to 1e-12, and
/// derivatives by the amplitude are those of the formula. Diagnosis depends on all three, and `tunica plugin check`
/// holds a plugin to them.
///
/// Bases: DecoratedModel for changed or added energy parts, HistoryModel for memory, DecoratedTest for tests.
struct MechanismFactory {
  /// Where amplitudes lie relative to the null. It decides which test against the null is right.
  enum class Side {
    positive,  ///< at the null or above
    both,      ///< on either side
    even       ///< on either side, with equal effect: the first derivative vanishes at the null
  };

  /// What is not as the base simulation has it. Diagnosis shows causes in the material and causes in the rig apart.
  enum class Origin {
    by_stage,  ///< the material for stages before `test`, else the rig
    material,  ///< the specimen: its substance, its layers, its residual stress, what surrounds it
    rig        ///< the experiment: what was prescribed, read, measured or cut wrong
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
  /// Set where the parameters depend on the options: those of an object with these options. `parameters` then holds
  /// those of the default options. Diagnosis does not look for such a mechanism, which may stand for anything;
  /// discovery does.
  std::function<std::vector<Parameter>(const Options&)> parameters_of = {};
  /// The null of the amplitude.
  double null = 0;
  /// The side of the null on which amplitudes lie.
  Side side = Side::positive;
  double plausible_min = 0,  ///< smallest amplitude that is physically plausible
      plausible_max = 0;     ///< largest plausible amplitude
  /// Set for an amplitude in units of stress or of a channel, whose size depends on the specimen. The largest plausible
  /// amplitude is then the one whose effect, with all else held, is this multiple of the range of the measured values;
  /// five times as much is the bound. Diagnosis uses both in place of the declared ones. Without a unit, the amplitude
  /// keeps at least its declared range. 0: the declared range holds for all data.
  double plausible_effect = 0;
  /// Ids of mechanisms with a similar effect; an explanation names them.
  std::vector<std::string> look_alikes = {};
  /// The experiment that tells it from its look-alikes.
  std::string isolated_by = {};
  /// Source of formula and range.
  std::string reference = {};
  /// The group that it belongs to in results.
  Origin origin = Origin::by_stage;
  /// Whether it acts along directions of the material, as fibres and muscle do. Diagnosis leaves it out where the base
  /// model is isotropic, unless it is asked for by name.
  bool directional = false;
  /// Whether several of it side by side say more than one, as several relaxation times do. Diagnosis then tries a
  /// second one where the first leaves more than noise.
  bool several = false;
  /// Whether a row depends on the rows before it, so that their order matters. Every mechanism of the stage `history`
  /// has memory; those of later stages say so here, and then wrap the others of their stage.
  bool memory = false;
  /// Options of its object in the experiment file.
  std::vector<Option> options = {};
  /// Options of the test that it needs, as sizes above 0 in the file, for example a length. Diagnosis does not look for
  /// it where one is 0, and says so.
  std::vector<std::string> sizes = {};

  /// Something wrong in the record of tests, by an amplitude that was fitted.
  struct Misrecorded {
    std::string tests;      ///< quoted: "'a' and 'b'"
    std::string direction;  ///< "axial " of a sheet whose directions err by themselves; "" otherwise
    double amplitude;       ///< in the unit of its parameter
  };
  /// Set where a calibration of the rig settles the matter: what an amplitude means, in words without a full stop.
  /// Diagnosis then also asks whether all tests were recorded so, as a question about the file.
  std::function<std::string(const Misrecorded&)> calibration = {};
  /// Whether it is such a question only, because it can do what a stiffer material does. Otherwise it is a cause in the
  /// rig as well, in single tests.
  bool question_only = false;
  /// Whether its option "channel" has to name one, so that each channel has an amplitude of its own.
  bool by_channel = false;

  /// In place of wrap_test: the name of a parameter that tests have themselves, a native imperfection. It rests at its
  /// null unless this mechanism frees it. An option that the test declares too overrides the test's.
  std::string native = {};
  /// Whether diagnosis also tries one common amplitude in all tests that it applies to.
  bool shared = false;
  /// Values of nuisance parameters and of number options, by name.
  using Setting = std::vector<std::pair<std::string, double>>;
  /// Where diagnosis looks for the effect: one search for each setting. Empty: every nuisance parameter at its initial
  /// value; those in s from the shortest time step to the duration of the data.
  std::vector<Setting> scan = {};

  /// Wraps a model, for the stages invariants to history. Throws InputError if it cannot apply, for example without
  /// fibre parts.
  std::function<std::unique_ptr<Model>(std::unique_ptr<Model>, const Options&)> wrap_model = {};
  /// Wraps a test, for the stages test and data. Throws InputError if it cannot apply. Beside its own options it gets
  /// those of the test, under names that it does not declare itself.
  std::function<std::unique_ptr<Test>(std::unique_ptr<Test>, const Options&)> wrap_test = {};

  /// Whether its options are those of a term of the energy, as `added_term` documents them. Discovery adds what it
  /// finds to a model by the mechanism with this role.
  bool writes_terms = false;
  /// Optional, for a mechanism of models that finite-element programs have as an energy of the volume: that energy at
  /// these values of its own parameters. Throws InputError where no program has it with these options.
  std::function<CardVolume(const Options&, std::span<const double>)> card_volume = {};

  /// The parameters of an object with these options.
  [[nodiscard]] std::vector<Parameter> parameters_with(const Options& with) const {
    return parameters_of ? parameters_of(with) : parameters;
  }
};

}  // namespace tunica
