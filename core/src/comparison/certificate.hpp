// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "execution/results.hpp"
#include "execution/warning.hpp"
#include "search/neighbours.hpp"
#include "text/codes.hpp"

namespace tunica::comparison {

/// The verdicts on the best point of a run, the gravest first.
enum class CertificateVerdict {
  not_checked,        ///< no fresh process was asked, or it gave no answer
  failed,             ///< the point cannot be evaluated in a fresh process
  objective_differs,  ///< by more than rounding
  constraint_broken,
  not_an_optimum,    ///< a small step lowers the objective by more than success allows
  ended_at_target,   ///< the same, of a search that was to stop at its target
  better_neighbour,  ///< a small step lowers the objective, by less than that
  no_neighbours,     ///< none could be compared
  confirmed,
};

inline constexpr text::Codes<CertificateVerdict, 9> certificate_codes{{
    {CertificateVerdict::not_checked, "not_checked"},
    {CertificateVerdict::failed, "failed"},
    {CertificateVerdict::objective_differs, "objective_differs"},
    {CertificateVerdict::constraint_broken, "constraint_broken"},
    {CertificateVerdict::not_an_optimum, "not_an_optimum"},
    {CertificateVerdict::ended_at_target, "ended_at_target"},
    {CertificateVerdict::better_neighbour, "better_neighbour"},
    {CertificateVerdict::no_neighbours, "no_neighbours"},
    {CertificateVerdict::confirmed, "confirmed"},
}};

/// The evidence for and against the best point of a run being the optimum.
struct Certificate {
  /// The findings of a process that knows only input.json and result.json.
  struct Fresh {
    search::Neighbourhood around;
    double difference = 0;   ///< its objective minus the recorded one
    bool identical = false;  ///< bit for bit
  };
  /// Over the realisations that agree with the best one.
  struct Spread {
    std::string name, unit;
    double min = 0, max = 0, share = 0;  ///< max − min as a share of the bounds, in the coordinate of the search
  };
  std::optional<Fresh> fresh;
  std::string missing;  ///< why there is no `fresh`
  std::uint64_t realisations = 0, agreeing = 0;
  std::vector<Spread> spread;
  std::vector<std::string> at_bounds;
  bool ended_at_target = false;  ///< the search was not to go on to the optimum
  CertificateVerdict verdict = CertificateVerdict::not_checked;
  std::string sentence;  ///< empty until it is judged

  /// A fresh process found no objective there, or another one.
  [[nodiscard]] bool refuted() const {
    return verdict == CertificateVerdict::failed || verdict == CertificateVerdict::objective_differs;
  }
};

/// Fills in how many realisations end within 1e-3 (relative) of the best objective or, where the best one reached the
/// target of the run and so stopped, at or below it too; and how far their parameters are apart. `best`: its objective,
/// of a feasible point.
void add_agreement(const assembly::Assembly& assembly, const execution::RunResult& result, double best,
                   std::optional<double> target, Certificate& certificate);

/// Fills in verdict and sentence from the rest.
void judge(Certificate& certificate);

/// If the point contradicts the run: failed, objective_differs or not_an_optimum.
std::optional<execution::Warning> certificate_warning(const std::string& label, const Certificate& certificate);

}  // namespace tunica::comparison
