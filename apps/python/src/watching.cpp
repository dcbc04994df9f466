// SPDX-License-Identifier: Apache-2.0
#include "watching.hpp"

#include <utility>
#include <vector>

#include "execution/interrupt.hpp"
#include "tunica/error.hpp"

namespace tunica::python {

namespace {

std::atomic<bool> busy = false;

/// The test that it wraps, until Ctrl-C.
class InterruptibleTest final : public Test {
 public:
  explicit InterruptibleTest(std::unique_ptr<Test> test) : test_(std::move(test)) {}
  [[nodiscard]] const TestDescription& describe() const override { return test_->describe(); }
  [[nodiscard]] const TestRows& rows() const override { return test_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (execution::InterruptWatch::interrupted()) return Status::failed("interrupted");
    return test_->predict(input, output);
  }
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    return test_->agreement(input, found);
  }
  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override {
    return test_->snapshots(input, rows, found);
  }
  [[nodiscard]] std::vector<Effort> efforts() const override { return test_->efforts(); }

 private:
  std::unique_ptr<Test> test_;
};

}  // namespace

OneAtATime::OneAtATime() {
  if (busy.exchange(true))
    throw InputError(
        "another run or diagnosis is under way in this process; wait for it, or start this one in a process of its "
        "own");
}

OneAtATime::~OneAtATime() { busy = false; }

std::function<void(double, const std::string&)> Told::function() {
  if (listener_.is_none()) return {};
  return [this](double share, const std::string& text) { tell(share, text); };
}

void Told::tell(double share, const std::string& text) {
  const pybind11::gil_scoped_acquire lock;
  if (raised_) return;
  try {
    listener_(share, text);
  } catch (...) {
    raised_ = std::current_exception();
    execution::InterruptWatch::interrupt();
  }
}

void Told::finish() {
  if (raised_) std::rethrow_exception(std::exchange(raised_, nullptr));
}

plugins::Catalogue interruptible(const plugins::Catalogue& catalogue) {
  plugins::Catalogue changed;
  const auto commit = [&changed](auto factory, const std::string& plugin) {
    plugins::Catalogue::Registration registration;
    registration.add(std::move(factory));
    changed.commit(std::move(registration), plugin);
  };
  for (const auto& [name, entry] : catalogue.models()) commit(entry.factory, entry.plugin);
  for (const auto& [name, entry] : catalogue.optimizers()) commit(entry.factory, entry.plugin);
  for (const auto& [name, entry] : catalogue.mechanisms()) commit(entry.factory, entry.plugin);
  for (const auto& [name, entry] : catalogue.tests()) {
    TestFactory factory = entry.factory;
    factory.create = [create = entry.factory.create](const TestSetup& setup) -> std::unique_ptr<Test> {
      auto test = create(setup);
      if (!test) return nullptr;
      return std::make_unique<InterruptibleTest>(std::move(test));
    };
    commit(std::move(factory), entry.plugin);
  }
  return changed;
}

}  // namespace tunica::python
