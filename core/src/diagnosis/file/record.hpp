// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::diagnosis {

/// The experiment with the data of its tests in memory, read once. Corrections reinterpret these data. A copy shares
/// the data until it changes them.
///
/// Noise belongs to the numbers of the file, so a factor on a value also scales its σ. |r|² of two readings of one file
/// is therefore comparable: the Jacobian of the transform is that of the σ.
class Record {
 public:
  /// Reads the data of these tests; their noise has to be stated.
  Record(experiment::Experiment experiment, const std::vector<std::string>& tests, const plugins::Catalogue& catalogue);

  [[nodiscard]] const experiment::Experiment& experiment() const { return experiment_; }
  [[nodiscard]] experiment::Experiment& experiment() { return experiment_; }
  [[nodiscard]] experiment::TestEntry& test(std::string_view name);
  [[nodiscard]] const experiment::TestEntry& test(std::string_view name) const { return experiment_.test(name); }
  [[nodiscard]] const data::Dataset& data(std::string_view test) const { return *experiment_.test(test).data.given; }
  [[nodiscard]] const std::vector<Observable>& observables(std::string_view test) const;

  // Each returns whether the result is a possible measurement; otherwise the record must not be used any more.
  using Map = std::function<double(double)>;
  /// An abscissa, value by value. Stresses that the file has as forces stay the same forces.
  bool map_abscissa(std::string_view test, std::string_view abscissa, const Map& map);
  /// A channel by one factor a row.
  bool scale_channel(std::string_view test, std::string_view channel, const std::vector<double>& factors);
  bool scale_channel(std::string_view test, std::string_view channel, double factor);
  /// A channel by an offset a row.
  bool shift_channel(std::string_view test, std::string_view channel, const std::vector<double>& offsets);
  bool exchange_abscissae(std::string_view test, std::string_view one, std::string_view other);
  /// The numbers of two channels, with their noise.
  bool exchange_channels(std::string_view test, std::string_view one, std::string_view other);
  /// A channel is that of another observable.
  void rename_channel(std::string_view test, const std::string& channel, const std::string& to);
  bool scale_time(std::string_view test, double factor);

 private:
  data::Dataset& own_data(experiment::TestEntry& entry);
  bool set_abscissa(experiment::TestEntry& entry, std::string_view abscissa, std::vector<double> values);

  experiment::Experiment experiment_;
  const plugins::Catalogue* catalogue_;
};

/// The values of an abscissa, null where the data have none of this name.
const std::vector<double>* abscissa_of(const data::Dataset& data, std::string_view name);
const data::Channel* channel_of(const data::Dataset& data, std::string_view name);

/// σ = v λ^power turns the stress v of this measure into Cauchy stress.
int cauchy_power(std::string_view measure);

}  // namespace tunica::diagnosis
