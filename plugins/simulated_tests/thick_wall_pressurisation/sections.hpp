// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "layers.hpp"
#include "rule.hpp"
#include "tunica/detail/vector_level.hpp"
#include "wall.hpp"

namespace tunica::thick_wall {

/// The axial stretch and the unknown of one section, y = ln ri.
struct Section {
  double axial_stretch, y;
};

/// Pressure and axial force of the wall alone, with what Newton's method and the path need of their derivatives.
struct WallForces {
  double p, p_y, p_axial;
  double F, F_y;
};

/// Derivatives of pressure and axial force by the geometric variables, one entry a section.
struct GeometricDerivatives {
  std::array<const double*, variable_count> p, F;
};

/// σt − σr that each material has before anything deforms: 0 in a passive one. The closing of the sector leaves it out.
struct RestStress {
  std::vector<double> value;  ///< of each material
  std::vector<double> by_parameter;
};

/// Quadrature over the wall, for a batch of sections in one call of the model. With x = ln R, T = σt − σr = 2 (c g_t −
/// c_r g_r), Z = σz − σr = 2 (c_z g_z − c_r g_r):
///
///   p = b ∫ T/c dx,   F = π b/K² ∫ (2Z − T) R² dx.
///
/// Gauss–Legendre in every layer, and in the pieces into which kinks of the material cut them;
/// in ln R, because there a thick wall is as smooth as a thin one. Lanes run over the sections: point m of section i
/// stands at [m · sections + i]. One object a thread: its memory grows to the largest batch seen, then nothing is
/// allocated.
class Sections {
 public:
  /// To be called first, and again whenever the wall has changed; all three have to outlive what follows. `whole`: the
  /// two layers of one model are alike and their ratio is not needed, so the wall is not divided.
  void begin(const Layers& layers, const Wall& wall, const Rule& rule, bool whole = false);
  /// The same with another rule.
  void take(const Rule& rule);
  [[nodiscard]] const Rule& rule() const { return *rule_; }
  /// What is asked of a batch beside p and p_y: derivatives by model parameters; those by axial stretch, closing factor
  /// and edges; the axial force.
  struct Wants {
    bool parameters = false, geometry = true, force = true;
  };
  /// Evaluates the batch. Not finite where the energy overflows or is undefined; the caller looks at the results.
  Status evaluate(std::span<const Section> sections, const Wants& wants, const Memory& memory = {},
                  const RestStress* rest = nullptr);
  /// Whether no kink of a material touches the wall in any section of this axial stretch with y in [from, to].
  [[nodiscard]] bool smooth(double lambda_z, double from, double to);
  /// Points of one section, where nothing cuts the layers.
  [[nodiscard]] std::size_t points_per_section() const { return base_.weight.size(); }

  [[nodiscard]] WallForces forces(std::size_t i) const;
  /// Estimates of the errors that quadrature leaves in the pressures, one a section.
  [[nodiscard]] std::span<const double> pressure_errors();
  /// By the geometric variables; those of the force only where `force` asks for them.
  [[nodiscard]] GeometricDerivatives by_geometry(bool force);
  /// What by_parameter() needs of a batch. Its force only where `force` asks for it.
  void prepare_parameters(bool force);
  /// Writes ∂p and ∂F at fixed shapes, one entry a section, by model parameter j or by the ratio of two layers of one
  /// model. Where F is null it is not wanted; beside a RestStress it is not to be had.
  void by_parameter(std::size_t j, double* p, double* F) const;
  void by_ratio(double* p, double* F) const;

  /// One point of section i: R², the squared circumferential stretch, T = σt − σr, Z = σz − σr, and its share of the
  /// integral that is the pressure.
  struct Across {
    double R2, c, T, Z, share;
  };
  /// Its points from inside.
  [[nodiscard]] std::vector<Across> across(std::size_t i) const;

