// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "calibration/fakes.hpp"
#include "diagnosis/naming/groups.hpp"

namespace tunica::diagnosis {

/// A mechanism that adds shape · (v − null) to the readings of a test, v being its amplitude; an even one adds
/// shape · (v − null)².
struct MadeUp {
  std::string id;
  Eigen::VectorXd shape;  ///< by row of the experiment, the tests one behind the other
  std::vector<std::vector<std::string>> places = {{"a"}};
  MechanismFactory::Side side = MechanismFactory::Side::both;
  double sign = 1, null = 0;
  std::vector<std::pair<std::string, Eigen::VectorXd>> nuisance = {};  ///< each adds its value times a shape
  std::function<void(MechanismFactory&)> declare = {};                 ///< what else it says of itself
  std::function<double(double)> by = {};                               ///< in place of v − null
  /// Told of every prediction before it is made: parameters of the model, and its own. It can make the prediction fail.
  std::function<Status(std::span<const double> model, std::span<const double> own)> watch = {};
};

/// Noise of 1 in every row, a base that shows 1 + x/10 in row x, and mechanisms that add up: what each explains of
/// data is a projection.
class MadeUpCauses : public fakes::Bench {
 public:
  /// Tests "a", "b", … with that many rows each, and what the data show beyond the base.
  MadeUpCauses(const std::vector<int>& rows, const Eigen::VectorXd& beyond);
  void add(MadeUp mechanism);
  /// Frees a parameter of the base, "a" with the effect 1, "b" with the effect x, "c" with the effect x².
  void free(const std::string& name, double min, double max);
  /// After all of these: fits the base, and makes the hypotheses.
  void close();

  /// After that: thresholds by 500 draws of noise (seed 7) instead of by nothing at all; they come to about ten.
  void calibrate_by_noise();

  [[nodiscard]] Inquiry inquiry() const { return {experiment, request, shelf, progress}; }
  /// The direction of a mechanism in one of its places.
  [[nodiscard]] std::size_t direction(const std::string& id, std::size_t place = 0) const;
  [[nodiscard]] const std::string& id_of(std::size_t direction) const;
  /// "p q" for a group of these mechanisms.
  [[nodiscard]] std::string names_of(const Group& group) const;
  [[nodiscard]] std::vector<std::string> names_of(const std::vector<Group>& groups) const;
  [[nodiscard]] const Group& group_named(const std::vector<Group>& groups, const std::string& names) const;
  /// These together, fitted from what each explains by itself; `as`: their names.
  [[nodiscard]] Group group_of(const std::vector<std::size_t>& directions,
                               const std::vector<std::string>& as = {}) const;
  /// The mechanism fitted by itself in one of its places.
  [[nodiscard]] Single single(const std::string& id, std::size_t place = 0) const;

  Request request;
  Progress progress = [this](const std::string& stage, double share) {
    const std::scoped_lock lock(mutex_);
    reports.emplace_back(share, stage);
  };
  std::vector<std::pair<double, std::string>> reports;  ///< of the progress, in no order
  Analysis analysis;

 private:
  void calibrate(const Draws& draws);

  std::vector<MadeUp> mechanisms_;
  std::mutex mutex_;
};

/// One row a test, tests "a", "b", …; mechanism 0, 1, … explains these squares of its own row.
class OneRowEach : public MadeUpCauses {
 public:
  explicit OneRowEach(const std::vector<double>& squares);
  /// One mechanism, in all tests one by one, with this shape in each, and an amplitude up to the bound on either side.
  void add_everywhere(const std::string& id, const std::vector<double>& shape, double bound = 1000);
  /// A mechanism a row: "m0", "m1", …
  void add_each(Eigen::Index size);
  static std::string test_of(Eigen::Index k) { return std::string(1, static_cast<char>('a' + k)); }

  std::vector<Single> run();
  /// Fits of the last run: the progress is reported once before, and after each.
  [[nodiscard]] std::size_t jobs() const { return reports.size() - 1; }
};

/// A vector of zeros but for these rows.
Eigen::VectorXd at_rows(Eigen::Index size, const std::vector<std::pair<Eigen::Index, double>>& values);

}  // namespace tunica::diagnosis
