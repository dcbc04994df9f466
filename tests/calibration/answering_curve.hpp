// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "plugins/catalogue.hpp"
#include "tunica/test.hpp"

/// The fake test "curve", which also says how far it is from other solutions, and what is inside of it.
namespace tunica::fakes {

class AnsweringCurve final : public Test {
 public:
  using Agreeing = std::function<Status(std::vector<Agreement>&)>;
  AnsweringCurve(std::unique_ptr<Test> base, Agreeing agreeing)
      : base_(std::move(base)), agreeing_(std::move(agreeing)) {}

  [[nodiscard]] const TestDescription& describe() const override { return base_->describe(); }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    return base_->predict(input, output);
  }
  Status agreement(const TestInput&, std::vector<Agreement>& found) const override {
    return agreeing_ ? agreeing_(found) : Status{};
  }
  /// A section of two points with the stress of the row's number.
  Status snapshots(const TestInput&, std::span<const std::size_t> rows, std::vector<Snapshot>& found) const override {
    for (const std::size_t row : rows) {
      Snapshot one;
      one.row = row;
      one.section = {{"radius", "mm", {1, 2}}, {"stress", "kPa", {1.0 * static_cast<double>(row), 7}}};
      found.push_back(std::move(one));
    }
    return {};
  }

 private:
  std::unique_ptr<Test> base_;
  Agreeing agreeing_;
};

/// Adds it to a shelf that has the fakes, under the name "answering_curve".
inline void add_answering_curve(plugins::Catalogue& shelf, AnsweringCurve::Agreeing agreeing = {}) {
  TestFactory factory = shelf.tests().at("curve").factory;
  factory.type = "answering_curve";
  factory.create = [create = factory.create, agreeing = std::move(agreeing)](const TestSetup& setup) {
    return std::make_unique<AnsweringCurve>(create(setup), agreeing);
  };
  plugins::Catalogue::Registration stage;
  stage.add(std::move(factory));
  shelf.commit(std::move(stage), "answers 1");
}

}  // namespace tunica::fakes
