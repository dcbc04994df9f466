// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "../fe_pressurisation/banded.hpp"
#include "body.hpp"

namespace tunica::plane {

/// L D Lᵀ of the stiffness of a body, which need not be definite.
///
/// The centre of an element is seen by that element alone, and is eliminated first: with its two unknowns c, and those
/// around o,
///
///     S = K_oo − K_oc K_cc⁻¹ K_co
///
/// What is left becomes a band, in the order of Cuthill and McKee (Proc. 24th Nat. Conf. ACM, 157, 1969). Where the
/// band is too wide, as in large meshes, Eigen's factor of the whole is cheaper.
class Factor {
 public:
  /// `pattern`: of all matrices to come, compressed, their lower triangle.
  Factor(const Body& body, const Eigen::SparseMatrix<double>& pattern);

  /// False where it is singular.
  bool factorise(const Eigen::SparseMatrix<double>& K);
  /// Column by column x = K⁻¹ x.
  void solve(Eigen::MatrixXd& x) const;
  [[nodiscard]] bool is_band() const { return banded_; }

 private:
  struct Centre {
    std::array<std::size_t, 2> unknowns;
    std::vector<std::uint32_t> around;     ///< unknowns
    std::vector<std::uint32_t> places;     ///< of the lower triangle of `around` in the band
    std::array<double, 3> inverse{};       ///< K_cc⁻¹: 00, 10, 11
    std::vector<double> coupling, scaled;  ///< K_oc and K_oc K_cc⁻¹, row by row
  };
  std::vector<std::size_t> order(const Body& body, const std::vector<bool>& centre);
  void locate(const Eigen::SparseMatrix<double>& pattern, const std::vector<std::size_t>& centre_of);
  std::uint32_t place(std::size_t i, std::size_t j);

  bool banded_ = false;
  std::vector<std::size_t> position_;  ///< in the band, by unknown; none of a centre
  std::vector<Centre> centres_;
  /// Of every entry of the pattern: its place in the band, or behind it in `inner_`, five and more a centre.
  std::vector<std::uint32_t> target_;
  std::vector<double> inner_;
  std::vector<std::size_t> first_inner_;  ///< of each centre: K_cc 00, 10, 11, then K_oc
  std::size_t band_size_ = 0;
  fe::Banded band_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> sparse_;
};

}  // namespace tunica::plane
