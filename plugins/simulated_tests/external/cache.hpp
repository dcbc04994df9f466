// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::external {

/// What one run of the solver gave: the numbers of each observable that results are read for.
using Numbers = std::vector<std::vector<double>>;

/// Results by the content of everything that the solver read: in memory, and in a folder where one is given, which
/// later runs of tunica read. Thread-safe.
class Cache {
 public:
  /// `folder` is made where it does not exist; empty = memory only. `observables` is how many lists a result has: a
  /// file with another number of them is no result. Throws InputError.
  Cache(std::filesystem::path folder, std::size_t observables);
  [[nodiscard]] std::optional<Numbers> find(const std::string& key) const;
  void keep(const std::string& key, const Numbers& numbers);

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& key) const { return folder_ / (key + ".json"); }
  std::filesystem::path folder_;
  std::size_t observables_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, Numbers> kept_;
};

/// SHA-256 of a text in hexadecimal digits.
std::string digest(std::string_view text);

}  // namespace tunica::external
