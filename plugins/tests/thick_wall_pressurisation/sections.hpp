// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "layers.hpp"
#include "rule.hpp"
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

/// The same with the derivatives by all geometric variables.
struct WallForcesJet {
  Jet p, F;
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
/// in ln R, because there a thick wall is as smooth as a thin one. One object a thread: its memory grows to the
/// largest batch seen, then nothing is allocated.
class Sections {
 public:
  /// To be called first, and again whenever the wall has changed; all three have to outlive what follows.
  void begin(const Layers& layers, const Wall& wall, const Rule& rule);
  /// Evaluates the batch. Not finite where the energy overflows or is undefined; the caller looks at the results.
  Status evaluate(std::span<const Section> sections, bool parameters, const Memory& memory = {},
                  const RestStress* rest = nullptr);
  /// Points of one section, where nothing cuts the layers.
  [[nodiscard]] std::size_t points_per_section() const { return base_weight_.size(); }

  [[nodiscard]] WallForces forces(std::size_t i) const;
  /// Estimate of the error that quadrature leaves in the pressure.
  [[nodiscard]] double pressure_error(std::size_t i) const;
  [[nodiscard]] WallForcesJet forces_jet(std::size_t i) const;
  /// ∂p and ∂F at a fixed shape, by model parameter j or by the ratio of two layers of one model.
  struct Change {
    double p = 0, F = 0;
  };
  [[nodiscard]] Change by_parameter(std::size_t i, std::size_t j) const;
  [[nodiscard]] Change by_ratio(std::size_t i) const;

  /// One point of section i: R², the squared circumferential stretch, T = σt − σr, Z = σz − σr, and its share of the
  /// integral that is the pressure.
  struct Across {
    double R2, c, T, Z, share;
  };
  /// Its points from inside.
  [[nodiscard]] std::vector<Across> across(std::size_t i) const;

 private:
  /// A run of Gauss points between two nodes in x; an edge that is no edge of a layer is a cut.
  struct Piece {
    std::size_t first;
    double length;
    std::size_t layer;
    bool begins, ends;  ///< at the edges of its layer
  };
  void clear_points();
  void lay_uncut(std::size_t count);
  void lay_points(const Shape<double>& at);
  void add_piece(double from, double to, std::size_t layer, bool begins, bool ends);
  /// Where kinks of its materials cut the wall under a section of this shape; false = nowhere.
  bool find_cuts(const Shape<double>& at);
  Status respond(bool parameters, const Memory& memory);
  void form(std::size_t first, std::size_t last, double at_rest);
  /// Points of section i in the material of a parameter.
  [[nodiscard]] std::pair<std::size_t, std::size_t> points_of(std::size_t i, std::size_t material) const;

  const Layers* layers_ = nullptr;
  const Wall* wall_ = nullptr;
  const Rule* rule_ = nullptr;

  std::vector<Jet> edges_;  ///< ln R where layers begin and end
  std::vector<double> base_weight_, base_s_, base_inverse_;
  std::size_t uncut_ = 0;  ///< leading sections whose points lie as nothing cuts the layers
  bool can_be_cut_ = false;
  std::vector<std::vector<double>> cuts_;  ///< by material, ln R
  /// By material: R² between which a kink cuts it.
  std::vector<std::array<double, 2>> inside_;
  std::vector<double> kinks_;

  std::vector<Section> sections_;
  std::vector<Shape<double>> shapes_;                   ///< of the sections
  std::vector<std::size_t> first_piece_, first_point_;  ///< of each section, one more at the end
  std::vector<Piece> pieces_;
  std::vector<Layers::Run> runs_;
  // Of each point: weight · length of the piece · factor of the layer, R², 1/R²; 3 squared stretches; the responses.
  std::vector<double> w_, s_, inverse_, c_, gradient_, hessian_, gradient_dp_;
  std::vector<double> h_, h_c_, h_z_, q_, q_c_, q_z_;  ///< T/c and 2Z − T, with their derivatives by c and c_z
  std::size_t n_ = 0;
  const RestStress* rest_ = nullptr;
};

}  // namespace tunica::thick_wall
