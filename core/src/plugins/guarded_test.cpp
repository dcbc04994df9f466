// SPDX-License-Identifier: Apache-2.0
#include "plugins/guarded_test.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "plugins/calls.hpp"
#include "plugins/casualties.hpp"
#include "plugins/declared_bounds.hpp"
#include "plugins/destroyed.hpp"
#include "plugins/guarded.hpp"
#include "plugins/unwritten.hpp"
#include "plugins/usual_arithmetic.hpp"
#include "tunica/detail/vector_math.hpp"

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

GuardedTest::~GuardedTest() { destroy(plugin_, test_); }

template <class Body>
Status GuardedTest::made(const char* what, const TestInput& input, const Body& body) const {
  const Call call{plugin_.c_str(), what, test_key, &input};
  if (stricken_)
    if (std::string reason = refusal_of_evaluation(plugin_, test_key(call)); !reason.empty())
      return Status::failed(std::move(reason));
  const CallScope scope(call);
  for (bool again = true;; again = false) {
    UsualArithmetic arithmetic;
    try {
      Status status = body();
      if (arithmetic.take_change()) return Status::failed(fmt::format("plugin '{}' {}", plugin_, changed_arithmetic));
      return status;
    } catch (const HostFault&) {
      throw;
    } catch (const std::exception& problem) {
      // A temporary lack of memory is no property of the point.
      if (again && dynamic_cast<const std::bad_alloc*>(&problem) != nullptr) continue;
      return Status::failed(fmt::format("plugin '{}' threw: {}", plugin_, problem.what()));
    } catch (...) {
      return Status::failed(fmt::format("plugin '{}' threw something that is no std::exception", plugin_));
    }
  }
}

/// All predictions are marked, and of derivatives the ends of each column: those are many.
Status GuardedTest::predict(const TestInput& input, const TestOutput& output) const {
  const std::size_t size = output.values.size();
  std::fill(output.values.begin(), output.values.end(), unwritten);
  if (size > 0) mark_ends(output.jacobian, size);
  Status status = made("predict", input, [&] { return test_->predict(input, output); });
  if (!status.ok() || size == 0) return status;
  // A mark is not a finite number: if all values are finite, no mark is left.
  const bool values = detail::all_finite(output.values.data(), size) ||
                      std::none_of(output.values.begin(), output.values.end(), is_unwritten);
  if (values && !has_marked_ends(output.jacobian, size)) return status;
  return Status::failed(
      fmt::format("plugin '{}' returned ok without writing the {}; expected every number of it. "
                  "`tunica plugin check` shows what else is amiss",
                  plugin_, values ? "Jacobian" : "predictions"));
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
