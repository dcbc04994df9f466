// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/result.hpp"
#include "discovery/history.hpp"
#include "discovery/kinds.hpp"
#include "discovery/rivals.hpp"

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
  gross_rows,
  specimens_agree,
  specimens_left_over,
  anisotropy_seen,
  leads,
  same_model,
  searched_cheaper
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

/// A set of terms that was fitted, and how it was weighed.
struct WeighedSet {
  std::vector<KindPointer> kinds;
  double log_evidence = 0;
  double chi2 = 0;
};

/// The basis of a verdict, for one specimen or for several.
struct Findings {
  bool from_nothing = false;
  std::vector<WeighedSet> sets = {};  ///< likeliest first; the first one is offered
  std::vector<Rival> rivals = {};     ///< mechanisms, likeliest first
  PathDependence paths = {};
  double rows = 0, chi2_before = 0, chi2_after = 0, p_after = 1;
  std::size_t specimens = 1;
};

struct Judgement {
  diagnosis::Verdict verdict = diagnosis::Verdict::unknown;
  std::vector<Reason> reasons;
  std::vector<Alternative> all;        ///< with their probabilities, the offered one first
  std::vector<Alternative> ambiguity;  ///< 92.5 % of the probability
  std::optional<Rival> name;           ///< of the catalogue, for an energy that explains the data as well
  bool offers_terms = false;
};

/// Terms and errors of the rig compete by their evidence, and so does memory; mechanisms that change the energy do not:
/// they are names for the same thing, and stand beside the terms.
Judgement judge(const Findings& findings);

/// Of this invariant and law among all explanations, and of this invariant with any law.
double probability_of(const Judgement& judgement, const Kind& kind);
double probability_of_invariant(const Judgement& judgement, const Kind& kind);

/// "I2 (linear)", "fibre diagonal (exponential_square) and I2 (linear)"
std::string words_of(const std::vector<KindPointer>& kinds);

/// The same, with those whose invariant is not sure behind the others: "I1 (gent) and, with probability 0.39, I2
/// (linear)".
std::string lacking_words(const Judgement& judgement, const std::vector<KindPointer>& kinds);

}  // namespace tunica::discovery
