// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// The largest counts that files and command lines may ask for, for reader and schema alike. Far above what anyone
/// needs, and small enough that a slip of the keyboard is a message and not an exhausted machine.
namespace tunica::experiment::limits {

constexpr std::size_t file_bytes = std::size_t{16} << 20;  ///< of an experiment or cohort file
constexpr std::size_t key_bytes = 1000;                    ///< of a key in it
constexpr std::size_t entries = 10000;                     ///< of a list or an object in it
constexpr std::uint64_t realisations = 100000;             ///< of a run
constexpr std::uint64_t all_realisations = 1000000;        ///< of an experiment
constexpr std::uint64_t evaluations = 1000000000000;       ///< "max_evaluations", "stall"
constexpr std::uint64_t stability_points = 10000;          ///< stretches of a stability constraint
constexpr std::uint64_t least_draws = 40;                  ///< a 2.5 % point of fewer is their smallest
constexpr std::uint64_t draws = 1000000;                   ///< of bootstrap and posterior
constexpr std::uint64_t least_posterior_draws = 400;       ///< fewer are not worth the effective sample size they need
constexpr std::uint64_t usual_posterior_draws = 4000;      ///< where the command line names none
constexpr std::uint64_t map_points = 1001;                 ///< along each parameter of a map
constexpr std::uint64_t resampled = 100000;                ///< points of a branch
constexpr std::uint64_t lines = 1000000000;                ///< "skip_lines", numbers of cycles and columns
constexpr std::uint64_t permutations = 1000000;            ///< of a cohort

}  // namespace tunica::experiment::limits
