// SPDX-License-Identifier: Apache-2.0
// What kind of function of C a model is.
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "conformance/differences.hpp"
#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "tunica/detail/hyperelastic_tensor.hpp"

namespace tunica::conformance {
namespace {

constexpr int material_draws = 20;

double largest_difference(const Tensor& a, const Tensor& b) {
  double difference = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    const double one = std::abs(a[c] - b[c]);
    if (!(one <= difference)) difference = one;
  }
  return difference;
}

Matrix rotation(int draw) {
  return Eigen::AngleAxisd(0.3 + draw, Eigen::Vector3d(1, 2, draw - 9.5).normalized()).toRotationMatrix();
}

/// Whether an invariant of its parts is shear between fibres and normal, which stretches along the axes do not show.
bool couples_fibres_and_normal(const Model& model) {
  std::vector<double> initial;
  for (const Parameter& parameter : model.describe().parameters) initial.push_back(parameter.initial);
  return std::any_of(model.parts().begin(), model.parts().end(), [&](const auto& part) {
    Invariant x;
    part->invariant(initial, x, {});
    return x.across != 0;
  });
}

/// Whether W is unchanged by a permutation of the axes, as for every isotropic material.
bool axes_are_alike(const Model& model, std::uint64_t seed) {
  if (couples_fibres_and_normal(model)) return false;
  constexpr std::array<std::array<std::size_t, 3>, 5> orders{{{0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  Sampler sampler(seed);
  for (int draw = 0; draw < 100; ++draw) {  // fibres may be slack at many
    const Point point = sampler.diagonal_point(model);
    const double energy = evaluate(model, point.C, point.p).energy;
    for (const auto& order : orders) {
      const Tensor other{point.C[order[0]], point.C[order[1]], point.C[order[2]], 0, 0, 0};
      if (!(std::abs(evaluate(model, other, point.p).energy - energy) <= 1e-10 * std::abs(energy))) return false;
    }
  }
  return true;
}

}  // namespace

Verdict response_is_objective(const Model& model, std::uint64_t seed) {
  const bool isotropic = axes_are_alike(model, seed);
  Meter meter(isotropic ? "S with S after turning observer and, the axes being alike, material"
                        : "S with S after turning the observer",
              1e-8);
  Sampler sampler(seed);
  for (int draw = 0; draw < material_draws; ++draw) {
    const Point point = sampler.point(model);
    const Matrix C = to_matrix(point.C), Q = rotation(draw);
    const Evaluated at = evaluate(model, point.C, point.p);
    const double scale = scale_of(at.stress), steepness = std::max(1.0, 1e-6 * scale_of(at.tangent) / scale);
    // A rotation after the deformation leaves C = FᵀQᵀQF alone but for rounding, which a continuous response does not
    // magnify.
    const Matrix F = Eigen::LLT<Matrix>(C).matrixU();
    const Tensor seen = to_tensor((Q * F).transpose() * (Q * F));
    const Tensor stress = evaluate(model, seen, point.p).stress;
    meter.see(largest_difference(at.stress, stress) / (steepness * scale), [&] {
      return fmt::format("S_tt = {:.10g}, and {:.10g} where F is followed by a rotation,", at.stress[0], stress[0]) +
             where(model, point);
    });
    if (!isotropic) continue;
    // W(Q C Qᵀ) = W(C) and S(Q C Qᵀ) = Q S Qᵀ for an isotropic material: shear is read as a tensor has it.
    const Evaluated turned = evaluate(model, to_tensor(Q * C * Q.transpose()), point.p);
    const Tensor expected = to_tensor(Q * to_matrix(at.stress) * Q.transpose());
    meter.see(largest_difference(turned.stress, expected) / (steepness * scale), [&] {
      return fmt::format(
                 "the energy makes no difference between the axes t, z, r, yet W = {:.10g} becomes {:.10g} where C is "
                 "turned by {:.3g} rad: the shear components of C are not read as those of a tensor,",
                 at.energy, turned.energy, 0.3 + draw) +
             where(model, point);
    });
  }
  meter.note(sampler.drawn_again());
  return meter.verdict();
}

Verdict response_has_the_symmetry_of_the_wall(const Model& model, std::uint64_t seed) {
  // Families that lie symmetrically about the axes: a reflection t → −t maps the wall on itself.
  Meter meter("S with its mirror image, t -> -t", 1e-12);
  Sampler sampler(seed);
  for (int draw = 0; draw < material_draws; ++draw) {
    const Point point = sampler.point(model);
    const Tensor& C = point.C;
    const Tensor mirrored{C[0], C[1], C[2], -C[3], C[4], -C[5]};
    const Evaluated one = evaluate(model, C, point.p);
    Tensor other = evaluate(model, mirrored, point.p).stress;
    other[3] = -other[3];
    other[5] = -other[5];
    meter.see(largest_difference(one.stress, other) / scale_of(one.stress), [&] {
      return fmt::format(
                 "S_tt = {:.10g}, {:.10g} mirrored: a material with fewer symmetries than a wall with paired fibres. "
                 "Tests that load along the axes do not see the shear stress it has there,",
                 one.stress[0], other[0]) +
             where(model, point);
    });
  }
  meter.note(sampler.drawn_again());
  return meter.verdict();
}

Verdict deviatoric_stress_vanishes_at_rest(const Model& model, std::uint64_t seed) {
  const bool whole = model.describe().compressible;
  Meter meter(whole ? "S at C = 1 with zero, over the tangent" : "deviatoric S at C = 1 with zero, over the tangent",
              1e-12);
  Sampler sampler(seed);
  for (int draw = 0; draw < material_draws; ++draw) {
    const Point rest{{1, 1, 1, 0, 0, 0}, sampler.parameters(model.describe())};
    const Evaluated at = evaluate(model, rest.C, rest.p);
    const double mean = whole ? 0 : (at.stress[0] + at.stress[1] + at.stress[2]) / 3;
    const double scale = scale_of(at.tangent) + scale_of(at.stress);
    for (std::size_t c = 0; c < 6; ++c) {
      const double deviatoric = at.stress[c] - (c < 3 ? mean : 0);
      meter.see(std::abs(deviatoric) / scale, [&] {
        return fmt::format("{}S_{} = {:.6g} kPa", whole ? "" : "deviatoric ", component_names[c], deviatoric) +
               where(model, rest);
      });
    }
  }
  return meter.verdict();
}

Verdict energy_is_the_sum_of_its_parts(const Model& model, std::uint64_t seed) {
  Meter meter("W with the sum of the energies of parts()", 1e-12);
  if (model.parts().empty()) return not_checked(meter.verdict().compared, "the model exposes no parts");
  Sampler sampler(seed);
  for (int draw = 0; draw < material_draws; ++draw) {
    const Point point = sampler.point(model);
    double sum = 0;
    for (const auto& part : model.parts())
      for (const double side : {1., -1.})
        if (side > 0 || part->describe().mirrored)
          hyperelastic::add_part_tensor(*part, side, {1, point.C, point.p, {}, {}}, {{&sum, 1}, {}, {}, {}, {}}, 0, 1);
    const double energy = evaluate(model, point.C, point.p).energy;
    meter.see(std::abs(energy - sum) / std::max(std::abs(energy), 1e-300),
              [&] { return fmt::format("W = {:.12g}, its parts make {:.12g},", energy, sum) + where(model, point); });
  }
  meter.note(sampler.drawn_again());
  return meter.verdict();
}

Verdict numbers_are_finite_or_say_so(const Model& model, std::uint64_t seed) {
  const std::string compared = "numbers at rest, and wherever W is one, within all bounds";
  const auto& declared = model.describe().parameters;
  Sampler sampler(seed);
  std::vector<std::vector<double>> all;
  std::vector<double> initial;
  for (const Parameter& parameter : declared) initial.push_back(parameter.initial);
  all.push_back(initial);
  for (std::size_t j = 0; j < declared.size(); ++j)
    for (const double bound : {declared[j].min, declared[j].max}) all.push_back(initial), all.back()[j] = bound;
  for (int draw = 0; draw < material_draws; ++draw) all.push_back(sampler.parameters(declared));
  std::size_t overflowed = 0, count = 0;
  for (const auto& p : all) {
    const Point rest{{1, 1, 1, 0, 0, 0}, p};
    if (!evaluate(model, rest.C, p).finite())
      return broken(compared, "at rest W, S, the tangent or dS/dp is no number" + where(model, rest));
    for (int draw = 0; draw < 5; ++draw) {
      const Point point{sampler.right_cauchy_green(), p};
      const Evaluated at = evaluate(model, point.C, p);
      ++count;
      if (std::isfinite(at.energy)) continue;
      ++overflowed;
      // A test finds out by the stress, which is what it works with.
      if (std::all_of(at.stress.begin(), at.stress.end(), [](double s) { return std::isfinite(s); }))
        return broken(compared,
                      fmt::format("W is {}, yet S is finite: nothing tells a test that there is no energy", at.energy) +
                          where(model, point));
    }
  }
  Verdict held{.compared = compared};
  if (overflowed > 0) held.note = fmt::format("W ends or overflows at {} of {} states, and says so", overflowed, count);
  return held;
}

}  // namespace tunica::conformance
