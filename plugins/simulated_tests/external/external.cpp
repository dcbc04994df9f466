// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "curve.hpp"
#include "observables.hpp"
#include "solver.hpp"
#include "tunica/plugin.hpp"

namespace tunica::external {
namespace {

/// A program outside of tunica that simulates an experiment: finite elements, a script, anything that reads and writes
/// files.
class External final : public Test {
 public:
  explicit External(const TestSetup& setup)
      : solver_(read_settings(setup, observables())), unit_factor_(setup.unit_factor), card_(setup.card) {
    for (const auto& column : setup.rows.abscissae) columns_.emplace_back(column.values.begin(), column.values.end());
    for (std::size_t k = 0; k < columns_.size(); ++k)
      rows_.abscissae.push_back({setup.rows.abscissae[k].observable, columns_[k]});
    time_.assign(setup.rows.time.begin(), setup.rows.time.end());
    rows_.count = setup.rows.count;
    rows_.channels = setup.rows.channels;
    rows_.time = time_;
    const std::string& derivatives = setup.options.text("derivatives");
    description_.costly = true;
    description_.volume = TestDescription::Volume::either;  // J is the other program's
    description_.differencing = {setup.options.number("difference_step"), derivatives == "central",
                                 derivatives == "broyden"};
    if (!solver_.settings().card) description_.reads = solver_.settings().reads;
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  [[nodiscard]] std::vector<Effort> efforts() const override { return solver_.efforts(); }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (!output.jacobian.empty()) return Status::failed("external: the solver gives no derivatives");
    const auto value = [&](const TextTemplate::Place& place) { return filled_in(place, input); };
    std::variant<Numbers, std::string> found;
    try {
      found = solver_.solve(value);
    } catch (const InputError& problem) {
      return Status::failed(fmt::format("external: {}", problem.what()));
    }
    if (const auto* problem = std::get_if<std::string>(&found)) return Status::failed("external: " + *problem);
    const Numbers& numbers = std::get<Numbers>(found);
    return solver_.settings().curve ? from_curve(numbers, input, output) : row_by_row(numbers, output);
  }

 private:
  std::string filled_in(const TextTemplate::Place& place, const TestInput& input) const {
    if (place.name == "card") return card_(input.model, input.model_parameters, solver_.settings().card_request);
    if (place.name == "rows") return table(input);
    const auto& parameters = input.model.describe().parameters;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      if (parameters[j].name != place.name) continue;
      return number(input.model_parameters[j] * factor(place, parameters[j]));
    }
    throw InputError(fmt::format("a template has a place for '{}', which is no parameter of the model '{}'", place.name,
                                 input.model.describe().type));
  }

  double factor(const TextTemplate::Place& place, const Parameter& parameter) const {
    if (place.unit.empty() || place.unit == parameter.unit) return 1;
    try {
      return unit_factor_(parameter.unit, place.unit);
    } catch (const InputError& problem) {
      throw InputError(fmt::format("a template asks for {{{{{} {}}}}}, and {}; correct the unit there", place.name,
                                   place.unit, problem.what()));
    }
  }

  /// The abscissae in base units, a line a row.
  std::string table(const TestInput& input) const {
    std::string text;
    for (std::size_t i = 0; i < rows_.count; ++i) {
      std::vector<std::string> cells;
      for (std::size_t a = 0; a < columns_.size(); ++a)
        cells.push_back(number(input.abscissae.empty() ? columns_[a][i] : input.abscissae[a][i]));
      text += fmt::format("{}\n", fmt::join(cells, ", "));
    }
    return text;
  }

  Status row_by_row(const Numbers& numbers, const TestOutput& output) const {
    if (!output.abscissa_derivative.empty())
      return Status::failed("external: no derivatives by the abscissa where \"results\" name none");
    for (std::size_t k = 0; k < rows_.channels.size(); ++k) {
      if (numbers[k].size() != rows_.count)
        return Status::failed(fmt::format(
            "external: the solver wrote {} numbers of '{}' for {} rows; name the abscissa in \"results\" if "
            "its points are its own",
            numbers[k].size(), rows_.channels[k], rows_.count));
      if (!output.values.empty())
        std::ranges::copy(numbers[k], output.values.begin() + static_cast<std::ptrdiff_t>(k * rows_.count));
    }
    return {};
  }

  Status from_curve(const Numbers& numbers, const TestInput& input, const TestOutput& output) const {
    const std::string& name = solver_.settings().results.front().observable;
    const auto among = std::ranges::find(rows_.abscissae, name, &TestRows::Column::observable);
    const auto a = static_cast<std::size_t>(among - rows_.abscissae.begin());
    const std::size_t n = rows_.count, channels = rows_.channels.size();
    const std::span<const double> at =
        input.abscissae.empty() ? std::span<const double>(columns_[a]) : input.abscissae[a];
    if (!output.abscissa_derivative.empty()) std::ranges::fill(output.abscissa_derivative, 0.0);
    for (std::size_t k = 0; k < channels; ++k) {
      const Curve curve(numbers[0], numbers[k + 1]);
      if (!curve.problem().empty())
        return Status::failed(fmt::format("external: the solver's curve of '{}' over '{}': {}", rows_.channels[k], name,
                                          curve.problem()));
      for (std::size_t i = 0; i < n; ++i) {
        if (!curve.reaches(at[i]))
          return Status::failed(
              fmt::format("external: row {} lies at {} {:.6g}, and the solver's curve goes from {:.6g} "
                          "to {:.6g}; let it go further, or give \"start\" if it leaves out the "
                          "unloaded state",
                          i, name, at[i], curve.first(), curve.last()));
        if (!output.values.empty()) output.values[k * n + i] = curve(at[i]);
        if (!output.abscissa_derivative.empty())
          output.abscissa_derivative[(a * channels + k) * n + i] = curve.slope(at[i]);
      }
    }
    return {};
  }

  Solver solver_;
  std::function<double(std::string_view, std::string_view)> unit_factor_;
  std::function<std::string(const Model&, std::span<const double>, const CardRequest&)> card_;
  std::vector<std::vector<double>> columns_;
  std::vector<double> time_;
  TestRows rows_;
  TestDescription description_;
};

TestFactory factory() {
  return {"external",
          "Any program: parameters go into its input files, and results come from its output files.",
          "",
          options(),
          observables(),
          [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<External>(setup); }};
}

}  // namespace
}  // namespace tunica::external

TUNICA_PLUGIN("external", TUNICA_PLUGIN_VERSION) { registry.add(tunica::external::factory()); }
