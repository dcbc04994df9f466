// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "closing.hpp"
#include "tunica/model.hpp"

namespace tunica::fe {

/// What the points of a mesh remember between two rows of the data, in tensors: one block for each row of elements.
struct History {
  std::vector<std::vector<double>> before, after;  ///< states of the model, layer by layer; empty = at rest
  double time_step = 0;                            ///< s
  bool timed = false;                              ///< whether the rows have a clock
};

/// The models of the wall at fixed parameters in an axisymmetric state without torsion: C has the components tt, zz,
/// rr, zr. Gives first and second derivatives of W by C_tt, C_zz, C_rr and by s = C_zr, both off-diagonal entries
/// moving together.
///
/// Where every invariant is linear in C the energy does not see s: W is what the principal-axes path computes from the
/// diagonal alone, at a fifth of the price of full tensors.
///
/// A wall may have layers, each with a model and parameters of its own, and a closing: C is then that from the closed
/// unloaded tube, and W that of F F₀, where F₀ = diag(λ₀, 1, 1/λ₀) closed the stress-free sector.
class Material {
 public:
  static constexpr std::size_t firsts = 4;    ///< W_t, W_z, W_r, W_s
  static constexpr std::size_t seconds = 10;  ///< tt, zz, rr, tz, zr, tr, then ss, ts, zs, rs

  Material(const Model& model, std::span<const double> parameters);
  /// Layers from inside, each of so many `columns` of elements; parameters one layer after the other. `closing` may be
  /// null. All have to outlive the material.
  Material(std::span<const Model* const> models, std::span<const double> parameters,
           std::span<const std::size_t> columns, const Closing* closing);

  [[nodiscard]] std::size_t parameter_count() const { return parameters_.size(); }
  /// False: W_s and the second derivatives by s are zero and not written.
  [[nodiscard]] bool sees_shear() const { return sees_shear_; }
  /// Null where the wall has none, and its derivatives are not wanted.
  [[nodiscard]] const Closing* closing() const { return closing_; }

  /// n points; C: 4n, first: 4n, second: 10n, component-major; first_dp: n_p·4n, ∂first/∂p_j at [(4j + a)n + i]. An
  /// empty span means "not wanted". With layers or a closing the points are those of a row of elements, lanes last, or
  /// one a lane. `row` tells what they remember.
  Status evaluate(std::size_t n, std::span<const double> C, std::span<double> first, std::span<double> second,
                  std::span<double> first_dp, std::size_t row = 0) const;
  /// W at n points; C as above.
  Status energy(std::size_t n, std::span<const double> C, std::span<double> energy) const;

  /// From now on points respond to the history, which outlives this; null = at equilibrium.
  void follow(History* history) { history_ = history; }
  [[nodiscard]] bool remembers() const { return history_ != nullptr; }
  /// Advances the history of the points of a row of elements to the state C, in History::after.
  Status remember(std::size_t n, std::span<const double> C, std::size_t row) const;

  [[nodiscard]] std::size_t layer_count() const { return layers_.size(); }
  /// As evaluate(), with the model of a layer alone and no closing.
  Status evaluate_layer(std::size_t layer, std::size_t n, std::span<const double> C, std::span<double> first) const;

 private:
  struct Layer {
    const Model* model;
    std::size_t first_parameter;
    std::span<const double> parameters;
    bool diagonal;
    std::size_t first_lane, last_lane;
  };
  /// One of the calls above: its inputs and requested outputs.
  struct Call {
    std::size_t n;
    std::span<const double> C;
    std::span<double> energy, first, second, first_dp;
    std::span<const double> old_state;
    std::span<double> new_state;
  };
  Status respond(const Layer& layer, const Call& call) const;
  Status on_tensors(const Layer& layer, const Call& call) const;
  Status in_layers(const Call& call, std::size_t row) const;
  void open(std::size_t n, std::span<const double> C, std::span<double> opened) const;
  void close(const Call& call) const;
  [[nodiscard]] bool plain() const { return layers_.size() == 1 && (closing_ == nullptr || closing_->none()); }

  std::vector<Layer> layers_;
  std::span<const double> parameters_;
  std::size_t lanes_ = 0;
  const Closing* closing_ = nullptr;
  History* history_ = nullptr;
  bool sees_shear_ = false;
};

}  // namespace tunica::fe
