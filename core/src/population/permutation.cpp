// SPDX-License-Identifier: Apache-2.0
#include "population/permutation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <tbb/parallel_for.h>

#include "tunica/random.hpp"

namespace tunica::population {

namespace {

using Labels = std::vector<std::size_t>;

/// Units that carry a label, in blocks within which labels are exchanged.
struct Units {
  Exchange exchange = Exchange::specimens;
  std::vector<std::vector<std::size_t>> members;  ///< specimens of each unit
  std::vector<std::vector<std::size_t>> blocks;   ///< units of each block
};

Units units_of(std::span<const Individual> individuals, const Labels& labels) {
  std::map<std::size_t, std::vector<std::size_t>> animals;
  for (std::size_t i = 0; i < individuals.size(); ++i) animals[individuals[i].animal].push_back(i);
  Units units;
  const bool constant = std::all_of(animals.begin(), animals.end(), [&](const auto& entry) {
    return std::all_of(entry.second.begin(), entry.second.end(),
                       [&](std::size_t i) { return labels[i] == labels[entry.second.front()]; });
  });
  if (constant) {
    units.exchange = animals.size() == individuals.size() ? Exchange::specimens : Exchange::animals;
    units.blocks.emplace_back();
    for (const auto& [animal, members] : animals) {
      units.blocks[0].push_back(units.members.size());
      units.members.push_back(members);
    }
    return units;
  }
  units.exchange = Exchange::within;
  for (const auto& [animal, members] : animals) {
    units.blocks.emplace_back();
    for (const std::size_t i : members) {
      units.blocks.back().push_back(units.members.size());
      units.members.push_back({i});
    }
  }
  return units;
}

/// |b/se| of every parameter, the largest over the levels.
Eigen::VectorXd statistics(std::span<const Quadratic> about, std::span<const Individual> individuals,
                           const FactorColumns& factor, const Labels& labels, const Eigen::MatrixXd& animals) {
  const Eigen::Index p = animals.rows(), columns = individuals.front().design.size();
  const auto last = factor.first + static_cast<Eigen::Index>(factor.levels) - 1;
  const bool nested = animals.diagonal().maxCoeff() > 0;
  const Eigen::Index n = p * columns;
  Quadratic total = Quadratic::zero(n), joint = Quadratic::zero(n + p);
  for (std::size_t i = 0; i < individuals.size(); ++i) {
    Eigen::VectorXd design = individuals[i].design;
    design.segment(factor.first, last - factor.first).setZero();
    if (labels[i] > 0) design[factor.first + static_cast<Eigen::Index>(labels[i]) - 1] = 1;
    Quadratic& into = nested ? joint : total;
    for (Eigen::Index k = 0; k < columns; ++k) {
      if (design[k] == 0) continue;
      into.score.segment(k * p, p) += design[k] * about[i].score;
      if (nested) {
        into.information.block(k * p, n, p, p) += design[k] * about[i].information;
        into.information.block(n, k * p, p, p) += design[k] * about[i].information;
      }
      for (Eigen::Index l = 0; l < columns; ++l)
        if (design[l] != 0) into.information.block(k * p, l * p, p, p) += design[k] * design[l] * about[i].information;
    }
    if (!nested) continue;
    into.information.bottomRightCorner(p, p) += about[i].information;
    into.score.tail(p) += about[i].score;
    if (i + 1 < individuals.size() && individuals[i + 1].animal == individuals[i].animal) continue;
    total += integrated(joint, animals);
    joint = Quadratic::zero(n + p);
  }
  const Eigen::LDLT<Eigen::MatrixXd> solver(total.information);
  const Eigen::VectorXd b = solver.solve(total.score);
  const Eigen::MatrixXd covariance = solver.solve(Eigen::MatrixXd::Identity(n, n));
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(p);
  for (Eigen::Index k = factor.first; k < last; ++k)
    for (Eigen::Index j = 0; j < p; ++j)
      largest[j] = std::max(largest[j], std::abs(b[k * p + j]) / std::sqrt(covariance(k * p + j, k * p + j)));
  return largest;
}

/// How many different arrangements of the labels there are, up to a limit.
double arrangements(const Units& units, const Labels& of_unit) {
  double logarithm = 0;
  for (const auto& block : units.blocks) {
    std::map<std::size_t, double> counts;
    for (const std::size_t unit : block) ++counts[of_unit[unit]];
    logarithm += std::lgamma(static_cast<double>(block.size()) + 1);
    for (const auto& [label, count] : counts) logarithm -= std::lgamma(count + 1);
  }
  return std::exp(logarithm);
}

Labels of_specimens(const Units& units, const Labels& of_unit, std::size_t count) {
  Labels labels(count);
  for (std::size_t unit = 0; unit < units.members.size(); ++unit)
    for (const std::size_t i : units.members[unit]) labels[i] = of_unit[unit];
  return labels;
}

/// The next arrangement of every block, like the hands of a clock; false after the last.
bool advance(const Units& units, Labels& of_unit) {
  for (const auto& block : units.blocks) {
    Labels labels;
    for (const std::size_t unit : block) labels.push_back(of_unit[unit]);
    const bool more = std::next_permutation(labels.begin(), labels.end());
    for (std::size_t k = 0; k < block.size(); ++k) of_unit[block[k]] = labels[k];
    if (more) return true;
  }
  return false;
}

std::vector<Labels> all_arrangements(const Units& units, Labels of_unit, std::size_t count) {
  for (const auto& block : units.blocks) {
    Labels labels;
    for (const std::size_t unit : block) labels.push_back(of_unit[unit]);
    std::sort(labels.begin(), labels.end());
    for (std::size_t k = 0; k < block.size(); ++k) of_unit[block[k]] = labels[k];
  }
  std::vector<Labels> made;
  do made.push_back(of_specimens(units, of_unit, count));
  while (advance(units, of_unit));
  return made;
}

std::vector<Labels> random_arrangements(const Units& units, const Labels& of_unit, std::size_t count, std::size_t draws,
                                        std::uint64_t seed) {
  boost::random::mt19937_64 generator(derive_seed(seed, "permutations"));
  std::vector<Labels> made;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    Labels shuffled = of_unit;
    for (const auto& block : units.blocks)
      for (std::size_t k = block.size(); k > 1; --k) {
        const auto other = boost::random::uniform_int_distribution<std::size_t>(0, k - 1)(generator);
        std::swap(shuffled[block[k - 1]], shuffled[block[other]]);
      }
    made.push_back(of_specimens(units, shuffled, count));
  }
  return made;
}

}  // namespace

