// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assembly/channel_noise.hpp"
#include "assembly/differing.hpp"
#include "assembly/parameter_id.hpp"
#include "data/dataset.hpp"
#include "experiment/experiment.hpp"
#include "tunica/model.hpp"
#include "tunica/optimizer.hpp"
#include "tunica/parameter.hpp"

namespace tunica::assembly {

/// Bounds that the owner of a parameter declares. Outside them the parameter may have no meaning.
struct DeclaredRange {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool contains(double value) const { return value >= min && value <= max; }
};

/// A parameter that the run searches for, with its outside name: "mu", "viscoelasticity.tau",
/// "circumferential_strip.force_offset.value"; base units.
struct FreeParameter {
  std::string name, unit;
  double min, max, initial;
  Scale scale;
  std::optional<experiment::Prior> prior;
  DeclaredRange declared = {};
  std::vector<ParameterId> places = {};  ///< one; for a share, all parameters that share it
  /// Whether the file sets the bound or the initial value, rather than the owner's default.
  bool own_min = false, own_max = false, own_initial = false;

  /// The kind of a bound: the user's choice, the owner's default, or an end beyond which there is nothing new.
  enum class Bound { chosen, by_default, symmetry, physical };
  [[nodiscard]] Bound kind_of(bool upper) const;
};

struct FixedParameter {
  std::string name, unit;
  double value;
  DeclaredRange declared = {};
};

/// The abscissa of a channel in plots and messages.
struct DrawnOver {
  std::string name, unit;
  std::vector<double> values;       ///< one a row
  std::vector<std::string> curves;  ///< one a row, "stretch_axial = 1.3", of a family of curves; else empty
};

/// One channel of one test: what was measured, and where its rows lie in the vector of all predictions.
struct MeasuredChannel {
  std::string test, observable, unit;
  std::size_t offset = 0, count = 0;  ///< rows [offset, offset + count) of the predictions
  std::vector<double> measured;       ///< count; NaN = not measured
  std::vector<double> abscissa;       ///< count; the test's first abscissa
  std::string abscissa_name, abscissa_unit;
  /// "name [unit]" → count values
  std::vector<std::pair<std::string, std::vector<double>>> other_abscissae;
  DrawnOver drawn_over;                     ///< the abscissa of this channel, see data/curves.hpp
  std::vector<bool> fitted;                 ///< count; false = held out, or not measured
  std::vector<std::size_t> file_rows = {};  ///< count, data::Dataset::file_rows; empty = in the order of the file
  bool changes_volume = false;              ///< of a test whose load changes the volume of every material
  double weight = 1;
  std::optional<data::Noise> noise;  ///< of `measured`, as stated; a mean over m replicates has 1/√m of it
  ChannelNoise sigma = {};           ///< of the fitted rows, stated or not: what everything that needs a noise reads

  /// The number of a row in the file, after `where` and `rows` are applied.
  [[nodiscard]] std::size_t file_row(std::size_t row) const { return file_rows.empty() ? row : file_rows[row]; }
  /// Whether its rows are points of a measured field: "x" and "y" are prescribed.
  [[nodiscard]] bool is_field() const { return coordinate("x") != nullptr && coordinate("y") != nullptr; }
  /// Whether a row is such a point: a force that was measured beside the field has no place.
  [[nodiscard]] bool is_point(std::size_t row) const { return is_field() && std::isfinite((*coordinate("x"))[row]); }
  /// The values of a prescribed quantity; null where there is no such.
  [[nodiscard]] const std::vector<double>* coordinate(std::string_view name) const {
    if (abscissa_name == name) return &abscissa;
    for (const auto& [title, values] : other_abscissae)
      if (title.starts_with(name) && title.substr(name.size()).starts_with(" [")) return &values;
    return nullptr;
  }
  [[nodiscard]] bool held_out(std::size_t row) const { return !fitted[row] && !std::isnan(measured[row]); }
  [[nodiscard]] std::size_t held_out_rows() const {
    std::size_t rows = 0;
    for (std::size_t row = 0; row < count; ++row) rows += held_out(row) ? 1 : 0;
    return rows;
  }
};

/// The contents of a run; nothing here depends on parameter values.
struct Layout {
  std::vector<FreeParameter> parameters;
  std::vector<FixedParameter> fixed_parameters;
  std::vector<MeasuredChannel> channels;
  std::vector<ResidualBlock> blocks;  ///< one a fitted channel, one more for priors
  /// Known invariances of the models, arguments as indices into `parameters`; value() takes the free values.
  std::vector<Combination> combinations;
  std::vector<Differing> differing = {};  ///< parameters with values of their own in a state of the specimen
  std::vector<std::string> warnings;
  std::vector<data::Finding> findings = {};  ///< about the records of the tests, and about the file
  std::vector<std::string> notes;            ///< remarks that are not warnings
  std::vector<std::string> data_hashes;      ///< "circ.csv sha256:…"
  std::size_t test_count = 0;                ///< tests of the run: entries of per_test
  std::size_t prediction_count = 0;          ///< Σ channel counts, held-out rows included
  std::size_t residual_count = 0;            ///< fitted rows and priors
  bool jacobian_is_exact = true;             ///< false: some test's predictions are differenced
  bool derivatives_missing = false;          ///< a differenced test lacks a Differencing declaration
  bool has_costly_tests = false;             ///< some fitted test declares itself costly

  /// The position in `parameters`; none if it is held or unknown.
  [[nodiscard]] std::optional<std::size_t> index_of(const ParameterId& id) const;
};

}  // namespace tunica::assembly
