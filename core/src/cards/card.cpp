// SPDX-License-Identifier: Apache-2.0
#include "cards/card.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

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

std::string_view program_of(Target target) {
  switch (target) {
    case Target::febio:
      return "FEBio";
    case Target::abaqus:
      return "Abaqus";
    case Target::ansys:
      return "Ansys";
    case Target::calculix:
      return "CalculiX";
    case Target::lsdyna:
      return "LS-DYNA";
  }
  return "";
}

/// Whether the program has materials without change of volume.
bool has_incompressible(Target target) { return target == Target::abaqus || target == Target::ansys; }

/// The energy of the volume ratio that the program's cards have: K/2 (J − 1)², K/2 (ln J)², K/4 (J² − 1 − 2 ln J).
std::string_view volume_law_of(Target target, const Material& material) {
  if (target == Target::febio) return "logarithmic";
  if (target == Target::ansys && std::holds_alternative<LimitedChainEnergy>(material.energy)) return "simo";
  return target == Target::abaqus && has_fibres(material) ? "simo" : "quadratic";
}

/// Of a material whose compressibility was fitted.
double fitted_bulk(Target target, const Material& material, const CardSettings& settings) {
  if (settings.bulk_ratio)
    throw InputError("bulk ratio: found one beside a fit that has its own bulk modulus; leave it out");
  if (target == Target::febio && has_fibres(material))
    throw CannotExpress{"the energy of the volume in its Holzapfel-Gasser-Ogden material differs between versions",
                        "fit it without \"compressibility\""};
  if (target == Target::lsdyna)
    throw CannotExpress{"its cards take Poisson's ratio near 1/2, and the fit has a bulk modulus", ""};
  const std::string_view law = volume_law_of(target, material);
  if (material.volume.law != law)
    throw CannotExpress{fmt::format("its energy of the volume is '{}', and the fit has '{}'", law, material.volume.law),
                        fmt::format("fit \"compressibility\" with \"law\": \"{}\"", law)};
  return material.volume.bulk_modulus;
}

double bulk_of(Target target, const Material& material, const CardSettings& settings) {
  if (is_foam(material)) {
    if (settings.bulk_ratio)
      throw InputError("bulk ratio: found one beside a foam, whose volume is that of its own energy; leave it out");
    return 0;
  }
  if (material.volume.bulk_modulus > 0) return fitted_bulk(target, material, settings);
  const double usual = has_incompressible(target) ? 0 : target == Target::lsdyna ? 1e3 : 1e4;
  const double ratio = settings.bulk_ratio.value_or(usual);
  if (!std::isfinite(ratio) || ratio < 0 || (ratio > 0 && ratio < 10))
    throw InputError(
        fmt::format("bulk ratio: found {:g}, expected 0 (incompressible) or a number from 10 on; take 10000", ratio));
  if (ratio == 0 && !has_incompressible(target))
    throw InputError(
        fmt::format("bulk ratio: found 0, and {} needs a bulk modulus; take {:g}", program_of(target), usual));
  return ratio * stiffness_at_rest(material);
}

std::string paragraph_on_volume(const Draft& draft) {
  if (is_foam(draft.material) || draft.material.volume.bulk_modulus > 0)
    return "Volume: compressible, as fitted; take full integration or elements without volumetric locking.";
  if (draft.bulk == 0) return "Volume: incompressible, as fitted; take hybrid (mixed) elements.";
  // In tension P(λ) = s(λ J^(−1/3))/λ with J − 1 = σ/(3K): off by n σ/(9K), n = d ln s/d ln λ. With n = 4.5: 0.1 % at
  // K/500.
  return fmt::format(
      "Volume: the fit is incompressible; here the bulk modulus is {} {}, {:g} times the stiffness at "
      "rest. Cauchy stresses up to about {:.2g} {} are those of the fit to 0.1 %; for larger ones take a larger bulk "
      "ratio.",
      number(draft.bulk), draft.settings.units.stress, draft.bulk / (draft.stress * stiffness_at_rest(draft.material)),
      draft.bulk / 500, draft.settings.units.stress);
}

std::string card_of(Target target, const Draft& draft) {
  if (is_foam(draft.material) && target != Target::abaqus && target != Target::calculix)
    throw CannotExpress{"it has no energy of a foam with a volume term for every power",
                        "fit an incompressible model with "
                        "the mechanism \"compressibility\""};
  switch (target) {
    case Target::febio:
      return febio_card(draft);
    case Target::abaqus:
      return abaqus_card(draft);
    case Target::ansys:
      return ansys_card(draft);
    case Target::calculix:
      return calculix_card(draft);
    case Target::lsdyna:
      return lsdyna_card(draft);
  }
  return "";
}

