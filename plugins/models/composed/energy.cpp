// SPDX-License-Identifier: Apache-2.0
#include "energy.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "compressible_sum.hpp"
#include "formula.hpp"
#include "fused.hpp"
#include "term_part.hpp"
#include "tunica/error.hpp"
#include "tunica/models/invariant_polynomial.hpp"
#include "tunica/models/principal_stretches.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "with_stretches.hpp"

namespace tunica::composed {
namespace {

constexpr std::size_t most_stretch_terms = 6;

/// Where the parameters of a term stand in the model.
struct Places {
  std::vector<std::size_t> law, invariant;
};

/// The table of parameters grows term by term.
class Layout {
 public:
  explicit Layout(const std::vector<Term>& terms) {
    for (const Term& term : terms) places_[term.name] = places_of(term);
    // A shared angle may be of a term further down.
    for (const Term& term : terms)
      if (!term.angle_of.empty()) {
        auto& own = places_[term.name].invariant;
        own.insert(own.begin(), places_[term.angle_of].invariant.front());
      }
  }

  [[nodiscard]] const Places& of(const Term& term) const { return places_.at(term.name); }
  [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }

 private:
  std::size_t add(const Term& term, Parameter parameter) {
    parameter.name = term.name + "_" + parameter.name;
    parameters_.push_back(std::move(parameter));
    return parameters_.size() - 1;
  }

  Places places_of(const Term& term) {
    Places places;
    if (term.quantity == Quantity::stretches) {
      const char* const source = "Ogden 1972";
      places.law = {
          add(term, {"mu", "kPa", 100, -5000, 5000, Scale::linear, "Coefficient; mu alpha > 0 stiffens.", source}),
          add(term, {"alpha", "1", 2, -30, 30, Scale::linear, "Exponent.", source})};
      return places;
    }
    for (const Parameter& parameter : term.law.parameters) places.law.push_back(add(term, parameter));
    if (term.is_angled() && term.angle_of.empty()) places.invariant.push_back(add(term, arterial::theta()));
    if (term.dispersion == Dispersion::rotational)
      places.invariant.push_back(add(term, {"kappa", "1", 0.1, 0, 1. / 3, Scale::linear, "Dispersion of the fibres.",
                                            "Gasser, Ogden, Holzapfel 2006"}));
    if (term.dispersion == Dispersion::two_planes) {
      const char* const source = "Holzapfel, Niestrawska, Ogden, Reinisch, Schriefl 2015";
      places.invariant.push_back(add(term, {"A", "1", 0.2, 0, 1. / 3, Scale::linear, "Weight of I1.", source}));
      places.invariant.push_back(
          add(term, {"B", "1", 0.4, 0, 1, Scale::linear, "Weight of the fibre direction.", source}));
    }
    return places;
  }

