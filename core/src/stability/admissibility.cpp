// SPDX-License-Identifier: Apache-2.0
#include "stability/admissibility.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tunica::stability {
namespace {

const char* direction(std::size_t axis) { return axis == 0 ? "circumferential" : "axial"; }

/// "measured to 1.4", "judged from 0.8 to 1.2".
std::string reach(const TransverseVerdict& verdict, const Domain& domain) {
  if (!verdict.asked()) return "no strip was measured";
  const bool measured = !domain.strips[verdict.axis].empty(), asked = !domain.asked[verdict.axis].empty();
  const char* const how = !asked ? "measured" : measured ? "measured or asked for" : "judged";
  return verdict.judged_from < 1 ? fmt::format("{} from {:.4g} to {:.4g}", how, verdict.judged_from, verdict.judged_to)
                                 : fmt::format("{} to {:.4g}", how, verdict.judged_to);
}

std::string onset_of(double stretch) {
  return stretch > 1 ? fmt::format("from stretch {:.4g}", stretch) : "from the start";
}

std::string words(const TransverseVerdict& verdict, const Domain& domain) {
  const std::string name = fmt::format("{} strip: ", direction(verdict.axis)), range = reach(verdict, domain);
  if (verdict.checked_from == 1 && verdict.checked_to == 1)
    return fmt::format("{}NOT ASSESSED, the response cannot be followed from rest ({})", name, range);
  const bool pulled = verdict.first_unstable.has_value(), pressed = verdict.first_unstable_pressed.has_value();
  const std::string until = verdict.stable_again ? fmt::format(" to {:.4g}", *verdict.stable_again) : " on";
  const std::string growth =
      pulled ? fmt::format("the transverse stretch λ3 grows {}{}", onset_of(*verdict.first_unstable), until) : "";
  if (verdict.stable == false && pulled && *verdict.first_unstable < verdict.judged_to)
    return fmt::format("{}UNSTABLE, {} ({})", name, growth, range);
  if (verdict.stable == false)
    return fmt::format("{}UNSTABLE, the transverse stretch λ3 falls as the strip is pressed{} ({})", name,
                       pressed ? fmt::format(" below stretch {:.4g}", *verdict.first_unstable_pressed) : "", range);
  if (verdict.asked() && !verdict.stable)
    return fmt::format("{}NO VERDICT, the response can be followed from stretch {:.4g} to {:.4g} only ({})", name,
                       verdict.checked_from, verdict.checked_to, range);
  if (!pulled)
    return fmt::format("{}the transverse stretch λ3 falls up to stretch {:.4g} ({})", name, verdict.checked_to, range);
  if (*verdict.first_unstable < verdict.judged_to)
    return fmt::format("{}stable at every measured stretch ({}); between them λ3 grows from stretch {:.5g}{}", name,
                       range, *verdict.first_unstable, until);
  if (!verdict.asked()) return fmt::format("{}{} ({})", name, growth, range);
  return fmt::format("{}stable ({}); beyond that domain {}", name, range, growth);
}

/// `all_of_them` where every path was followed to its end, else path by path; empty where none could be followed at
/// all.
std::string followed_in_words(const std::vector<PathReach>& followed, const std::function<bool(const PathReach&)>& ends,
                              const std::string& all_of_them) {
  std::vector<std::string> words;
  bool any = false, all = true;
  for (const PathReach& path : followed) {
    any = any || path.to != 1;
    all = all && ends(path);
    words.push_back(path.to != 1 ? fmt::format("{} to {:.4g}", path.path, path.to)
                                 : fmt::format("{} not at all", path.path));
  }
  if (!any) return "";
  if (all) return all_of_them;
  return fmt::format("as far as the response can be followed: {}", fmt::join(words, "; "));
}

std::string followed_in_words(const std::vector<PathReach>& followed, double limit) {
  return followed_in_words(
      followed, [limit](const PathReach& path) { return path.to > limit * (1 - 1e-9); },
      fmt::format("up to stretch {:.4g} in strips, equibiaxial extension and pure shear", limit));
}
/// Of a material that changes its volume.
std::string followed_in_words(const std::vector<PathReach>& followed, double least, double limit) {
  const auto is_of_volume = [](const PathReach& path) {
    return path.path == "expansion" || path.path == "contraction";
  };
  const auto ends = [&](const PathReach& path) {
    const double reached = std::pow(path.to, is_of_volume(path) ? 3 : 1);
    return reached > limit * (1 - 1e-9) || reached < least * (1 + 1e-9);
  };
  const bool volumes = std::any_of(followed.begin(), followed.end(), is_of_volume);
  return followed_in_words(followed, ends,
                           fmt::format("from stretch {0:.4g} to {1:.4g} in strips and sheets{2}", least, limit,
                                       volumes ? fmt::format(", and from volume {:.4g} to {:.4g}", least, limit) : ""));
}

std::string components(const std::array<double, 3>& v) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", v[0], v[1], v[2]);
}

}  // namespace