/// The lines behind the card of the energy: *MULLINS EFFECT of Abaqus, TB,CDM of Ansys (Material Reference, "Mullins
/// Effect"). Both take r, m in units of stress, and β.
std::string softening_lines(Target target, const Draft& draft) {
  if (!draft.material.softening) return "";
  const bool isotropic = !has_fibres(draft.material);
  if ((target != Target::abaqus && target != Target::ansys) || !isotropic)
    throw CannotExpress{isotropic ? "it has no softening of Ogden and Roxburgh"
                                  : "its softening is written for isotropic energies only",
                        "fit the loading that the part will see, without the mechanism that softens"};
  const auto [r, m, beta] = *draft.material.softening;
  const std::string constants = fmt::format("{}, {}, {}", number(r), number(draft.stress * m), number(beta));
  return target == Target::abaqus ? "*MULLINS EFFECT\n" + constants + '\n'
                                  : "TB,CDM,1,1,3,PSE2\nTBDATA,1, " + constants + '\n';
}

/// Whether the program has the model, whatever the settings. Units and bulk modulus here suit every program.
bool can_express(Target target, const Material& material, bool subroutine) {
  const CardSettings settings{.density = 1000, .subroutine = subroutine};
  Draft draft{material, settings, settings.units.stress_per_kPa};
  try {
    draft.bulk = draft.stress * bulk_of(target, material, settings);
    (void)card_of(target, draft);
    (void)softening_lines(target, draft);
  } catch (const CannotExpress&) {
    return false;
  } catch (const InputError&) {
  }
  return true;
}

/// "export for FEBio or Abaqus": the other programs that have this model; "" where there is none.
std::string other_programs(Target refused, const Material& material) {
  std::vector<std::string> programs;
  for (const auto& entry : target_codes) {
    if (entry.value != refused && can_express(entry.value, material, false))
      programs.emplace_back(program_of(entry.value));
    else if (entry.value == Target::abaqus && has_fibres(material))
      programs.emplace_back(refused == Target::abaqus ? "Abaqus' user subroutine (--subroutine FILE.f)"
                                                      : "Abaqus with --subroutine FILE.f");
  }
  return programs.empty() ? "" : fmt::format("export for {}", fmt::join(programs, " or "));
}

[[noreturn]] void refuse(Target target, const Material& material, const CannotExpress& refusal) {
  const std::string others = other_programs(target, material);
  std::string cure = refusal.cure;
  if (!others.empty()) cure += (cure.empty() ? "" : ", or ") + others;
  if (cure.empty()) cure = "none of the programs of tunica export can; fit another model";
  throw InputError(
      fmt::format("{} cannot express the model '{}': {}; {}", program_of(target), material.type, refusal.reason, cure));
}

}  // namespace

Target target_of(std::string_view name) {
  if (const auto found = text::value_of(target_codes, name)) return *found;
  std::vector<std::string> known;
  for (const auto& entry : target_codes) known.insert(known.end(), std::string(entry.code));
  throw InputError(fmt::format("there are no cards for '{}'. {}", data::excerpt(name), data::suggestion(name, known)));
}

std::string joined_lines(std::span<const std::string> values) {
  std::string lines;
  for (std::size_t k = 0; k < values.size(); ++k)
    lines += values[k] + (k + 1 == values.size() || k % 8 == 7 ? "\n" : ", ");
  return lines;
}

std::string data_lines(std::span<const double> values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.insert(texts.end(), number(value));
  return joined_lines(texts);
}

std::string Draft::density() const {
  if (!settings.density) return "";
  constexpr double least = 1e-3, largest = 1e6;  // an aerogel has 1, osmium 22 600
  if (!(*settings.density >= least && *settings.density <= largest))
    throw InputError(fmt::format("density: found {:g} kg/m3, expected {:g} to {:g}; give for example 1000",
                                 *settings.density, least, largest));
  return number(*settings.density * settings.units.density_per_kg_m3);
}

std::string write_card(Target target, const Material& material, const CardSettings& settings) {
  check_name(settings.name);
  check(material);
  Draft draft{material, settings, settings.units.stress_per_kPa};
  if (settings.subroutine && (target != Target::abaqus || !has_fibres(material)))
    throw InputError(
        fmt::format("the user subroutine is for fibre models in Abaqus, and this is '{}' for {}; leave it out",
                    material.type, program_of(target)));
  try {
    draft.bulk = draft.stress * bulk_of(target, material, settings);
  } catch (const CannotExpress& refusal) {
    refuse(target, material, refusal);
  }
  std::vector<std::string> remarks = {fmt::format("Material card for {}.", program_of(target))};
  remarks.insert(remarks.end(), settings.remarks.begin(), settings.remarks.end());
  remarks.insert(remarks.end(), {fmt::format("Units: {}, {}, {}, s.", settings.units.length, settings.units.force,
                                             settings.units.stress),
                                 paragraph_on_volume(draft)});
  std::string card;
  try {
    card = card_of(target, draft) + softening_lines(target, draft);
  } catch (const CannotExpress& refusal) {
    refuse(target, material, refusal);
  }
  if (target == Target::febio) return xml_comment(remarks) + card;
  return comments(target == Target::ansys ? "!" : target == Target::lsdyna ? "$" : "**", remarks) + card;
}

}  // namespace tunica::cards
