// SPDX-License-Identifier: Apache-2.0
#include "data/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "data/csv.hpp"
#include "data/curves.hpp"
#include "data/nearest.hpp"
#include "data/quantities.hpp"
#include "data/row_choice.hpp"
#include "data/table_file.hpp"
#include "data/units.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

using Role = Observable::Role;
using From = Quantity::Kind;

/// A balance says gram where it means the weight of one.
std::string weight_unit(std::string_view unit, std::string_view base) {
  const bool mass = unit == "g" || unit == "kg" || unit == "mg";
  return std::string(unit) + (mass && base == "mN" ? "f" : "");
}

/// Time on a path run at constant rate: t_i = t_{i−1} + |x_i − x_{i−1}|/rate, from rest (stretch 1, else 0) at t = 0.
/// The path is that of all rows left after `where`, so that thinning them out with `rows` does not shorten cycles.
std::vector<double> time_along(const std::vector<double>& path, double rest, double rate) {
  std::vector<double> time;
  double now = 0, last = rest;
  for (const double x : path) {
    now += std::abs(x - last) / rate;
    time.push_back(now);
    last = x;
  }
  return time;
}

/// The step between values that are whole multiples of it, within what a conversion of units leaves of a digit.
Grid grid_of(std::vector<double> values, const std::string& unit) {
  constexpr double same = 1e-9, off = 0.01;
  std::erase_if(values, [](double value) { return std::isnan(value); });
  std::sort(values.begin(), values.end());
  if (values.empty()) return {};
  const double range = values.back() - values.front();
  const auto equal = [&](double a, double b) { return b - a <= same * range; };
  values.erase(std::unique(values.begin(), values.end(), equal), values.end());
  double step = range;
  for (std::size_t k = 1; k < values.size(); ++k) step = std::min(step, values[k] - values[k - 1]);
  for (const double value : values) {
    const double steps = (value - values.front()) / step;
    if (!(std::abs(steps - std::round(steps)) <= off)) return {};
  }
  return {step, range, values.size(), unit};
}

/// One file on its way to a series.
class Reader {
 public:
  Reader(const std::filesystem::path& file, const DataRequest& request, const std::vector<Observable>& observables,
         std::vector<std::string>& warnings)
      : request_(request),
        observables_(observables),
        warnings_(warnings),
        table_(table_file(file, request.layout)),
        csv_(table_->csv) {
    series_.file = file;
    series_.sha256 = table_->sha256;
    series_.header_line = csv_.header_line;
  }

  Series read() {
    map_columns();
    rows_ = rows_where(csv_, request_);
    const std::vector<std::size_t> chosen = cycles();
    std::vector<std::size_t> selected = rows_in_range(csv_, request_.rows, chosen.size(), warnings_);
    for (std::size_t& row : selected) row = chosen[row];
    take_gauge_lengths();
    for (const std::size_t row : selected) series_.lines.push_back(rows_[row]->line);
    for (std::size_t k = 0; k < series_.columns.size(); ++k)
      for (const std::size_t row : selected) series_.columns[k].values.push_back(value_or_nan(k, *rows_[row]));
    series_.used_lines = series_.lines;
    series_.file_rows = csv_.rows.size();
    for (std::size_t k = 0; k < series_.columns.size(); ++k)
      if (series_.columns[k].observable->role == Role::channel)
        series_.columns[k].grid = grid_of(series_.columns[k].values, quantities_[k].unit);
    take_time(selected);
    derive_stretches();
    derive_stresses();
    return std::move(series_);
  }

 private:
  void map_columns() {
    std::vector<std::size_t> indices;
    for (const auto& [name, column] : request_.columns) {
      const std::size_t index = csv_.column(column);
      indices.push_back(index);
      const Csv::Column& header = csv_.columns[index];
      quantities_.push_back(*quantity_named(name, observables_));
      const Quantity& quantity = quantities_.back();
      series_.columns.push_back(
          {quantity.observable,
           index,
           header.name,
           weight_unit(header.unit.value_or(unit_in_name(header.name, quantity.unit)), quantity.unit),
           {},
           quantity.kind != From::own});
      in_base_unit(quantities_.size() - 1, 1);  // a wrong unit is reported before the first wrong cell
      if (series_.columns.back().unit.empty() && quantity.unit != "1")
        warnings_.push_back(fmt::format("{}: the header gives no unit; {} is assumed. Write '{} [{}]'.",
                                        series_.header_place(series_.columns.back()), quantity.unit, header.name,
                                        quantity.unit));
      if (series_.columns.back().unit.empty() && is_plain_number(quantity))
        warnings_.push_back(fmt::format(
            "{}: '{}' is a plain number, and the column has no unit. Are data and prediction in the same one? "
            "Say with \"units\": {{\"{}\": \"1\"}} that they are",
            series_.header_place(series_.columns.back()), name, header.name));
    }
    decimal_ = csv_.decimal_mark(indices);
    turn_signs();
  }