 private:
  /// Where points lie: weight · length of the piece · factor of the layer, R² and 1/R².
  struct Points {
    std::vector<double> weight, R2, inverse;
    void resize(std::size_t n);
    void set(std::size_t k, double weight_at, double x);
  };
  /// Rows of numbers, one a section.
  enum Number : std::size_t {
    axial_stretch,
    inner2,
    a,
    b,
    cz,  // the shapes, up to here
    I,
    I_a,
    I_b,
    I_z,
    J,
    J_a,
    J_b,
    J_z,  // the integrals of p and F, with what they change by
    mean,
    last,
    last_but_one,
    error,  // the estimates of errors
    left,
    right,
    force_left,
    force_right,  // of one slot, by its edges
    p_by,
    F_by = p_by + variable_count,
    number_count = F_by + variable_count
  };
  [[nodiscard]] double* numbers(std::size_t of) { return numbers_.data() + of * count_; }
  [[nodiscard]] const double* numbers(std::size_t of) const { return numbers_.data() + of * count_; }
  [[nodiscard]] std::size_t slots() const { return slot_layer_.size(); }
  [[nodiscard]] std::size_t walls() const { return edges_.size() - 1; }

  [[nodiscard]] bool may_be_cut() const;
  void find_cuts(std::size_t i);
  void lay_points();
  void lay_cut_points();
  void set_shapes(std::span<const Section> sections);
  void set_stretches();
  Status respond(bool parameters, const Memory& memory);
  template <bool geometry, bool force>
  void integrate();
  void add_edges(std::size_t slot, bool force);
  /// Runs kernel(weight, R2, inverse) on the level of the machine; weight(m)[i] is that of point m of section i.
  template <class Kernel>
  void over_points(const Kernel& kernel) const;

  const Layers* layers_ = nullptr;
  const Wall* wall_ = nullptr;
  const Rule* rule_ = nullptr;
  const RestStress* rest_ = nullptr;

  std::vector<Jet> edges_;  ///< ln R where layers begin and end
  Points base_;             ///< of a section that nothing cuts
  double sector2_ = 1;      ///< R_i²
  bool can_be_cut_ = false;
  std::vector<std::array<double, 2>> inside_;  ///< by material: R² between which a kink cuts it
  std::vector<std::vector<double>> cuts_;      ///< by section and layer, ln R
  std::vector<double> kinks_;

  std::size_t count_ = 0, n_ = 0;  ///< sections; points of all
  std::vector<double> numbers_;
  /// A slot is as many points as the rule has, in one layer. Where sections are cut into different numbers of pieces,
  /// some have no length. Whether a slot begins and ends at the edges of its layer is 1 or 0, of every section.
  std::vector<std::size_t> slot_layer_;
  bool cut_ = false;
  Points points_;  ///< of every section, where some are cut; else all have those of `base_`
  std::vector<double> begins_, ends_;
  std::vector<Layers::Run> runs_;
  std::vector<double> c_, gradient_, hessian_, gradient_dp_;  ///< 3 squared stretches of each point; the responses
  std::vector<double> h_, h_c_, q_, q_c_;                     ///< T/c and 2Z − T, with their derivatives by c
  std::vector<double> terms_;                                 ///< of the integrals, of each point of one section
  std::vector<double> adjoint_;  ///< of each point: ∂p/∂g_t, ∂p/∂g_r and, without factors, ∂F/∂g_t, ∂F/∂g_z, ∂F/∂g_r
};

/// Numbers of points: one a point and section, or one a point where all sections have the same.
template <bool of_each>
struct AtPoint {
  const double* all;
  std::size_t count;
  struct OfSections {
    const double* of;
    double operator[](std::size_t i) const { return of[i]; }
  };
  struct OfAll {
    double value;
    double operator[](std::size_t) const { return value; }
  };
  /// Of point m, by section.
  auto operator()(std::size_t m) const {
    if constexpr (of_each)
      return OfSections{all + m * count};
    else
      return OfAll{all[m]};
  }
};

/// On a kernel of over_points(): it goes into the copy for the machine's instructions instead of being called there.
#define TUNICA_INLINE __attribute__((always_inline))

template <class Kernel>
void Sections::over_points(const Kernel& kernel) const {
  const auto run = [&]<bool of_each>(const Points& at) {
    using At = AtPoint<of_each>;
    const At weight{at.weight.data(), count_}, R2{at.R2.data(), count_}, inverse{at.inverse.data(), count_};
    detail::vectorised([&kernel, weight, R2, inverse] { kernel(weight, R2, inverse); });
  };
  if (cut_)
    run.template operator()<true>(points_);
  else
    run.template operator()<false>(base_);
}

}  // namespace tunica::thick_wall
