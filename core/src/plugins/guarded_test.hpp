// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "tunica/test.hpp"

namespace tunica::plugins {

/// A test of a plugin that the host need not trust: the counterpart of GuardedModel.
class GuardedTest final : public Test {
 public:
  GuardedTest(std::unique_ptr<Test> test, std::string plugin);
  ~GuardedTest() override;
  GuardedTest(const GuardedTest&) = delete;
  GuardedTest& operator=(const GuardedTest&) = delete;

  [[nodiscard]] const TestDescription& describe() const override { return *description_; }
  [[nodiscard]] const TestRows& rows() const override { return *rows_; }
  Status predict(const TestInput& input, const TestOutput& output) const override;
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override;
  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override;
  [[nodiscard]] std::vector<Effort> efforts() const override;

  [[nodiscard]] const std::string& plugin() const { return plugin_; }
  [[nodiscard]] std::unique_ptr<Test> release() { return std::move(test_); }

 private:
  template <class Body>
  Status made(const char* what, const TestInput& input, const Body& body) const;

  std::unique_ptr<Test> test_;
  std::string plugin_;
  const TestDescription* description_;
  const TestRows* rows_;
  bool stricken_;
};

}  // namespace tunica::plugins