  std::vector<Parameter> parameters_;
  std::map<std::string, Places> places_;
};

/// The generalised structure tensor has no negative weight (Holzapfel et al. 2015, §2.3).
void add_admissible(const Term& term, const Places& places, std::vector<Combination>& all) {
  if (term.dispersion != Dispersion::two_planes) return;
  const std::size_t b = places.invariant.back(), a = places.invariant[places.invariant.size() - 2];
  const auto named = [&](const char* pattern) { return fmt::format(fmt::runtime(pattern), fmt::arg("t", term.name)); };
  all.push_back({named("{t}_A + {t}_B"), "1", {a, b}, [a, b](std::span<const double> p) { return p[a] + p[b]; }, ""});
  all.push_back({named("1 - 2 {t}_A - {t}_B"),
                 "1",
                 {a, b},
                 [a, b](std::span<const double> p) { return 1 - 2 * p[a] - p[b]; },
                 ""});
}

template <std::size_t terms>
std::unique_ptr<Model> stretches(ModelDescription description) {
  return std::make_unique<PrincipalStretches<laws::Ogden<terms>>>(std::move(description));
}

std::unique_ptr<Model> stretch_model(const std::vector<Parameter>& all, const std::vector<std::size_t>& indices) {
  ModelDescription description;
  for (const std::size_t index : indices) description.parameters.push_back(all[index]);
  static constexpr std::array makers{stretches<1>, stretches<2>, stretches<3>,
                                     stretches<4>, stretches<5>, stretches<6>};
  return makers.at(indices.size() / 2 - 1)(std::move(description));
}

/// All terms but those of the principal stretches. A product is several parts.
EnergyParts parts_of(const std::vector<Term>& terms, const Layout& layout) {
  EnergyParts parts;
  for (const Term& term : terms) {
    if (term.quantity == Quantity::stretches) continue;
    if (term.quantity != Quantity::product) {
      parts.push_back(std::make_unique<TermPart>(term, layout.of(term).law, layout.of(term).invariant));
      continue;
    }
    for (auto& part :
         isotropic::polynomial_parts({{term.first_power, term.second_power, layout.of(term).law.front(), 0.5}}))
      parts.push_back(std::move(part));
  }
  return parts;
}

/// The same sum with the terms of I1 as one part, and those of I2 as another.
EnergyParts fused_parts_of(const std::vector<Term>& terms, const Layout& layout) {
  EnergyParts fused;
  std::vector<Term> others;
  for (const Quantity quantity : {Quantity::first_invariant, Quantity::second_invariant}) {
    std::vector<Term> alike;
    std::size_t parameters = 0;
    for (const Term& term : terms) {
      if (term.quantity != quantity) continue;
      parameters += layout.of(term).law.size();
      (parameters <= hyperelastic::max_part_parameters ? alike : others).push_back(term);
    }
    if (!alike.empty()) fused.push_back(std::make_unique<FusedPart>(parts_of(alike, layout)));
  }
  for (const Term& term : terms)
    if (!term.isotropic() || term.quantity == Quantity::product) others.push_back(term);
  for (auto& part : parts_of(others, layout)) fused.push_back(std::move(part));
  return fused;
}

std::unique_ptr<Model> hyperelastic_model(const ModelDescription& description, const std::vector<Term>& terms,
                                          const Layout& layout) {
  EnergyParts parts = parts_of(terms, layout), fused = fused_parts_of(terms, layout);
  if (fused.size() == parts.size()) return std::make_unique<Hyperelastic>(description, std::move(parts));
  return std::make_unique<FusedModel>(description, std::move(parts), std::move(fused));
}

std::unique_ptr<Model> elastic_model(ModelDescription description, const std::vector<Term>& terms,
                                     const Layout& layout) {
  std::vector<std::size_t> of_stretches;
  for (const Term& term : terms) {
    if (term.quantity != Quantity::stretches) continue;
    const Places& places = layout.of(term);
    of_stretches.insert(of_stretches.end(), places.law.begin(), places.law.end());
  }
  if (of_stretches.empty()) return hyperelastic_model(description, terms, layout);
  if (of_stretches.size() > 2 * most_stretch_terms)
    throw InputError(
        fmt::format("\"terms\" have {} terms of the principal stretches, and a model may have {}. Take "
                    "some out.",
                    of_stretches.size() / 2, most_stretch_terms));
  const bool alone = 2 * terms.size() == of_stretches.size();
  auto invariants = alone ? nullptr : hyperelastic_model(description, terms, layout);
  auto of_principal = stretch_model(description.parameters, of_stretches);
  return std::make_unique<WithStretches>(std::move(description), std::move(invariants), std::move(of_principal),
                                         std::move(of_stretches));
}

/// The terms of C, those of C̄ and those of J apart.
std::unique_ptr<Model> compressible_model(ModelDescription description, const std::vector<Term>& terms,
                                          const Layout& layout) {
  std::vector<CompressibleSum::VolumeTerm> of_volume;
  std::vector<Term> full, isochoric;
  for (const Term& term : terms) {
    if (term.quantity == Quantity::volume)
      of_volume.push_back({term.law.respond, layout.of(term).law});
    else
      (term.isochoric ? isochoric : full).push_back(term);
  }
  const auto model = [&](const std::vector<Term>& some) {
    return some.empty() ? nullptr : elastic_model(description, some, layout);
  };
  auto of_full = model(full), of_isochoric = model(isochoric);
  return std::make_unique<CompressibleSum>(std::move(description), std::move(of_full), std::move(of_isochoric),
                                           std::move(of_volume));
}

}  // namespace

std::unique_ptr<Model> energy_of(const std::vector<Term>& terms) {
  const Layout layout(terms);
  ModelDescription description{.type = "composed", .parameters = layout.parameters()};
  if (description.parameters.size() > hyperelastic::max_model_parameters)
    throw InputError(
        fmt::format("\"terms\" have {} parameters together, and a model may have {}. Take terms or knots out.",
                    description.parameters.size(), hyperelastic::max_model_parameters));
  description.formula = formula_of(terms);
  for (const Term& term : terms) add_admissible(term, layout.of(term), description.admissible);
  const bool changes_volume =
      std::any_of(terms.begin(), terms.end(), [](const Term& term) { return term.changes_volume(); });
  return changes_volume ? compressible_model(std::move(description), terms, layout)
                        : elastic_model(std::move(description), terms, layout);
}

}  // namespace tunica::composed