  /// A measured number whose meaning only the file gives.
  static bool is_plain_number(const Quantity& quantity) {
    return quantity.kind == From::own && quantity.observable->role == Role::channel &&
           quantity.observable->kind == Observable::Kind::plain && quantity.unit == "1";
  }

  /// Tension is positive here, whatever the convention of the file.
  void turn_signs() {
    const CompressionPositive& compression = request_.compression;
    for (std::size_t k = 0; k < quantities_.size(); ++k)
      series_.columns[k].turned = compression.all && is_signed(quantities_[k]);
    for (const std::string& name : compression.columns) {
      const std::size_t index = csv_.column(name);
      bool found = false;
      for (std::size_t k = 0; k < quantities_.size(); ++k)
        if (series_.columns[k].index == index && is_signed(quantities_[k])) found = series_.columns[k].turned = true;
      if (!found)
        throw InputError(fmt::format(
            "{}: \"compression\" names this column, and it is not read as a force, a stress, a displacement "
            "or a strain. Leave it out there, or correct \"columns\".",
            csv_.place(csv_.header_line, index)));
    }
  }

  // The factor is asked for once a cell: units like degrees Celsius have an offset.
  double in_base_unit(std::size_t k, double value) const {
    const Series::Column& column = series_.columns[k];
    const Quantity& quantity = quantities_[k];
    try {
      return convert(value, column.unit.empty() ? quantity.unit : column.unit, quantity.unit);
    } catch (const InputError& error) {
      std::string reason = error.what();
      while (!reason.empty() && reason.back() == '.') reason.pop_back();
      if (is_plain_number(quantity))
        throw InputError(fmt::format(
            "{}: {}, and '{}' is compared as it is. Write \"units\": {{\"{}\": \"1\"}}, and let the prediction "
            "be in {}.",
            series_.header_place(column), reason, request_.columns[k].first, column.name, column.unit));
      throw InputError(fmt::format(
          "{}: {}. The {} '{}' is in {}: correct the unit in the header.", series_.header_place(column), reason,
          quantity.kind == From::own ? "observable" : "quantity", request_.columns[k].first, quantity.unit));
    }
  }

  double value(std::size_t k, const Csv::Row& row) const {
    const double value = in_base_unit(k, csv_.number(row, series_.columns[k].index, decimal_));
    return series_.columns[k].turned ? -value : value;
  }

  static bool is_empty(const std::string& cell) { return cell.empty() || cell == "NaN" || cell == "nan"; }

  /// A row counts for the channels that it has, so one of them may lack. Replicates are averaged row by row.
  bool is_missing(std::size_t k, const Csv::Row& row) const {
    if (quantities_[k].observable->role != Role::channel || request_.files.size() > 1) return false;
    if (!is_empty(row.cells[series_.columns[k].index])) return false;
    for (std::size_t other = 0; other < quantities_.size(); ++other)
      if (quantities_[other].observable->role == Role::channel && !is_empty(row.cells[series_.columns[other].index]))
        return true;
    return false;
  }

  double value_or_nan(std::size_t k, const Csv::Row& row) const {
    return is_missing(k, row) ? std::numeric_limits<double>::quiet_NaN() : value(k, row);
  }

  RawColumn all_rows_of(std::size_t k) const {
    RawColumn column{series_.header_place(series_.columns[k]), {}};
    column.values.reserve(rows_.size());
    for (const Csv::Row* row : rows_) column.values.push_back(value_or_nan(k, *row));
    return column;
  }

  double rest_of(std::size_t k) const {
    const Quantity& quantity = quantities_[k];
    if (quantity.kind == From::length) {
      const auto gauge = sizes_along(request_.specimen, quantity.observable->name).gauge_length;
      return gauge ? *gauge : value(k, *rows_.front());
    }
    return quantity.kind == From::own && quantity.observable->kind == Observable::Kind::stretch ? 1 : 0;
  }

  /// The prescribed column that goes through its range most straightly; a held one shows noise only.
  std::size_t path_column() const {
    std::vector<Prescribed> prescribed;
    std::vector<std::size_t> columns;
    for (std::size_t k = 0; k < quantities_.size(); ++k)
      if (quantities_[k].observable->role == Role::abscissa) {
        prescribed.push_back({request_.columns[k].first, "", all_rows_of(k).values});
        columns.push_back(k);
      }
    if (prescribed.empty())
      throw InputError(
          fmt::format("{}: cycles, branches and a preload need a prescribed quantity, and none is mapped. "
                      "Map one in \"columns\".",
                      csv_.file.string()));
    return columns[abscissa_of(prescribed, "").column];
  }

