// SPDX-License-Identifier: Apache-2.0
#include "cohort/design.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <Eigen/QR>
#include <fmt/format.h>

#include "cohort/index.hpp"

namespace tunica::cohort {

namespace {

/// Adds the columns of a factor, or says why not.
void add_factor(const Factor& factor, Design& design) {
  std::set<std::size_t> present;
  for (const std::size_t k : design.specimens) present.insert(factor.of[k]);
  DesignFactor added{factor.column, {}, {}, {design.rows.cols(), present.size(), {}}};
  std::map<std::size_t, std::size_t> number;  // of a level among those that are present; the reference is the first
  for (const std::size_t level : present) {
    number[level] = added.levels.size();
    added.levels.push_back(factor.levels[level]);
  }
  if (present.size() < 2) {
    design.refusals.push_back(fmt::format("the factor '{}' has one level among the specimens that were fitted, '{}'",
                                          factor.column, added.levels.front()));
    return;
  }
  added.reference = added.levels.front();
  Eigen::MatrixXd rows(design.rows.rows(), design.rows.cols() + index(present.size()) - 1);
  rows.setZero();
  rows.leftCols(design.rows.cols()) = design.rows;
  for (std::size_t i = 0; i < design.specimens.size(); ++i) {
    added.columns.of.push_back(number[factor.of[design.specimens[i]]]);
    if (added.columns.of[i] > 0) rows(index(i), design.rows.cols() + index(added.columns.of[i]) - 1) = 1;
  }
  if (rows.colPivHouseholderQr().rank() < rows.cols() || rows.cols() >= rows.rows()) {
    design.refusals.push_back(fmt::format("the factor '{}' cannot be told from those before it with these {} specimens",
                                          factor.column, design.specimens.size()));
    return;
  }
  design.rows = rows;
  for (std::size_t level = 1; level < added.levels.size(); ++level)
    design.columns.push_back({factor.column, added.levels[level]});
  design.factors.push_back(std::move(added));
}

}  // namespace

bool Design::constant_in_animals(Eigen::Index column) const {
  for (std::size_t i = 1; i < specimens.size(); ++i)
    if (animals[i] == animals[i - 1] && rows(index(i), column) != rows(index(i - 1), column)) return false;
  return true;
}

double Design::freedom(Eigen::Index column) const {
  const bool between = !nested() || constant_in_animals(column);
  double columns_alike = 0;
  for (Eigen::Index k = 0; k < rows.cols(); ++k)
    columns_alike += !nested() || constant_in_animals(k) == between ? 1 : 0;
  const double units = between ? static_cast<double>(nested() ? animal_count : specimens.size())
                               : static_cast<double>(specimens.size() - animal_count);
  return std::max(1.0, units - columns_alike);
}

Design Design::without(std::size_t factor) const {
  Design reduced = *this;
  const auto& columns_of = factors[factor].columns;
  const Eigen::Index count = index(columns_of.levels) - 1, after = rows.cols() - columns_of.first - count;
  reduced.rows.resize(rows.rows(), rows.cols() - count);
  reduced.rows << rows.leftCols(columns_of.first), rows.rightCols(after);
  reduced.columns.erase(reduced.columns.begin() + columns_of.first, reduced.columns.begin() + columns_of.first + count);
  reduced.factors.erase(reduced.factors.begin() + index(factor));
  for (std::size_t k = factor; k < reduced.factors.size(); ++k) reduced.factors[k].columns.first -= count;
  return reduced;
}

std::vector<Design::Group> Design::groups() const {
  std::vector<Group> found;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const Eigen::VectorXd row = rows.row(index(i)).transpose();
    auto at = std::find_if(found.begin(), found.end(), [&](const Group& one) { return one.row == row; });
    if (at == found.end()) {
      std::string name;
      for (const DesignFactor& factor : factors)
        name += (name.empty() ? "" : ", ") + factor.levels[factor.columns.of[i]];
      at = found.insert(found.end(), {name.empty() ? "all" : name, row, {}});
    }
    at->specimens.push_back(i);
  }
  return found;
}

Design design_of(const SpecimenTable& table, const Collection& found) {
  Design design;
  std::map<std::string, std::size_t> animals;
  for (std::size_t k = 0; k < found.records.size(); ++k)
    if (found.records[k].outcome == Outcome::fitted) {
      design.specimens.push_back(k);
      animals.emplace(table.specimens[k].animal, animals.size());
    }
  // Specimens of one animal beside each other, else in the order of the table.
  std::stable_sort(design.specimens.begin(), design.specimens.end(), [&](std::size_t a, std::size_t b) {
    return animals[table.specimens[a].animal] < animals[table.specimens[b].animal];
  });
  for (const std::size_t k : design.specimens) design.animals.push_back(animals[table.specimens[k].animal]);
  design.animal_count = animals.size();
  design.columns.push_back({});
  design.rows = Eigen::MatrixXd::Ones(index(design.specimens.size()), 1);
  for (const Factor& factor : table.factors)
    if (factor.refusal.empty()) add_factor(factor, design);
  return design;
}

}  // namespace tunica::cohort
