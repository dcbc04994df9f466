// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "material.hpp"
#include "tunica/test.hpp"

namespace tunica::thick_wall {

/// The materials of the wall from inside: one throughout, or one a layer. Their parameters stand one after the other.
class Layers {
 public:
  explicit Layers(const TestInput& input);

  [[nodiscard]] std::size_t size() const { return materials_.size(); }  ///< materials
  [[nodiscard]] const Material& of(std::size_t layer) const { return materials_[materials_.size() == 1 ? 0 : layer]; }
  [[nodiscard]] std::size_t parameter_count() const { return first_.back(); }
  /// First of the parameters of material m; of the one behind the last, their number.
  [[nodiscard]] std::size_t first_parameter(std::size_t m) const { return first_[m]; }
  [[nodiscard]] std::size_t material_of(std::size_t parameter) const;
  /// Numbers that the wall remembers with so many points in each material.
  [[nodiscard]] std::size_t history_size(std::size_t points) const;

  /// Points [first, first + count) of a batch lie in a layer.
  struct Run {
    std::size_t layer, first, count;
  };
  /// n points, in runs that cover them; as Material::evaluate. Of `gradient_dp`, entries of a parameter at points of
  /// other materials than its own stay as they are. The memory of a section is that of its layers one after the other.
  Status evaluate(std::size_t n, std::span<const Run> runs, std::span<const double> c, std::span<double> gradient,
                  std::span<double> hessian, std::span<double> gradient_dp, const Memory& memory) const;

 private:
  Status evaluate_layer(std::size_t layer, std::size_t n, std::span<const Run> runs, std::span<const double> c,
                        std::span<double> gradient, std::span<double> hessian, std::span<double> gradient_dp,
                        const Memory& memory) const;
  std::vector<Material> materials_;
  std::vector<std::size_t> first_;  ///< of the parameters of each, one more at the end
};

}  // namespace tunica::thick_wall