  std::size_t load_column() const {
    for (std::size_t k = 0; k < quantities_.size(); ++k) {
      const bool force = quantities_[k].unit == "mN", stress = quantities_[k].unit == "kPa";
      if (quantities_[k].observable->role == Role::channel && (request_.preload->is_force ? force : stress)) return k;
    }
    throw InputError(fmt::format("{}: the preload is a {}, and no such column is mapped. Map one in \"columns\".",
                                 csv_.file.string(), request_.preload->is_force ? "force" : "stress"));
  }

  bool has_length(std::size_t k) const {
    return quantities_[k].kind == From::length || quantities_[k].kind == From::displacement;
  }

  bool is_strain(std::size_t k) const {
    const From kind = quantities_[k].kind;
    return kind == From::strain || kind == From::true_strain || kind == From::green_strain;
  }

  void require_length() const {
    for (std::size_t k = 0; k < quantities_.size(); ++k)
      if (has_length(k)) return;
    throw InputError(
        fmt::format("{}: the gauge length is that at the preload, and no column is a length or a "
                    "displacement. Map one in \"columns\".",
                    csv_.file.string()));
  }

  std::vector<std::size_t> cycle_numbers() const {
    std::vector<std::size_t> numbers;
    if (request_.cycles_from.empty()) return numbers;
    const std::size_t column = csv_.column(request_.cycles_from);
    for (const Csv::Row* row : rows_) {
      const auto number = first_number(row->cells[column]);
      if (!number)
        throw InputError(
            fmt::format("{}: found '{}' where the number of a cycle is expected. Leave the row out with "
                        "\"where\", or name another column in \"cycles_from\".",
                        csv_.place(row->line, column), excerpt(row->cells[column])));
      numbers.push_back(*number);
    }
    return numbers;
  }

  /// Positions among the rows left after "where".
  std::vector<std::size_t> cycles() {
    const bool all = request_.branch == BranchChoice::both && !request_.preload &&
                     (!request_.cycle || (!request_.cycle->last && request_.cycle->numbers.empty()));
    if (all) {
      std::vector<std::size_t> rows(rows_.size());
      for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = row;
      return rows;
    }
    const std::size_t column = path_column();
    if (request_.specimen.gauge_at_preload) require_length();
    RawColumn load;
    RawPath path{all_rows_of(column), rest_of(column), nullptr, cycle_numbers()};
    if (request_.preload) {
      load = all_rows_of(load_column());
      path.load = &load;
    }
    ChosenRows chosen = choose_rows(path, request_);
    parted_ = true;
    at_preload_ = chosen.at_preload;
    return std::move(chosen.rows);
  }

  /// Of every direction its own: what is given for it, else its length at the preload.
  void take_gauge_lengths() {
    offsets_.assign(quantities_.size(), 0);
    for (std::size_t k = 0; k < quantities_.size(); ++k) {
      if (!has_length(k)) continue;
      double& gauge = series_.columns[k].gauge_length;
      const auto given = sizes_along(request_.specimen, quantities_[k].observable->name).gauge_length;
      if (given || !request_.specimen.gauge_at_preload || !at_preload_) {
        gauge = required_size(given, k, "gauge_length");
        continue;
      }
      gauge = at_preload_->of(all_rows_of(k).values);
      if (quantities_[k].kind == From::length) continue;
      offsets_[k] = gauge;
      gauge += grip_distance(k);
    }
  }

  double grip_distance(std::size_t k) const {
    const auto grips = sizes_along(request_.specimen, quantities_[k].observable->name).grip_distance;
    if (grips) return *grips;
    throw InputError(
        fmt::format("{}: the gauge length at the preload needs the length at displacement 0. Add "
                    "\"grip_distance\" to \"specimen\".",
                    series_.header_place(series_.columns[k])));
  }

  /// Of a part of a test, time begins with the part.
  void take_time(const std::vector<std::size_t>& selected) {
    const auto path = std::find_if(series_.columns.begin(), series_.columns.end(), [](const Series::Column& column) {
      return column.observable->role == Role::abscissa;
    });
    for (Series::Column& column : series_.columns)
      if (column.observable->role == Role::time && parted_)
        for (double begin = column.values.front(); double& time : column.values) time -= begin;
    if (!request_.time_rate || path == series_.columns.end()) return;
    const auto k = static_cast<std::size_t>(path - series_.columns.begin());
    RawColumn all = all_rows_of(k);
    double rest = rest_of(k);
    if (series_.columns[k].derived) {  // the rate is that of the stretch, or of the shear
      for (double& value : all.values) value = stretch(k, value);
      rest = quantities_[k].kind == From::shear_displacement ? 0 : 1;
    }
    const std::vector<double> time = time_along(all.values, rest, *request_.time_rate);
    for (const std::size_t row : selected) series_.time.push_back(time[row]);
  }

