// SPDX-License-Identifier: Apache-2.0
#include "population/design.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "numerics/orthogonal.hpp"
#include "tunica/error.hpp"

namespace tunica::population {
namespace {

bool varies_within_animals(const Cohort& cohort, const Eigen::VectorXd& values) {
  std::vector<std::optional<double>> first(cohort.animals.size());
  for (std::size_t i = 0; i < cohort.specimens.size() && !first.empty(); ++i) {
    auto& value = first[cohort.specimens[i].animal];
    const double own = values[static_cast<Eigen::Index>(i)];
    if (value && *value != own) return true;
    value = own;
  }
  return false;
}

}  // namespace

Design design(const Cohort& cohort, const std::vector<std::size_t>& factors) {
  Design result;
  result.columns.push_back({});
  std::vector<std::string> names;
  for (const std::size_t f : factors) {
    names.push_back(cohort.factors[f].name);
    for (std::size_t level = 1; level < cohort.factors[f].levels.size(); ++level)
      result.columns.push_back({f, level, false});
  }
  const auto n = static_cast<Eigen::Index>(cohort.specimens.size());
  result.rows.setOnes(n, static_cast<Eigen::Index>(result.size()));
  for (std::size_t c = 1; c < result.size(); ++c) {
    Column& column = result.columns[c];
    auto values = result.rows.col(static_cast<Eigen::Index>(c));
    for (Eigen::Index i = 0; i < n; ++i)
      values[i] = cohort.specimens[static_cast<std::size_t>(i)].levels[*column.factor] == column.level ? 1 : 0;
    column.within = varies_within_animals(cohort, values);
  }
  if (numerics::orthonormal_basis(result.rows, 1e-9).cols() < result.rows.cols())
    throw InputError(
        fmt::format("the factors '{}' sort the {} specimens alike in part, so that their effects cannot be "
                    "told apart; leave one out",
                    fmt::join(names, "', '"), n));
  if (n <= result.rows.cols())
    throw InputError(
        fmt::format("{} specimens for {} group means, which leaves no spread to compare with; add specimens "
                    "or leave a factor out",
                    n, result.rows.cols()));
  return result;
}

std::vector<double> containment(const Design& design, std::size_t specimens, std::size_t animals) {
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  const auto within = static_cast<std::size_t>(
      std::count_if(design.columns.begin(), design.columns.end(), [](const Column& c) { return c.within; }));
  std::vector<double> result;
  for (const Column& column : design.columns) {
    double freedom = count(specimens) - count(design.size());
    if (animals > 0 && column.within) freedom = count(specimens) - count(animals) - count(within);
    if (animals > 0 && !column.within) freedom = count(animals) - count(design.size() - within);
    result.push_back(std::max(freedom, 1.0));
  }
  return result;
}

}  // namespace tunica::population
