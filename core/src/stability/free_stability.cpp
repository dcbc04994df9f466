// SPDX-License-Identifier: Apache-2.0
#include "stability/free_stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Eigenvalues>

#include "tunica/detail/free_faces.hpp"

namespace tunica::stability {
namespace {

constexpr std::size_t states_a_path = 25;

/// A path from rest to the stretch `to`, in principal stretches; those along the free axes are solved for.
struct Homogeneous {
  std::string name;
  std::vector<std::size_t> free;
  std::function<std::array<double, 3>(double)> stretch;
  double to;
};

std::vector<Homogeneous> homogeneous(double least, double largest) {
  using Stretches = std::array<double, 3>;
  const auto strip_t = [](double x) { return Stretches{x, 1, 1}; };
  const auto strip_z = [](double x) { return Stretches{1, x, 1}; };
  const auto sheet = [](double x) { return Stretches{x, x, 1}; };
  const auto chamber = [](double x) { return Stretches{1, 1, x}; };
  const auto ball = [](double x) { return Stretches{x, x, x}; };
  return {{"circumferential strip", {1, 2}, strip_t, largest},
          {"circumferential strip, pressed", {1, 2}, strip_t, least},
          {"axial strip", {0, 2}, strip_z, largest},
          {"axial strip, pressed", {0, 2}, strip_z, least},
          {"equibiaxial extension", {2}, sheet, largest},
          {"equibiaxial compression", {2}, sheet, least},
          {"pure shear, circumferential", {2}, strip_t, largest},
          {"pure shear, axial", {2}, strip_z, largest},
          {"confined compression", {}, chamber, least},
          {"expansion", {}, ball, std::cbrt(largest)},
          {"contraction", {}, ball, std::cbrt(least)}};
}

/// Follows one path, and asks a condition at its states.
class Walk {
 public:
  Walk(const Model& model, std::span<const double> parameters, const Homogeneous& path)
      : model_(model), parameters_(parameters), path_(path) {
    free_faces::Point point = this->point();
    for (std::size_t k = 1; k <= states_a_path; ++k) {
      const auto at = state(point, std::pow(path.to, static_cast<double>(k) / states_a_path));
      if (!at) return;
      states_.push_back(*at);
    }
  }

  /// The states up to the first one that fails, or that cannot be asked. `value(state)` is none where it cannot, and
  /// the condition is lost where it is not above 0; then the last state is where it is lost, by bisection.
  template <class Value>
  void ask(const Value& value, PathReach& followed,
           const std::function<void(const Deformation&, double, bool)>& found) const {
    double sound = 1;
    for (const Deformation& at : states_) {
      const std::optional<double> here = value(at);
      if (!here) return;
      followed.to = at.along;
      if (*here > 0) {
        found(at, *here, false);
        sound = at.along;
        continue;
      }
      Deformation lost = at;
      double left = *here;
      while (std::abs(lost.along - sound) > 1e-9 * lost.along) {
        free_faces::Point point = this->point();
        const auto middle = state(point, std::sqrt(sound * lost.along));
        const auto there = middle ? value(*middle) : std::nullopt;
        if (!there) break;
        if (*there > 0) {
          sound = middle->along;
        } else {
          lost = *middle;
          left = *there;
        }
      }
      found(lost, left, true);
      followed.to = lost.along;
      return;
    }
  }

 private:
  [[nodiscard]] free_faces::Point point() const {
    std::vector<free_faces::Tensor> faces;
    for (const std::size_t axis : path_.free) {
      free_faces::Tensor face{};
      face[axis] = 1;
      faces.push_back(face);
    }
    return {model_, parameters_, faces};
  }
  [[nodiscard]] std::optional<Deformation> state(free_faces::Point& point, double x) const {
    free_faces::Tensor prescribed{};
    const std::array<double, 3> stretch = path_.stretch(x);
    for (std::size_t a = 0; a < 3; ++a) prescribed[a] = stretch[a] * stretch[a];
    for (const std::size_t axis : path_.free) prescribed[axis] = 0;
    if (!point.solve(prescribed, false).ok()) return std::nullopt;
    Deformation at{{}, x};
    for (std::size_t a = 0; a < 3; ++a) at.stretch[a] = std::sqrt(point.C()[a]);
    return at;
  }

  const Model& model_;
  std::span<const double> parameters_;
  const Homogeneous& path_;
  std::vector<Deformation> states_;
};

/// Least eigenvalue of K.
std::optional<double> least_of_free_faces(const Model& model, std::span<const double> parameters,
                                          const std::vector<std::size_t>& free, const Deformation& at) {
  std::array<double, 6> C{}, S;
  std::array<double, 36> tangent;
  for (std::size_t a = 0; a < 3; ++a) C[a] = at.stretch[a] * at.stretch[a];
  if (!model.evaluate({1, C, parameters, {}, {}}, {{}, S, tangent, {}, {}}).ok()) return std::nullopt;
  const auto K = [&](std::size_t k, std::size_t l) { return C[k] * C[l] * tangent[6 * k + l]; };
  const double first = K(free[0], free[0]);
  double least = first;
  if (free.size() == 2) {
    const double second = K(free[1], free[1]);
    least = 0.5 * (first + second) - std::hypot(0.5 * (first - second), K(free[0], free[1]));
  }
  return std::isfinite(least) ? std::optional(least) : std::nullopt;
}

bool nearer_to_rest(double along, const std::optional<double>& other) {
  return !other || std::abs(std::log(along)) < std::abs(std::log(*other));
}

/// Takes what was found on a path into a verdict. Whether it is now the one that is told.
template <class Verdict>
bool take(const std::string& path, double value, const Deformation& at, bool lost, Verdict& verdict) {
  const bool told =
      lost ? nearer_to_rest(at.along, verdict.first_lost) : !verdict.first_lost && value < verdict.weakest;
  verdict.weakest = std::min(verdict.weakest, value);
  if (lost && told) verdict.first_lost = at.along;
  if (told) verdict.path = path;
  return told;
}

}  // namespace

CompressibleVerdict judge_compressible(const Model& model, std::span<const double> parameters, double least,
                                       double largest) {
  CompressibleVerdict verdict;
  constexpr double none = std::numeric_limits<double>::infinity();
  verdict.ellipticity.weakest = verdict.free_faces.weakest = none;
  if (is_isotropic(model, parameters)) verdict.drucker.emplace().weakest = none;
  for (const Homogeneous& path : homogeneous(least, largest)) {
    const Walk walk(model, parameters, path);
    const auto ask = [&](auto& condition, const auto& value, const auto& also) {
      PathReach& followed = condition.followed.emplace_back(PathReach{path.name});
      walk.ask(value, followed, [&](const Deformation& at, double weakest, bool lost) {
        if (take(path.name, weakest, at, lost, condition)) also(at);
      });
    };
    const auto nothing = [](const Deformation&) {};
    ask(
        verdict.ellipticity, [&](const Deformation& at) { return least_wave_stiffness(model, parameters, at.stretch); },
        [&](const Deformation& at) { set_weakest_wave(model, parameters, at, verdict.ellipticity); });
    if (!path.free.empty())
      ask(
          verdict.free_faces,
          [&](const Deformation& at) { return least_of_free_faces(model, parameters, path.free, at); }, nothing);
    if (verdict.drucker)
      ask(
          *verdict.drucker, [&](const Deformation& at) { return least_drucker(model, parameters, at.stretch); },
          nothing);
  }
  return verdict;
}

}  // namespace tunica::stability
