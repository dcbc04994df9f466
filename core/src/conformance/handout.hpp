// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace tunica::conformance {

/// A plugin wrote where it must not, or did not write where it must. It is no std::runtime_error, with which a state is
/// drawn again: it fails the property in whose calls it happened.
class MemoryFault : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// The memory of one call of a plugin: inputs and outputs, each between guards.
///
/// Guards and the first content of outputs are signalling NaNs of own payloads. Whatever is written over one, or added
/// to it, changes its bits, even if it is a NaN too. What is read from one is no number. So a place that a plugin
/// skips is told from a NaN that it means.
class Handout {
 public:
  /// `who` begins every message: "the model".
  explicit Handout(std::string who) : who_(std::move(who)) {}

  /// A copy of `values`; none of no values.
  std::span<const double> input(std::string name, std::span<const double> values);
  /// Room for `count` numbers, none written; 0 = not wanted.
  std::span<double> output(std::string name, std::size_t count);
  /// Room that the plugin reads and writes over.
  std::span<double> in_place(std::string name, std::span<const double> values);

  /// After the call: throws MemoryFault where a guard or an input has changed and, if the call was `ok`, where an
  /// output has not been written.
  void verify(bool ok = true) const;
  /// The same without outputs, where a plugin may leave them.
  void verify_guards() const { verify(false); }

 private:
  enum class Use { input, output, in_place };
  struct Block {
    std::string name;
    Use use;
    std::vector<double> memory, given;
  };
  std::span<double> add(std::string name, Use use, std::span<const double> values, std::size_t count);
  [[nodiscard]] std::string flaw(const Block& block, bool ok) const;

  std::string who_;
  std::deque<Block> blocks_;
};

}  // namespace tunica::conformance
