// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/detection/analysis.hpp"
#include "diagnosis/evidence/stand_ins.hpp"
#include "diagnosis/result.hpp"
#include "discovery/curves.hpp"
#include "discovery/judgement.hpp"
#include "discovery/request.hpp"
#include "discovery/set_fit.hpp"

/// Which terms the energy lacks, or is made of, where no mechanism of the catalogue says it: docs/discovery.md.
namespace tunica::discovery {

using diagnosis::StandIns;

struct FoundTerm {
  std::string name;
  KindPointer kind;
  double probability = 0;            ///< of the invariant and the law, among all sets
  double invariant_probability = 0;  ///< of the invariant with any law
  std::vector<diagnosis::Amplitude> parameters;
  TermCurve curve;
};

struct Discovery {
  Request request;
  diagnosis::Analysis analysis;
  std::shared_ptr<const Subject> subject;
  Judgement judgement = {};
  std::optional<SetFit> best = {};    ///< none: nothing was searched, or nothing was found
  std::vector<FoundTerm> terms = {};  ///< of the best
  std::vector<Rival> rivals = {};     ///< mechanisms, likeliest first
  PathDependence paths = {};
  double chi2_before = 0, chi2_after = 0, p_after = 1;
  std::vector<diagnosis::HeldOut> held_out = {};
  std::string next = {};  ///< what to measure to tell the alternatives apart; empty where nothing does
  std::vector<diagnosis::Warning> warnings = {};
  std::size_t sets_tried = 0;
  StandIns stand_ins = {};      ///< of the tests; the analysis, and all but the best set, are theirs
  std::string anisotropy = {};  ///< what the data say of directions that the base lacks; empty: nothing
};

/// A whole discovery. Deterministic given the seed, for any number of threads. Throws InputError where data or names do
/// not fit, diagnosis::BaseFitFailure where the base cannot be fitted.
Discovery discover(const experiment::Experiment& experiment, const Request& request,
                   const plugins::Catalogue& catalogue, const diagnosis::Progress& progress = {});

/// The step that follows a diagnosis: what is searched in an analysis that there is. Where that is one with stand-ins,
/// what is found is fitted with the tests themselves.
Discovery discover_in(const diagnosis::Inquiry& inquiry, diagnosis::Analysis analysis, const Request& request,
                      bool has_directions, const StandIns& stand_ins = {});

}  // namespace tunica::discovery
