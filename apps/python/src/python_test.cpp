// SPDX-License-Identifier: Apache-2.0
#include "python_test.hpp"

#include <algorithm>
#include <utility>

#include "arrays.hpp"
#include "differences.hpp"
#include "evaluation.hpp"
#include "tunica/tests/decorated_test.hpp"

namespace tunica::python {

namespace py = pybind11;

namespace {

py::list arrays_of(const std::vector<std::span<const double>>& columns) {
  py::list arrays;
  for (const auto& column : columns) arrays.append(array_of(column));
  return arrays;
}

Status take(const py::object& answer, std::span<double> into) {
  const auto values = answer.cast<Array>();
  if (static_cast<std::size_t>(values.size()) != into.size())
    return Status::failed(
        fmt::format("found {} predictions, expected one a channel and row, {}", values.size(), into.size()));
  std::copy_n(values.data(), into.size(), into.begin());
  return {};
}

}  // namespace

PythonTest::PythonTest(const std::string& type, TestDescription description, const TestSetup& setup, Kept object)
    : owner_("test '" + type + "'"), description_(std::move(description)), object_(std::move(object)) {
  rows_ = setup.rows;
  time_.assign(setup.rows.time.begin(), setup.rows.time.end());
  rows_.time = time_;
  for (const auto& column : setup.rows.abscissae) columns_.emplace_back(column.values.begin(), column.values.end());
  for (std::size_t k = 0; k < columns_.size(); ++k) rows_.abscissae[k].values = columns_[k];
}

Status PythonTest::values(const TestInput& input, std::span<double> into) const {
  return guarded_call(owner_, [&] {
    const auto material = std::make_shared<MaterialOfTest>(input);
    try {
      const py::object answer =
          object_.get().attr("predict")(material, arrays_of(abscissae(input, rows_)), array_of(input.test_parameters));
      material->expire();
      return take(answer, into);
    } catch (...) {
      material->expire();
      throw;
    }
  });
}

Status PythonTest::predict(const TestInput& input, const TestOutput& output) const {
  std::vector<double> own(output.values.empty() ? rows_.count * rows_.channels.size() : 0);
  const std::span<double> here = output.values.empty() ? std::span<double>(own) : output.values;
  if (Status status = values(input, here); !status.ok()) return status;
  if (!output.jacobian.empty())
    if (Status status = differences(input, here, output.jacobian); !status.ok()) return status;
  if (!output.abscissa_derivative.empty()) return by_abscissae(input, output.abscissa_derivative);
  return {};
}

Status PythonTest::differences(const TestInput& input, std::span<const double> here, std::span<double> jacobian) const {
  std::vector<double> material(input.model_parameters.begin(), input.model_parameters.end()),
      own(input.test_parameters.begin(), input.test_parameters.end());
  TestInput moved = input;
  moved.model_parameters = material;
  moved.test_parameters = own;
  const auto column_of = [&](std::size_t j) { return jacobian.subspan(j * here.size(), here.size()); };
  const auto moving = [&](double& parameter) {
    return [&, value = parameter](double offset, std::span<double> into) {
      parameter = value + offset;
      Status status = values(moved, into);
      parameter = value;
      return status;
    };
  };
  const auto& declared = input.model.describe().parameters;
  for (std::size_t j = 0; j < material.size(); ++j) {
    // At 0 of a parameter that cannot be negative the other side may not exist.
    const bool at_end = material[j] == 0;
    const double range = j < declared.size() ? declared[j].max - declared[j].min : 1;
    const double h = step_on(at_end ? 0.01 * range : std::abs(material[j]));
    const bool below = !at_end || j >= declared.size() || declared[j].min < 0;
    if (Status status = difference(moving(material[j]), h, true, below, here, column_of(j)); !status.ok())
      return status;
  }
  for (std::size_t j = 0; j < own.size(); ++j) {
    const Parameter& parameter = description_.parameters[j];
    const double h = step_on(std::max(std::abs(own[j]), 0.01 * (parameter.max - parameter.min)));
    const bool above = own[j] + h <= parameter.max;
    Status status = difference(moving(own[j]), h, above, own[j] - h >= parameter.min || !above, here,
                               column_of(material.size() + j));
    if (!status.ok()) return status;
  }
  return {};
}

Status PythonTest::by_abscissae(const TestInput& input, std::span<double> derivative) const {
  const auto columns = abscissae(input, rows_);
  const std::size_t size = rows_.count * rows_.channels.size();
  for (std::size_t a = 0; a < columns.size(); ++a) {
    double largest = 0;
    for (const double value : columns[a]) largest = std::max(largest, std::abs(value));
    const Moved moved = [&](double offset, std::span<double> into) {
      std::vector<double> shifted(columns[a].begin(), columns[a].end());
      for (double& value : shifted) value += offset;
      auto all = columns;
      all[a] = shifted;
      TestInput other = input;
      other.abscissae = all;
      return values(other, into);
    };
    Status status =
        difference(moved, step_on(largest > 0 ? largest : 1), true, true, {}, derivative.subspan(a * size, size));
    if (!status.ok()) return status;
  }
  return {};
}

PythonReadings::PythonReadings(const MechanismFactory& mechanism, std::unique_ptr<Test> base, Kept object)
    : owner_("mechanism '" + mechanism.id + "'"),
      base_(std::move(base)),
      description_(base_->describe()),
      own_(description_.parameters.size()),
      null_(mechanism.null),
      object_(std::move(object)) {
  for (const Parameter& parameter : mechanism.parameters) {
    description_.parameters.push_back(parameter);
    description_.nulls.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  description_.nulls[own_] = null_;
}

TestInput PythonReadings::bare(TestInput input) const {
  input.test_parameters = input.test_parameters.first(own_);
  return input;
}

Status PythonReadings::agreement(const TestInput& input, std::vector<Agreement>& found) const {
  return base_->agreement(bare(input), found);
}

Status PythonReadings::snapshots(const TestInput& input, std::span<const std::size_t> rows,
                                 std::vector<Snapshot>& found) const {
  return base_->snapshots(bare(input), rows, found);
}

Status PythonReadings::read(const TestInput& input, std::span<const double> values, std::span<const double> own,
                            std::span<double> into) const {
  return guarded_call(owner_, [&] {
    const auto& rows = base_->rows();
    return take(object_.get().attr("readings")(matrix_of(values, rows.channels.size(), rows.count),
                                               arrays_of(abscissae(input, rows)), array_of(own)),
                into);
  });
}

// ∂f(v)/∂p = d/ds f(v + s ∂v/∂p) at s = 0: a difference along the column.
Status PythonReadings::chain(const TestInput& input, std::span<const double> values, std::span<double> column) const {
  const auto own = input.test_parameters.subspan(own_);
  double size = 0, length = 0;
  for (const double value : values) size = std::max(size, std::abs(value));
  for (const double value : column) length = std::max(length, std::abs(value));
  if (length == 0) return {};
  const std::vector<double> direction(column.begin(), column.end());
  const Moved moved = [&](double offset, std::span<double> into) {
    std::vector<double> shifted(values.begin(), values.end());
    for (std::size_t i = 0; i < shifted.size(); ++i) shifted[i] += offset * direction[i];
    return read(input, shifted, own, into);
  };
  return difference(moved, step_on((size > 0 ? size : 1) / length), true, true, {}, column);
}

Status PythonReadings::by_own(const TestInput& input, std::span<const double> values, std::span<const double> here,
                              std::span<double> jacobian) const {
  std::vector<double> own(input.test_parameters.begin() + static_cast<std::ptrdiff_t>(own_),
                          input.test_parameters.end());
  for (std::size_t j = 0; j < own.size(); ++j) {
    const Parameter& parameter = description_.parameters[own_ + j];
    const double at = own[j], h = step_on(std::max(std::abs(at), 0.01 * (parameter.max - parameter.min)));
    const bool above = at + h <= parameter.max;
    const Moved moved = [&](double offset, std::span<double> into) {
      own[j] = at + offset;
      Status status = read(input, values, own, into);
      own[j] = at;
      return status;
    };
    Status status = difference(moved, h, above, at - h >= parameter.min || !above, here,
                               jacobian.subspan(j * here.size(), here.size()));
    if (!status.ok()) return status;
  }
  return {};
}

Status PythonReadings::predict(const TestInput& input, const TestOutput& output) const {
  const std::size_t size = base_->rows().channels.size() * base_->rows().count;
  const auto own = input.test_parameters.subspan(own_);
  const bool at_null = own.front() == null_;
  const std::size_t of_base = output.jacobian.empty() ? 0 : output.jacobian.size() - own.size() * size;
  std::vector<double> values(size), here(size);
  TestOutput inner = output;
  inner.values = values;
  inner.jacobian = output.jacobian.first(of_base);
  if (Status status = base_->predict(bare(input), inner); !status.ok()) return status;
  here = values;
  if (!at_null)
    if (Status status = read(input, values, own, here); !status.ok()) return status;
  if (!output.values.empty()) std::ranges::copy(here, output.values.begin());
  for (std::size_t k = 0; k < of_base && !at_null; k += size)
    if (Status status = chain(input, values, output.jacobian.subspan(k, size)); !status.ok()) return status;
  for (std::size_t k = 0; k < output.abscissa_derivative.size() && !at_null; k += size)
    if (Status status = chain(input, values, output.abscissa_derivative.subspan(k, size)); !status.ok()) return status;
  return output.jacobian.empty() ? Status() : by_own(input, values, here, output.jacobian.subspan(of_base));
}

}  // namespace tunica::python
