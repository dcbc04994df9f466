// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "posterior/memory.hpp"
#include "posterior/target.hpp"

namespace tunica::posterior {

/// The mode in z, by damped Newton from the best point, evaluated with its metric. Failed in `status` where the best
/// point breaks a constraint or cannot be simulated.
struct Centre {
  Status status;
  Target::Metric metric;
  Point point;
  std::size_t evaluations = 0;
};
Centre centre(const Question& question, std::span<const double> best);

/// One chain without its warm-up.
struct Chain {
  std::size_t parameters = 0;
  std::vector<double> free;  ///< draw after draw, base units
  std::vector<double> log_density;
  std::vector<double> acceptance;             ///< probability with which the tangent move to a draw was taken
  double size = 0;                            ///< of its tangent moves
  std::size_t evaluations = 0, failures = 0;  ///< simulations with derivatives, warm-up included; those that failed

  [[nodiscard]] std::size_t draws() const { return log_density.size(); }
  [[nodiscard]] double value(std::size_t draw, std::size_t parameter) const {
    return free[draw * parameters + parameter];
  }
};

/// Draws of a chain before its first one that counts.
constexpr std::size_t warm_up = 500;
/// Of every draw, after its tangent move.
constexpr int difference_moves = 4;

/// The chain of this key. It begins at a draw of the Laplace approximation, and goes on by tangent moves
/// (tangent_move.hpp). During the warm-up their size follows the acceptance, ln β += k^{−0.6} (acceptance − ½), up to
/// 0.95 (H. Robbins, S. Monro, Ann. Math. Stat. 22:400, 1951; C. Andrieu, J. Thoms, Stat. Comput. 18:343, 2008); then
/// it stays. To every draw then lead a tangent move and `difference_moves` along differences of the second half of the
/// warm-up (difference_move.hpp).
///
/// The same bits whatever else runs. With fewer draws than asked for once `is_over` returns true. `known` steps of the
/// same chain are taken as they are, and `keep` gets each one that is new, with its index. Where the density at the
/// last known one is not what it was, to the last bit, all of them are made again.
Chain chain(const Question& question, const Centre& from, std::size_t draws, std::uint64_t key,
            const std::function<bool()>& is_over, const std::vector<Step>& known = {},
            const std::function<void(std::size_t, const Step&)>& keep = {});

}  // namespace tunica::posterior
