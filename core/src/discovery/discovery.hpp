// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/detection/analysis.hpp"
#include "diagnosis/result.hpp"
#include "discovery/curves.hpp"
#include "discovery/history.hpp"
#include "discovery/request.hpp"
#include "discovery/rivals.hpp"
#include "discovery/search.hpp"

/// Which terms the energy lacks, or is made of, where no mechanism of the catalogue says it: docs/discovery.md.
namespace tunica::discovery {

/// Why the verdict is what it is.
enum class ReasonKind {
  residuals_like_noise,
  terms_found,
  form_open,
  invariant_open,
  not_an_energy,
  rig_explains,
  name_explains,
  rig_rival,
  not_clean,
  no_term,
  gross_rows
};
const char* code_of(ReasonKind kind);

struct Reason {
  ReasonKind kind;
  std::string text;  ///< a sentence
};

/// One way to explain the data: terms, or a mechanism.
struct Alternative {
  std::vector<KindPointer> kinds;
  std::string mechanism;  ///< empty where terms explain it
  bool remembers = false;
  double probability = 0;
  double chi2 = 0;
};

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
  diagnosis::Verdict verdict = diagnosis::Verdict::nothing_detected;
  std::vector<Reason> reasons;
  std::optional<SetFit> best;          ///< none: nothing was searched, or nothing was found
  std::vector<FoundTerm> terms;        ///< of the best
  std::vector<Alternative> ambiguity;  ///< 92.5 % of the probability, likeliest first
  std::vector<Rival> rivals;           ///< mechanisms, likeliest first
  std::optional<Rival> name;           ///< of the catalogue, for an energy that explains the data as well
  PathDependence paths;
  double chi2_before = 0, chi2_after = 0, p_after = 1;
  std::vector<diagnosis::HeldOut> held_out;
  std::string next;  ///< what to measure to tell the alternatives apart; empty where nothing does
  std::vector<diagnosis::Warning> warnings;
  std::size_t sets_tried = 0;
};

/// A whole discovery. Deterministic given the seed, for any number of threads. Throws InputError where data or names do
/// not fit, diagnosis::BaseFitFailure where the base cannot be fitted.
Discovery discover(const experiment::Experiment& experiment, const Request& request,
                   const plugins::Catalogue& catalogue, const diagnosis::Progress& progress = {});

/// The step that follows a diagnosis: what is searched in an analysis that there is.
Discovery discover_in(const diagnosis::Inquiry& inquiry, diagnosis::Analysis analysis, const Request& request,
                      bool has_directions);

}  // namespace tunica::discovery