PermutationTest permutation_test(std::span<const Individual> individuals, const FactorColumns& factor,
                                 const Estimates& null, std::size_t draws, std::uint64_t seed) {
  PermutationTest test;
  const Units units = units_of(individuals, factor.of);
  test.exchange = units.exchange;
  Labels of_unit;
  for (const auto& members : units.members) of_unit.push_back(factor.of[members.front()]);
  const double possible = arrangements(units, of_unit);
  test.all = possible <= static_cast<double>(draws) + 0.5;
  const std::vector<Labels> labels = test.all ? all_arrangements(units, of_unit, individuals.size())
                                              : random_arrangements(units, of_unit, individuals.size(), draws, seed);
  test.made = labels.size();
  std::vector<Quadratic> about;
  for (const Individual& one : individuals) about.push_back(about_mean(one.data, null.omega));
  const Eigen::VectorXd observed = statistics(about, individuals, factor, factor.of, null.omega_animals);
  std::vector<Eigen::VectorXd> drawn(labels.size());
  tbb::parallel_for(std::size_t{0}, labels.size(), [&](std::size_t k) {
    drawn[k] = statistics(about, individuals, factor, labels[k], null.omega_animals);
  });
  // The same arrangement has the same statistic but for rounding.
  constexpr double rounding = 1e-9;
  const double added = test.all ? 0 : 1;
  const double total = static_cast<double>(labels.size()) + added;
  double most_extreme = 0, largest = 0;
  for (const Eigen::VectorXd& one : drawn) largest = std::max(largest, one.maxCoeff());
  for (const Eigen::VectorXd& one : drawn) most_extreme += one.maxCoeff() >= largest * (1 - rounding) ? 1 : 0;
  test.smallest_p = test.all ? most_extreme / total : 1 / total;
  for (Eigen::Index j = 0; j < observed.size(); ++j) {
    double reached = added, reached_by_any = added;
    for (const Eigen::VectorXd& one : drawn) {
      reached += one[j] >= observed[j] * (1 - rounding) ? 1 : 0;
      reached_by_any += one.maxCoeff() >= observed[j] * (1 - rounding) ? 1 : 0;
    }
    test.p.push_back(reached / total);
    test.p_any.push_back(reached_by_any / total);
  }
  return test;
}

}  // namespace tunica::population