double Domain::least() const {
  double pressed = 1;
  for (const auto* of : {&strips, &asked})
    for (const std::vector<double>& stretches : *of)
      for (const double stretch : stretches) pressed = std::min(pressed, stretch);
  return pressed < 1 ? pressed : 1 / largest;
}

std::optional<bool> Admissibility::transversely_stable() const {
  bool any = false, open = false;
  for (const TransverseVerdict& verdict : transverse) {
    if (verdict.stable == false) return false;
    any = any || verdict.stable.has_value();
    open = open || (verdict.asked() && !verdict.stable);
  }
  return any && !open ? std::optional(true) : std::nullopt;
}

std::vector<std::string> Admissibility::sentences() const {
  std::vector<std::string> all;
  const auto followed_in = [&](const std::vector<PathReach>& followed) {
    return changes_volume() ? followed_in_words(followed, domain.least(), domain.largest)
                            : followed_in_words(followed, domain.largest);
  };
  if (changes_volume())
    all.emplace_back("transverse stability is of materials that keep their volume, and is not asked for");
  for (const TransverseVerdict& verdict : transverse) all.push_back(words(verdict, domain));
  const std::string elliptic = followed_in(ellipticity.followed);
  if (ellipticity.first_lost)
    all.push_back(
        fmt::format("ELLIPTICITY IS LOST at stretch {:.4g} in {}: bands of normal {} would shear along {} "
                    "(components t, z, r)",
                    *ellipticity.first_lost, ellipticity.path, components(ellipticity.n), components(ellipticity.m)));
  else if (elliptic.empty())
    all.push_back("ellipticity NOT ASSESSED: the response cannot be evaluated on any path");
  else
    all.push_back(
        fmt::format("elliptic {}; weakest, {:.3g} kPa, in {}", elliptic, ellipticity.weakest, ellipticity.path));
  if (free_faces) {
    const std::string minimal = followed_in(free_faces->followed);
    if (free_faces->first_lost)
      all.push_back(fmt::format(
          "FREE FACES ARE NOT STABLE at stretch {:.4g} in {}: the energy has no minimum over their stretches",
          *free_faces->first_lost, free_faces->path));
    else if (minimal.empty())
      all.push_back("free faces NOT ASSESSED: the response cannot be evaluated on any path");
    else
      all.push_back("free faces stable " + minimal);
  }
  if (!drucker) return all;
  const std::string stable = followed_in(drucker->followed);
  if (drucker->first_lost)
    all.push_back(
        fmt::format("DRUCKER'S CONDITION IS LOST at stretch {:.4g} in {}", *drucker->first_lost, drucker->path));
  else if (stable.empty())
    all.push_back("Drucker's condition NOT ASSESSED: the response cannot be evaluated on any path");
  else
    all.push_back("Drucker-stable " + stable);
  return all;
}

Admissibility judge_admissibility(const Model& model, std::span<const double> parameters, const Domain& domain) {
  Admissibility found;
  found.domain = domain;
  if (model.describe().compressible) {
    if (model.keeps_volume(parameters)) {
      const Model& bare = model.incompressible();
      return judge_admissibility(bare, parameters.first(bare.describe().parameters.size()), domain);
    }
    CompressibleVerdict verdict = judge_compressible(model, parameters, domain.least(), domain.largest);
    found.ellipticity = std::move(verdict.ellipticity);
    found.free_faces = std::move(verdict.free_faces);
    found.drucker = std::move(verdict.drucker);
    return found;
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::vector<double> judged = domain.strips[axis];
    judged.insert(judged.end(), domain.asked[axis].begin(), domain.asked[axis].end());
    found.transverse.push_back(
        judge_transverse(model, parameters, axis, judged, std::max(domain.beyond, domain.largest)));
  }
  const auto paths = homogeneous_paths(model, parameters, domain.largest);
  found.ellipticity = judge_ellipticity(model, parameters, paths);
  if (is_isotropic(model, parameters)) found.drucker = judge_drucker(model, parameters, paths);
  return found;
}

}  // namespace tunica::stability
