// SPDX-License-Identifier: Apache-2.0
#include "formula.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tunica::composed {

namespace {

/// The squared stretch along the family, or its generalised form if fibres are dispersed.
std::string fibre_words(const Term& term) {
  std::string along = term.family == Family::axial ? "C_zz" : term.family == Family::circumferential ? "C_tt" : "I4";
  if (term.isochoric) along.insert(along.find('_') == std::string::npos ? along.size() : 1, "bar");
  const char* const bar = term.isochoric ? "bar" : "";
  switch (term.dispersion) {
    case Dispersion::none:
      return along;
    case Dispersion::rotational:
      return fmt::format("{0}_kappa I1{2} + (1 - 3 {0}_kappa) {1}", term.name, along, bar);
    case Dispersion::two_planes:
      return fmt::format("{0}_A I1{2} + {0}_B {1} + (1 - 3 {0}_A - {0}_B) C{2}_rr", term.name, along, bar);
  }
  return along;
}

std::string invariant_words(const Term& term) {
  const std::string& angle = term.angle_of.empty() ? term.name : term.angle_of;
  switch (term.quantity) {
    case Quantity::first_invariant:
      return term.isochoric ? "(I1bar - 3)" : "(I1 - 3)";
    case Quantity::second_invariant:
      return term.isochoric ? "(I2bar - 3)" : "(I2 - 3)";
    case Quantity::radial:
      return "(C_rr - 1)";
    case Quantity::across:
      return term.family == Family::axial ? "C_zr" : term.family == Family::circumferential ? "C_tr" : "C_fr";
    case Quantity::coupling:
      return fmt::format("(I8 - cos 2 {}_theta)", angle);
    case Quantity::fibre:
      return fmt::format("({} - 1)", fibre_words(term));
    case Quantity::product:
      return fmt::format("(I1{0} - 3){1} (I2{0} - 3){2}", term.isochoric ? "bar" : "",
                         term.first_power == 2 ? "^2" : "", term.second_power == 2 ? "^2" : "");
    case Quantity::volume:
      return "(J - 1)";
    case Quantity::stretches:
      break;
  }
  return "";
}

/// The law's formula with the invariant for x and the term's names for its parameters. The x of "exp" is a letter.
std::string filled(const Term& term) {
  const std::string& pattern = term.law.formula;
  std::string text;
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    if (pattern[k] == '$')
      text += term.name + "_";
    else if (pattern[k] == 'x' && std::isalpha(static_cast<unsigned char>(pattern[k + 1])) == 0)
      text += invariant_words(term);
    else
      text += pattern[k];
  }
  return text;
}

std::string term_words(const Term& term) {
  if (term.quantity == Quantity::stretches)
    return fmt::format("{0}_mu/{0}_alpha (l1{1}^{0}_alpha + l2{1}^{0}_alpha + l3{1}^{0}_alpha - 3)", term.name,
                       term.isochoric ? "bar" : "");
  std::string text = filled(term);
  if (term.law.name == "spline" || term.law.name == "inverse_langevin")
    text = fmt::format("[{}{}]", text, term.law.name == "spline" ? "" : ", x = " + invariant_words(term));
  if (term.is_pair())
    text = fmt::format("sum over +-{}_theta of {}", term.angle_of.empty() ? term.name : term.angle_of, text);
  return text;
}

}  // namespace

std::string formula_of(const std::vector<Term>& terms) {
  std::vector<std::string> words;
  for (const Term& term : terms) words.push_back(term_words(term));
  // What pulls at rest is relieved there; see CompressibleSum.
  const auto pulls = [](const Term& term) {
    return term.quantity == Quantity::stretches || (term.quantity != Quantity::product && !term.law.rests);
  };
  const bool relieved =
      std::any_of(terms.begin(), terms.end(), [](const Term& term) { return term.changes_volume(); }) &&
      std::any_of(terms.begin(), terms.end(), [&](const Term& term) { return !term.isochoric && pulls(term); });
  return fmt::format("W = {}{}", fmt::join(words, " + "), relieved ? " - a ln J, a so that S = 0 at rest" : "");
}

}  // namespace tunica::composed
