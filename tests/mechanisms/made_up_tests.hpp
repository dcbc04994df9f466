// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "tunica/test.hpp"

namespace tunica::testing {

/// A test that passes everything on; those below change one thing.
class PassedOnTest : public Test {
 public:
  explicit PassedOnTest(std::unique_ptr<Test> base)
      : base_(std::move(base)), description_(base_->describe()), rows_(base_->rows()) {}
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    return base_->predict(input, output);
  }

 protected:
  [[nodiscard]] std::size_t size() const { return rows_.channels.size() * rows_.count; }

  std::unique_ptr<Test> base_;
  TestDescription description_;
  TestRows rows_;
};

/// The same test with a temperature in front of its abscissa, on which nothing depends.
class BesideATemperature final : public PassedOnTest {
 public:
  explicit BesideATemperature(std::unique_ptr<Test> base)
      : PassedOnTest(std::move(base)), temperature_(rows_.count, 37.0) {
    rows_.abscissae.insert(rows_.abscissae.begin(), {"temperature", temperature_});
  }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    TestInput bare = input;
    TestOutput inner = output;
    if (!input.abscissae.empty()) bare.abscissae = input.abscissae.subspan(1);
    if (!output.abscissa_derivative.empty()) {
      std::fill_n(output.abscissa_derivative.begin(), size(), 0.0);
      inner.abscissa_derivative = output.abscissa_derivative.subspan(size());
    }
    return base_->predict(bare, inner);
  }

 private:
  std::vector<double> temperature_;
};

/// The same test, in front of which somebody listens to what it is asked; what they return is the answer if it is a
/// failure.
class OverheardTest final : public PassedOnTest {
 public:
  using Listener = std::function<Status(const TestInput&, const TestOutput&)>;
  OverheardTest(std::unique_ptr<Test> base, Listener listener, bool costly = false)
      : PassedOnTest(std::move(base)), listener_(std::move(listener)) {
    description_.costly = costly;
  }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (Status status = listener_(input, output); !status.ok()) return status;
    return base_->predict(input, output);
  }

 private:
  Listener listener_;
};

/// Its channels times a factor, an ordinary parameter in front of its own, which begins at `start`.
class TimesAFactor final : public PassedOnTest {
 public:
  explicit TimesAFactor(std::unique_ptr<Test> base, double start = 1) : PassedOnTest(std::move(base)) {
    description_.parameters.insert(description_.parameters.begin(),
                                   {"factor", "1", start, 0, 3, Scale::linear, "", ""});
    description_.nulls.insert(description_.nulls.begin(), std::numeric_limits<double>::quiet_NaN());
  }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    TestInput bare = input;
    bare.test_parameters = input.test_parameters.subspan(1);
    const Status status = base_->predict(bare, {output.values, {}, {}, {}});
    for (double& value : output.values) value *= input.test_parameters[0];
    return status;
  }
};

}  // namespace tunica::testing
