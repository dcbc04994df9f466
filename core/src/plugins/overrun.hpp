// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Whether a model writes beyond its outputs. The first call of every kind is made into memory with numbers around each
/// output, which the call must leave alone; later calls of that kind cost one look at a bit.
namespace tunica::plugins {

/// Outputs of a call, with their names.
struct NamedOutput {
  const char* name;
  std::span<double> values;
};

/// Memory of this thread for the outputs of one call, with `margin` numbers before and behind each.
class FencedOutputs {
 public:
  static constexpr std::size_t margin = 8;  ///< as many as the widest vector has

  /// Replaces the spans in `outputs` by fenced ones of the same sizes, with what was in them.
  explicit FencedOutputs(std::span<NamedOutput> outputs);
  /// Puts the values back where the caller has them. Returns the name of an output beyond whose ends there is
  /// something else now, or null.
  const char* release(std::span<NamedOutput> outputs);

 private:
  std::vector<double> memory_;
  std::array<std::span<double>, 8> theirs_ = {};
};

/// Which kinds of call have been made between fences, and the verdict on the model.
class OverrunRecord {
 public:
  /// A kind is what is wanted, and the number of points within a vector of eight.
  static std::size_t kind(std::span<const NamedOutput> outputs, std::size_t points) {
    std::size_t wanted = 0;
    for (const NamedOutput& output : outputs) wanted = 2 * wanted + (output.values.empty() ? 0 : 1);
    return 8 * (wanted % 32) + points % 8;
  }
  [[nodiscard]] bool is_new(std::size_t kind) const {
    return (good_[kind / 64].load(std::memory_order_relaxed) >> kind % 64 & 1) == 0;
  }
  void set_good(std::size_t kind) {
    good_[kind / 64].fetch_or(std::uint64_t{1} << kind % 64, std::memory_order_relaxed);
  }
  /// The output that was written beyond, or null. It stays: memory may be damaged.
  [[nodiscard]] const char* overrun() const { return overrun_.load(std::memory_order_relaxed); }
  void set_overrun(const char* output) {
    overrun_.store(output, std::memory_order_relaxed);
    for (auto& kinds : good_) kinds.store(0, std::memory_order_relaxed);  // every call looks at the verdict again
  }

 private:
  std::array<std::atomic<std::uint64_t>, 4> good_ = {};
  std::atomic<const char*> overrun_ = nullptr;
};

/// The reason of a failed evaluation.
std::string overrun_reason(const std::string& plugin, const char* output);

}  // namespace tunica::plugins
