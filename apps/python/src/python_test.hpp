// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kept.hpp"
#include "tunica/mechanism.hpp"
#include "tunica/test.hpp"

namespace tunica::python {

/// A test written in Python: an object with
///
///   predict(material, abscissae, own)  MaterialOfTest, a list of arrays, an array of the test's parameters
///
/// whose answer has c·n numbers in the layout of TestOutput::values. Derivatives are central differences of it, of
/// about 1e-9 of a column: one-sided at a bound of the test's own parameters, relative to the parameter's size for
/// those of the model. Those by an abscissa move all rows at once, so a row may depend on its own abscissa only.
class PythonTest final : public Test {
 public:
  PythonTest(const std::string& type, TestDescription description, const TestSetup& setup, Kept object);
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput& input, const TestOutput& output) const override;

 private:
  Status values(const TestInput& input, std::span<double> into) const;
  Status differences(const TestInput& input, std::span<const double> here, std::span<double> jacobian) const;
  Status by_abscissae(const TestInput& input, std::span<double> derivative) const;

  std::string owner_;
  TestDescription description_;
  std::vector<std::vector<double>> columns_;
  std::vector<double> time_;
  TestRows rows_;
  Kept object_;
};

/// A mechanism written in Python around a test: an object with
///
///   readings(values, abscissae, own)  (c, n) array of predictions, a list of arrays, an array of its parameters
///
/// whose answer are the changed predictions. At the null of the first parameter the base answers alone.
class PythonReadings final : public Test {
 public:
  PythonReadings(const MechanismFactory& mechanism, std::unique_ptr<Test> base, Kept object);
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override;
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override;
  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override;

 private:
  [[nodiscard]] TestInput bare(TestInput input) const;
  /// The readings of these predictions with these own parameters.
  Status read(const TestInput& input, std::span<const double> values, std::span<const double> own,
              std::span<double> into) const;
  /// Turns a derivative of the base's predictions into one of the readings.
  Status chain(const TestInput& input, std::span<const double> values, std::span<double> column) const;
  Status by_own(const TestInput& input, std::span<const double> values, std::span<const double> here,
                std::span<double> jacobian) const;

  std::string owner_;
  std::unique_ptr<Test> base_;
  TestDescription description_;
  std::size_t own_;  ///< where the own parameters begin
  double null_;
  Kept object_;
};

}  // namespace tunica::python
