// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "calibration/fakes.hpp"
#include "discovery/set_fit.hpp"

namespace tunica::trial {

/// A law that adds its amplitude times a number to all rows of a block.
struct MadeUpLaw {
  std::function<double(std::size_t block, double shape)> effect;
  std::string shape = {};                                        ///< the name of a parameter beside the amplitude
  std::vector<std::function<double(std::size_t)>> heights = {};  ///< of further amplitudes, "c_2", "c_3", …
};

/// How it is measured.
struct Measuring {
  std::vector<double> back = {};  ///< levels of as many rows more, on the way back
  bool two_channels = false;      ///< the other one shows ten times as much, with ten times the noise
  double sd = 0;                  ///< of noise that there is; the file states 1
  std::uint64_t seed = 1;
};

/// Energies that are made of such laws, from nothing, and data with noise of 1: blocks of ten rows, each at one level.
/// Laws of different blocks do not know of each other, so that |r|² falls by what each takes.
class MadeUpTerms : public fakes::Bench {
 public:
  /// `laws` by name, those of powers of the stretches under the name of their parameter, those of fibres of a family by
  /// both names if they differ. "rig" is the effect of a mechanism "rig_error" of the test, "stiffer" that of a
  /// mechanism "stiffening" of the energy.
  MadeUpTerms(const std::vector<double>& levels, std::map<std::string, MadeUpLaw> laws, const Measuring& how = {});

  /// A kind of an invariant of its own unless it is named, with the law of that name.
  [[nodiscard]] discovery::KindPointer kind(const std::string& name, const std::string& law, double log_prior = 0,
                                            const std::string& invariant = "I1", const std::string& family = "") const;
  /// A power of the stretches; exponents begin at −3 where its amplitude is negative, else at 3.
  [[nodiscard]] discovery::KindPointer power(const std::string& name, bool negative, double log_prior = 0) const;
  /// The set of these kinds at these free parameters, with residuals and Jacobian there.
  [[nodiscard]] discovery::SetFit at(const std::vector<discovery::KindPointer>& kinds,
                                     const std::vector<double>& free) const;
  /// The experiment with a model of one term of this law, whose amplitude is free.
  [[nodiscard]] experiment::Experiment with_base(const std::string& law) const;
  /// How often an energy of these terms was made, by their names.
  [[nodiscard]] std::map<std::vector<std::string>, int> made() const;
  void forget() const;

  diagnosis::Evidence evidence;
  std::shared_ptr<const discovery::Subject> subject;
  std::unique_ptr<const discovery::Fitter> fitter;

 private:
  void register_all();
  [[nodiscard]] std::unique_ptr<Model> make(const Options& options) const;
  [[nodiscard]] const MadeUpLaw& law_of(const std::string& invariant, const std::string& family,
                                        const std::string& law) const;

  std::map<std::string, MadeUpLaw> laws_;
  mutable std::map<std::vector<std::string>, int> made_;
  mutable std::mutex mutex_;
};

/// 1 in these blocks, and 0 elsewhere.
MadeUpLaw in_blocks(const std::vector<std::size_t>& blocks);
/// These numbers in blocks 0, 1, …, and 0 behind them.
MadeUpLaw over_blocks(const std::vector<double>& values);

}  // namespace tunica::trial
