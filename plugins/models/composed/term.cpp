// SPDX-License-Identifier: Apache-2.0
#include "term.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "tunica/error.hpp"
#include "volume_laws.hpp"

namespace tunica::composed {

namespace {

using Json = nlohmann::ordered_json;

template <class Value>
using Words = std::vector<std::pair<std::string, Value>>;

const Words<Quantity> quantities{{"I1", Quantity::first_invariant},
                                 {"I2", Quantity::second_invariant},
                                 {"fibre", Quantity::fibre},
                                 {"coupling", Quantity::coupling},
                                 {"radial", Quantity::radial},
                                 {"across", Quantity::across},
                                 {"stretches", Quantity::stretches},
                                 {"I1*I2", Quantity::product},
                                 {"I1^2*I2", Quantity::product},
                                 {"I1*I2^2", Quantity::product},
                                 {"J", Quantity::volume}};
/// The same invariants of the strain at constant volume.
const Words<Quantity> isochoric_quantities{{"I1bar", Quantity::first_invariant}, {"I2bar", Quantity::second_invariant},
                                           {"fibrebar", Quantity::fibre},        {"stretchesbar", Quantity::stretches},
                                           {"I1bar*I2bar", Quantity::product},   {"I1bar^2*I2bar", Quantity::product},
                                           {"I1bar*I2bar^2", Quantity::product}};
const Words<Family> families{{"axial", Family::axial},
                             {"circumferential", Family::circumferential},
                             {"diagonal", Family::diagonal},
                             {"single", Family::single}};
const Words<Dispersion> dispersions{
    {"none", Dispersion::none}, {"rotational", Dispersion::rotational}, {"two_planes", Dispersion::two_planes}};
const Words<EnergyPart::Active> switches{{"strain", EnergyPart::Active::argument_positive},
                                         {"stretch", EnergyPart::Active::fibre_stretched},
                                         {"none", EnergyPart::Active::always}};
const std::vector<std::string> keys{"name",         "invariant",  "law",      "family",
                                    "fibre_switch", "dispersion", "angle_of", "knots"};

template <class Value>
std::vector<std::string> words_of(const Words<Value>& all) {
  std::vector<std::string> words;
  for (const auto& [word, value] : all) words.push_back(word);
  return words;
}

/// One entry of the list while it is read; messages name its place.
class Entry {
 public:
  Entry(const Json& json, std::size_t position) : json_(json), place_(fmt::format("\"terms\", term {}", position + 1)) {
    if (!json.is_object()) fail("found no object", "Write {\"name\": …, \"invariant\": …, \"law\": …}");
    for (const auto& [key, value] : json.items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        fail(fmt::format("the key '{}' is not known", key), fmt::format("Write one of {}", fmt::join(keys, ", ")));
  }

  [[noreturn]] void fail(const std::string& found, const std::string& cure) const {
    throw InputError(fmt::format("{}: {}. {}.", place_, found, cure));
  }
  [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }
  [[nodiscard]] std::string text(const char* key) const {
    if (!has(key)) fail(fmt::format("\"{}\" is missing", key), fmt::format("Add \"{}\": text", key));
    if (!json_[key].is_string()) fail(fmt::format("\"{}\" is no text", key), "Write it in quotes");
    return json_[key];
  }
  template <class Value>
  Value word(const char* key, const Words<Value>& all, std::optional<Value> fallback = {}) const {
    if (!has(key) && fallback) return *fallback;
    const std::string given = text(key);
    for (const auto& [word, value] : all)
      if (word == given) return value;
    fail(fmt::format("\"{}\" is '{}'", key, given), fmt::format("Write one of {}", fmt::join(words_of(all), ", ")));
  }
  /// Knots of a spline: 0, and rising.
  [[nodiscard]] std::vector<double> knots() const {
    constexpr std::size_t most = 14;
    const char* const cure = "Give 2 to 14 rising numbers, the first 0, over the range of the invariant in the data";
    if (!has("knots")) fail("a spline has no \"knots\"", cure);
    std::vector<double> knots;
    if (!json_["knots"].is_array()) fail("\"knots\" is no list", cure);
    for (const Json& one : json_["knots"]) {
      if (!one.is_number()) fail("\"knots\" has an entry that is no number", cure);
      knots.push_back(one);
    }
    const bool rising = std::adjacent_find(knots.begin(), knots.end(), std::greater_equal<>()) == knots.end();
    if (knots.size() < 2 || knots.size() > most || knots.front() != 0 || !rising)
      fail("\"knots\" is no rising list that begins at 0", cure);
    return knots;
  }
  void name_it(const std::string& name) { place_ += fmt::format(" ('{}')", name); }

 private:
  const Json& json_;
  std::string place_;
};

Words<Quantity> all_quantities() {
  Words<Quantity> all = quantities;
  all.insert(all.end(), isochoric_quantities.begin(), isochoric_quantities.end());
  return all;
}

/// The law by its name: one of those of the invariant.
Law law_of(const Entry& entry, const Term& term) {
  const std::string name = entry.text("law");
  const bool of_volume = term.quantity == Quantity::volume;
  const auto knows = [&name](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const std::vector<std::string>& names = of_volume ? volume_law_names() : law_names();
  if (!knows(names) && (knows(law_names()) || knows(volume_law_names())))
    entry.fail(fmt::format("the law '{}' is not one of the invariant '{}'", name, entry.text("invariant")),
               fmt::format("Take one of {}", fmt::join(names, ", ")));
  if (!knows(names))
    entry.fail(fmt::format("\"law\" is '{}'", name), fmt::format("Write one of {}", fmt::join(names, ", ")));
  if (of_volume) return volume_law(name);
  return law(name, name == "spline" ? entry.knots() : std::vector<double>{}, term.isotropic());
}

/// The requirements of the invariant on the law, and the keys of each invariant.
void check(const Entry& entry, const Term& term) {
  const auto goes_with = [&entry](const char* key, bool fits, const char* words) {
    if (entry.has(key) && !fits)
      entry.fail(fmt::format("\"{}\" goes with the invariant {} only", key, words), "Take it out");
  };
  goes_with("family", term.has_family(), "'fibre' or 'across'");
  goes_with("dispersion", term.quantity == Quantity::fibre, "'fibre'");
  goes_with("fibre_switch", term.quantity == Quantity::fibre || term.quantity == Quantity::radial,
            "'fibre' or 'radial'");
  if (entry.has("angle_of") && !term.is_angled())
    entry.fail("\"angle_of\" is given, and the term has no angle", "Take it out");
  if (entry.has("knots") && term.law.name != "spline")
    entry.fail("\"knots\" go with the law 'spline' only", "Take them out");
  if (!term.isotropic() && !term.law.rests)
    entry.fail(fmt::format("the law '{}' pulls at rest, which only I1 and I2 may", term.law.name),
               "Take quadratic, cubic, power, exponential_square or spline");
  if ((term.quantity == Quantity::coupling || term.quantity == Quantity::across) && !term.law.even)
    entry.fail(fmt::format("the law '{}' does not grow on both sides of 0, as a coupling needs it", term.law.name),
               "Take quadratic or exponential_square");
  if (term.quantity == Quantity::product && term.law.name != "linear")
    entry.fail(fmt::format("the law '{}' is given, and a product of invariants has no law but 'linear'", term.law.name),
               "Write \"law\": \"linear\"");
  if (term.quantity == Quantity::radial && term.active == EnergyPart::Active::fibre_stretched)
    entry.fail("\"fibre_switch\" is 'stretch', and the invariant 'radial' has no fibres", "Write strain or none");
}

Term read_term(const Json& json, std::size_t position) {
  Entry entry(json, position);
  Term term;
  term.name = entry.text("name");
  entry.name_it(term.name);
  const bool plain =
      !term.name.empty() && std::isalpha(static_cast<unsigned char>(term.name.front())) &&
      std::all_of(term.name.begin(), term.name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!plain)
    entry.fail("the name is not a letter, then letters, digits and '_'", "Give another; parameters begin with it");
  term.quantity = entry.word("invariant", all_quantities());
  term.isochoric = entry.text("invariant").find("bar") != std::string::npos;
  if (term.quantity == Quantity::stretches) {
    if (entry.has("law") && entry.text("law") != "power")
      entry.fail("a term of the principal stretches has no law but 'power'", "Take \"law\" out");
    check(entry, term);
    return term;
  }
  term.law = law_of(entry, term);
  if (term.quantity == Quantity::product) {
    const std::string powers = entry.text("invariant");
    term.second_power = powers.ends_with("^2") ? 2 : 1;
    term.first_power = term.second_power == 1 && powers.find('^') != std::string::npos ? 2 : 1;
    // A coefficient of a product is negative as often as not.
    if (term.law.name == "linear")
      term.law.parameters = {{"mu", "kPa", 0, -1e4, 1e4, Scale::linear, "Twice the weight of the product.", ""}};
  }
  if (term.has_family()) term.family = entry.word("family", families);
  if (term.quantity == Quantity::radial)
    term.active = entry.word("fibre_switch", switches, std::optional(EnergyPart::Active::always));
  if (term.quantity == Quantity::fibre) {
    term.dispersion = entry.word("dispersion", dispersions, std::optional(Dispersion::none));
    term.active = entry.word("fibre_switch", switches, std::optional(EnergyPart::Active::argument_positive));
  }
  if (entry.has("angle_of")) term.angle_of = entry.text("angle_of");
  check(entry, term);
  return term;
}

}  // namespace

std::vector<std::string> invariant_words() { return words_of(all_quantities()); }

std::vector<Term> read_terms(const std::string& json) {
  const Json list = Json::parse(json, nullptr, false);
  if (!list.is_array() || list.empty())
    throw InputError("\"terms\" is no list of terms. Write [{\"name\": …, \"invariant\": …, \"law\": …}, …].");
  std::vector<Term> terms;
  std::set<std::string> names;
  for (std::size_t k = 0; k < list.size(); ++k) {
    terms.push_back(read_term(list[k], k));
    if (!names.insert(terms.back().name).second)
      throw InputError(fmt::format("\"terms\": two terms are called '{}'. Rename one.", terms.back().name));
  }
  for (const Term& term : terms) {
    if (term.angle_of.empty()) continue;
    const auto of = std::find_if(terms.begin(), terms.end(), [&](const Term& t) { return t.name == term.angle_of; });
    if (of == terms.end() || !of->is_angled() || !of->angle_of.empty())
      throw InputError(
          fmt::format("\"terms\", '{}': \"angle_of\" is '{}', which is no term with an angle of its own. "
                      "Name one, or take it out.",
                      term.name, term.angle_of));
  }
  return terms;
}

std::string terms_schema() {
  const Json text = {{"type", "string"}};
  Json term = {{"type", "object"}, {"required", {"name", "invariant"}}, {"additionalProperties", false}};
  term["properties"]["name"] = {
      {"description", "Its parameters begin with it."}, {"type", "string"}, {"pattern", "^[A-Za-z][A-Za-z0-9_]*$"}};
  term["properties"]["invariant"] = {{"description", "What the term is a function of."}, {"enum", invariant_words()}};
  std::vector<std::string> laws = law_names();
  for (const std::string& name : volume_law_names())
    if (std::find(laws.begin(), laws.end(), name) == laws.end()) laws.push_back(name);
  term["properties"]["law"] = {{"description", "How the term grows with it."}, {"enum", laws}};
  term["properties"]["family"] = {{"description", "Which fibres."}, {"enum", words_of(families)}};
  term["properties"]["dispersion"] = {{"description", "How the fibres scatter about their family."},
                                      {"enum", words_of(dispersions)},
                                      {"default", "none"}};
  term["properties"]["fibre_switch"] = {
      {"description", "When fibres carry load."}, {"enum", words_of(switches)}, {"default", "strain"}};
  term["properties"]["angle_of"] = {{"description", "The term whose angle it shares."}, {"type", "string"}};
  term["properties"]["knots"] = {{"description", "Of a spline: rising values of its invariant, the first 0."},
                                 {"type", "array"},
                                 {"items", {{"type", "number"}, {"minimum", 0}}},
                                 {"minItems", 2},
                                 {"maxItems", 14}};
  return Json{{"type", "array"}, {"minItems", 1}, {"items", term}}.dump();
}

}  // namespace tunica::composed
