// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dial.hpp"
#include "signatures.hpp"

namespace blind {

/// Which case of the benchmark: the same order makes the same case, bit for bit.
struct CaseOrder {
  std::uint64_t seed = 0;
  std::string set;     ///< nulls, singles, pairs, outside
  std::string effect;  ///< of singles and outside
  double lambda = 0;   ///< asked of every effect alone
  std::size_t index = 0;
  std::vector<std::string> noise;  ///< kinds to draw from
  Base base = Base::hgo;
  std::string protocol = "artery";
  bool noise_stated = true;    ///< false: the files say nothing of the noise; all else is that of the stated case
  bool order_recorded = true;  ///< false: rows reversed or shuffled, no time
  [[nodiscard]] std::string text() const;
  /// The same case with its noise stated: the source of its random numbers.
  [[nodiscard]] CaseOrder stated() const;
  /// Says nothing about the case to who does not know the order.
  [[nodiscard]] std::string name() const;
};

struct SealedCase {
  CaseOrder order;
  Specimen specimen;
  NoiseModel noise;
  std::vector<ScaledEffect> hidden;
  double lambda = 0;       ///< of all effects together
  double correlation = 0;  ///< of pairs: of what the base model leaves of each
  Explanation account;     ///< of effects outside the catalogue: the catalogue's best for it
  std::vector<double> truth;
  Records records;
  /// Of every test, where nobody recorded the order: which row stands k-th in the file. Empty: as recorded.
  std::map<std::string, std::vector<std::size_t>> rows = {};
};
SealedCase make(const CaseOrder& order);

/// What is sealed: the truth as text.
std::string truth_of(const SealedCase& made, const std::string& name);
/// experiment.json and data, which are all that who judges may see.
void write_measured(const SealedCase& made, const std::string& name, const std::filesystem::path& folder);

/// What acts on the same term of the energy has no agreed order, and is not hidden together.
bool compatible(const std::string& a, const std::string& b);
std::mt19937_64 stream(const std::string& text);

/// DIR/<name>/: experiment.json, data, truth.sha256; and DIR/sealed/<name>.json. The case folder appears at once and
/// last, so that an interrupted run leaves none that is incomplete. With `oracle` also DIR/sealed/<name>.oracle.json.
/// True unless all was there already.
bool write(const CaseOrder& order, const std::filesystem::path& folder, bool oracle = false);

}  // namespace blind
