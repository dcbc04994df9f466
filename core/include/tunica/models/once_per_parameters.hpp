// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace tunica {

/// What a model computes from its parameters alone, for example the weights of fibres over angles. Tests evaluate a
/// model many times at one set of parameters, often a point at a time. A member of this type keeps what the last sets
/// gave.
///
///     OncePerParameters<Weights> weights_{[](std::span<const double> p) { return weights(p); }};
///     …
///     const auto at = weights_(points.parameters);  // in evaluate()
///
/// `make` depends on its argument only, so that results do not depend on what is kept. Threads: every call may be
/// concurrent; two may make the same value. What was handed out stays valid as long as it is held.
template <class Made>
class OncePerParameters {
 public:
  /// With what makes a value of the parameters.
  explicit OncePerParameters(std::function<Made(std::span<const double>)> make) : make_(std::move(make)) {}

  /// The value at these parameters. What `make` throws, it throws.
  std::shared_ptr<const Made> operator()(std::span<const double> parameters) const {
    {
      const std::lock_guard lock(mutex_);
      if (auto made = known(parameters)) return made;
    }
    auto made = std::make_shared<const Made>(make_(parameters));
    const std::lock_guard lock(mutex_);
    if (auto others = known(parameters)) return others;  // of a thread that was faster
    if (kept_.size() < sets_) kept_.emplace_back();
    kept_[oldest_] = {{parameters.begin(), parameters.end()}, made};
    oldest_ = (oldest_ + 1) % sets_;
    return made;
  }

 private:
  struct Kept {
    std::vector<double> parameters;
    std::shared_ptr<const Made> made;
  };

  [[nodiscard]] std::shared_ptr<const Made> known(std::span<const double> parameters) const {
    for (const Kept& one : kept_)
      if (std::ranges::equal(one.parameters, parameters)) return one.made;
    return nullptr;
  }

  std::function<Made(std::span<const double>)> make_;
  std::size_t sets_ = 2 * std::max(4U, std::thread::hardware_concurrency());  // each thread at its own set
  mutable std::mutex mutex_;
  mutable std::vector<Kept> kept_;
  mutable std::size_t oldest_ = 0;
};

}  // namespace tunica