  double required_size(std::optional<double> size, std::size_t k, std::string_view key) const {
    if (size) return *size;
    throw InputError(fmt::format("{}: '{}' needs the size \"{}\" of the specimen. Add it to \"specimen\".",
                                 series_.header_place(series_.columns[k]), request_.columns[k].first, key));
  }

  /// λ = 1 + ΔL/L or ℓ/L with the gauge length L; 1 + ε, exp ε of a true strain, √(1 + 2E) of Green's; γ = d/h
  /// with the height h.
  double stretch(std::size_t k, double value) const {
    const From kind = quantities_[k].kind;
    if (kind == From::strain) return 1 + value;
    if (kind == From::true_strain) return std::exp(value);
    if (kind == From::green_strain) return std::sqrt(1 + 2 * value);
    if (kind == From::shear_displacement) return value / required_size(request_.specimen.height, k, "height");
    const double gauge = series_.columns[k].gauge_length;
    return kind == From::length ? value / gauge : 1 + (value - offsets_[k]) / gauge;
  }

  void derive_stretches() {
    for (std::size_t k = 0; k < series_.columns.size(); ++k)
      if (quantities_[k].kind == From::shear_displacement) {
        for (double& value : series_.columns[k].values) value = stretch(k, value);
      } else if (has_length(k) || is_strain(k)) {
        const From kind = quantities_[k].kind;
        series_.columns[k].elongation = kind == From::displacement || kind == From::strain;
        for (std::size_t row = 0; row < series_.columns[k].values.size(); ++row) {
          double& value = series_.columns[k].values[row];
          if (kind == From::green_strain && !(1 + 2 * value > 0))
            throw InputError(fmt::format(
                "{}: found the Green strain {:g}, and none is -0.5 or less. Correct the cell or the unit, or "
                "map the column to 'strain' or 'true_strain'.",
                series_.place(row, series_.columns[k]), value));
          value = stretch(k, value);
        }
      }
  }

  /// The nominal stress is P = F/(width·thickness); in an incompressible specimen σ = Pλ and S = P/λ. The area of a
  /// plate stays as it is.
  void derive_stresses() {
    for (std::size_t k = 0; k < series_.columns.size(); ++k) {
      const bool on_plate = quantities_[k].kind == From::plate_force;
      if (quantities_[k].kind != From::force && !on_plate) continue;
      const Observable& stress = *quantities_[k].observable;
      const Specimen& specimen = request_.specimen;
      const double area = specimen.area ? *specimen.area
                                        : required_size(sizes_along(specimen, stress.name).width, k, "width") *
                                              required_size(specimen.thickness, k, "thickness");
      for (double& value : series_.columns[k].values) value /= area;
      if (on_plate || request_.stress_measure == "first_piola_kirchhoff") continue;
      const Series::Column& stretch = stretch_of(k, stress);
      for (std::size_t row = 0; row < stretch.values.size(); ++row)
        series_.columns[k].values[row] *=
            request_.stress_measure == "cauchy" ? stretch.values[row] : 1 / stretch.values[row];
    }
  }

  const Series::Column& stretch_of(std::size_t k, const Observable& stress) const {
    const Observable* wanted = stretch_beside(stress, observables_);
    for (const Series::Column& column : series_.columns)
      if (column.observable == wanted) return column;
    throw InputError(fmt::format(
        "{}: '{}' from a force needs the stretch along it, unless \"stress_measure\" is "
        "\"first_piola_kirchhoff\". Map {}, or give that measure.",
        series_.header_place(series_.columns[k]), stress.name, wanted ? "'" + wanted->name + "'" : "the stretch"));
  }

  const DataRequest& request_;
  const std::vector<Observable>& observables_;
  std::vector<std::string>& warnings_;
  std::shared_ptr<const TableFile> table_;
  const Csv& csv_;
  Series series_;
  std::vector<Quantity> quantities_;  ///< by column of the series
  std::vector<const Csv::Row*> rows_;
  char decimal_ = '.';
  bool parted_ = false;  ///< rows are a part of those that match "where"
  std::optional<PathPoint> at_preload_;
  std::vector<double> offsets_;  ///< displacement at the preload, by column
};

}  // namespace

std::string Series::place(std::size_t row, const Column& column) const {
  return fmt::format("{}, line {}, column {} ('{}')", file.string(), lines[row], column.index + 1,
                     excerpt(column.name));
}

std::string Series::header_place(const Column& column) const {
  return fmt::format("{}, line {}, column {} ('{}')", file.string(), header_line, column.index + 1,
                     excerpt(column.name));
}

Series read_series(const std::filesystem::path& file, const DataRequest& request,
                   const std::vector<Observable>& observables, std::vector<std::string>& warnings) {
  Series series = Reader(file, request, observables, warnings).read();
  if (request.resample) resample(series, *request.resample);
  return series;
}

}  // namespace tunica::data
