// SPDX-License-Identifier: Apache-2.0
#include "plugins/guarded_test.hpp"

#include <utility>

#include <fmt/format.h>

#include "plugins/calls.hpp"
#include "plugins/casualties.hpp"
#include "plugins/guarded.hpp"

namespace tunica::plugins {

namespace {

std::uint64_t test_key(const Call& call) {
  const auto& input = *static_cast<const TestInput*>(call.input);
  CallKey key(call.plugin, call.what);
  key.add(input.model_parameters);
  key.add(input.test_parameters);
  for (const auto& values : input.abscissae) key.add(values);
  return key.value();
}

}  // namespace

GuardedTest::GuardedTest(std::unique_ptr<Test> test, std::string plugin)
    : test_(std::move(test)), plugin_(std::move(plugin)), stricken_(is_stricken(plugin_)) {
  description_ = guarded(plugin_, "describe", [this] { return &test_->describe(); });
  rows_ = guarded(plugin_, "rows", [this] { return &test_->rows(); });
}

template <class Body>
Status GuardedTest::made(const char* what, const TestInput& input, const Body& body) const {
  const Call call{plugin_.c_str(), what, test_key, &input};
  if (stricken_)
    if (std::string reason = refusal_of_evaluation(plugin_, test_key(call)); !reason.empty())
      return Status::failed(std::move(reason));
  const CallScope scope(call);
  try {
    return body();
  } catch (const HostFault&) {
    throw;
  } catch (const std::exception& problem) {
    return Status::failed(fmt::format("plugin '{}' threw: {}", plugin_, problem.what()));
  } catch (...) {
    return Status::failed(fmt::format("plugin '{}' threw something that is no std::exception", plugin_));
  }
}

Status GuardedTest::predict(const TestInput& input, const TestOutput& output) const {
  return made("predict", input, [&] { return test_->predict(input, output); });
}

Status GuardedTest::agreement(const TestInput& input, std::vector<Agreement>& found) const {
  return made("agreement", input, [&] { return test_->agreement(input, found); });
}

Status GuardedTest::snapshots(const TestInput& input, std::span<const std::size_t> rows,
                              std::vector<Snapshot>& found) const {
  return made("snapshots", input, [&] { return test_->snapshots(input, rows, found); });
}

std::vector<Effort> GuardedTest::efforts() const {
  return guarded(plugin_, "efforts", [this] { return test_->efforts(); });
}

}  // namespace tunica::plugins
