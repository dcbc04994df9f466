// SPDX-License-Identifier: Apache-2.0
#include "cards/card.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "cards/comment.hpp"
#include "cards/writers.hpp"
#include "data/nearest.hpp"
#include "tunica/error.hpp"

namespace tunica::cards {

namespace {

void check_name(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  const bool usual = std::all_of(name.begin(), name.end(),
                                 [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; });
  if (name.empty() || name.size() > 40 || !letter(name.front()) || !usual)
    throw InputError(
        fmt::format("name of the material: found '{}', expected a letter, then letters, digits, '_' or '-', at most "
                    "40 in all",
                    data::excerpt(name)));
}

double bulk_of(Target target, const Material& material, const CardSettings& settings) {
  const double ratio = settings.bulk_ratio.value_or(target == Target::abaqus ? 0 : 1e4);
  if (!std::isfinite(ratio) || ratio < 0 || (ratio > 0 && ratio < 10))
    throw InputError(
        fmt::format("bulk ratio: found {:g}, expected 0 (incompressible) or a number from 10 on; take 10000", ratio));
  if (ratio == 0 && target == Target::calculix)
    throw InputError(
        "bulk ratio: found 0, and CalculiX then takes Poisson's ratio 0.475, far from incompressible; take 10000");
  return ratio * stiffness_at_rest(material);
}

std::string paragraph_on_volume(const Draft& draft) {
  if (draft.bulk == 0) return "Volume: incompressible, as fitted; take hybrid (mixed) elements.";
  return fmt::format(
      "Volume: the fit is incompressible; here the bulk modulus is {} {}, {:g} times the stiffness at "
      "rest. The relative change of volume is the pressure over it.",
      number(draft.bulk), draft.settings.units.stress, draft.bulk / (draft.stress * stiffness_at_rest(draft.material)));
}

}  // namespace

Target target_of(std::string_view name) {
  if (const auto found = text::value_of(target_codes, name)) return *found;
  std::vector<std::string> known;
  for (const auto& entry : target_codes) known.insert(known.end(), std::string(entry.code));
  throw InputError(fmt::format("there are no cards for '{}'. {}", data::excerpt(name), data::suggestion(name, known)));
}

double Draft::modulus(const std::string& parameter) const { return stress * value_of(material, parameter); }

void refuse(std::string_view program, const Material& material, std::string_view reason, std::string_view cure) {
  throw InputError(fmt::format("{} cannot express the model '{}': {}; {}", program, material.type, reason, cure));
}

std::string data_lines(std::span<const double> values) {
  std::string lines;
  for (std::size_t k = 0; k < values.size(); ++k)
    lines += number(values[k]) + (k + 1 == values.size() || k % 8 == 7 ? "\n" : ", ");
  return lines;
}

std::string write_card(Target target, const Material& material, const CardSettings& settings) {
  check_name(settings.name);
  Draft draft{material, settings, settings.units.stress_per_kPa};
  const std::vector<std::string> known = {"neo_hooke", "mooney_rivlin", "yeoh",           "gent",      "ogden",
                                          "hgo",       "gho",           "holzapfel_2015", "four_fibre"};
  if (std::find(known.begin(), known.end(), material.type) == known.end())
    throw InputError(fmt::format("no card is known for the model '{}'. {}", data::excerpt(material.type),
                                 data::suggestion(material.type, known)));
  draft.bulk = draft.stress * bulk_of(target, material, settings);
  const std::string card = target == Target::calculix ? calculix_card(draft) : abaqus_card(draft);
  std::string head;
  for (const auto& remark : settings.remarks) head += comment("**", remark);
  head += comment(
      "**", fmt::format("Units: {}, {}, {}, s.", settings.units.length, settings.units.force, settings.units.stress));
  head += comment("**", paragraph_on_volume(draft));
  return head + card;
}

}  // namespace tunica::cards
