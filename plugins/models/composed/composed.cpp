// SPDX-License-Identifier: Apache-2.0
// A model put together in the experiment file, W = Σ_k ψ_k(x_k): terms of one invariant and one law each. And the
// mechanism that adds such a term to any model.
#include <algorithm>

#include <fmt/format.h>

#include "added_term.hpp"
#include "energy.hpp"
#include "tunica/error.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
using namespace tunica::composed;

/// Without a term of J nothing would resist a change of volume.
std::unique_ptr<Model> create(const Options& options) {
  const std::vector<Term> terms = read_terms(options.text("terms"));
  const auto isochoric = std::find_if(terms.begin(), terms.end(), [](const Term& term) { return term.isochoric; });
  const bool has_volume =
      std::any_of(terms.begin(), terms.end(), [](const Term& term) { return term.quantity == Quantity::volume; });
  if (isochoric != terms.end() && !has_volume)
    throw InputError(
        fmt::format("\"terms\", '{}': the invariant is of the strain at constant volume, and no term has the invariant "
                    "J, so that nothing resists a change of volume. Add one, or take the invariant without 'bar'.",
                    isochoric->name));
  return energy_of(terms);
}

}  // namespace

TUNICA_PLUGIN("composed", TUNICA_PLUGIN_VERSION) {
  Option terms = Option::json("terms",
                              R"([{"name": "matrix", "invariant": "I1", "law": "linear"},)"
                              R"( {"name": "fibres", "invariant": "fibre", "family": "diagonal",)"
                              R"( "law": "exponential_square"}])",
                              "List of terms: what each is a function of, and how it grows.");
  terms.schema = terms_schema();
  registry.add(ModelFactory{"composed",
                            "An energy put together in the experiment file, term by term: an invariant and a law each.",
                            "Linka, Kuhl, Comput. Methods Appl. Mech. Eng. 403:115731 (2023), for the choice of terms",
                            {terms},
                            create,
                            {},
                            true});
  registry.add(added_term());
}
