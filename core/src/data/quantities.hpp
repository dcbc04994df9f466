// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/rig_request.hpp"
#include "tunica/test.hpp"

/// What a testing machine measures, and the observables of a test that follow from it with the sizes of the specimen.
///
/// The name of the quantity is that of the observable with one word replaced: `displacement`, `length`, `strain`,
/// `true_strain` or `green_strain` gives a prescribed `stretch`, and `force` gives a `stress`. So `force_axial` gives
/// `stress_axial`, and `axial_length` gives `axial_stretch`. In simple shear `shear_displacement` over the height of
/// the block gives `shear`, and a force over the area of the plate a stress, which is the same in every measure because
/// that area stays.
namespace tunica::data {

struct Quantity {
  enum class Kind {
    own,
    displacement,
    length,
    strain,
    true_strain,
    green_strain,
    force,
    shear_displacement,
    plate_force
  };
  const Observable* observable;  ///< of the test: what it is, or what follows from it
  Kind kind = Kind::own;         ///< own: the column has the observable itself
  std::string unit;              ///< base unit of the column
};

/// The names that "columns" may have besides the observables.
struct RawName {
  std::string name;
  Quantity quantity;
};
std::vector<RawName> raw_names(const std::vector<Observable>& observables);

/// Whether the test shears a block between plates, so that its specimen has a height.
bool shears(const std::vector<Observable>& observables);

/// The meaning of a name in "columns"; none where it has none.
std::optional<Quantity> quantity_named(std::string_view name, const std::vector<Observable>& observables);

/// Sizes along the direction that the name of an observable ends or begins with, filled up with those of all.
Sizes sizes_along(const Specimen& specimen, std::string_view observable);

/// What stands beside "stretch" or "stress" in the name of an observable: "axial"; empty = nothing.
std::string direction_of(std::string_view observable);

/// Directions that sizes can be given for: what stands beside "stretch" in the names of observables.
std::vector<std::string> directions_of(const std::vector<Observable>& observables);

/// Whether the quantity is greater than zero in tension and less in compression.
bool is_signed(const Quantity& quantity);

/// The stretch that turns the nominal stress of this observable into another measure; none where the test has none.
const Observable* stretch_beside(const Observable& stress, const std::vector<Observable>& observables);

}  // namespace tunica::data
