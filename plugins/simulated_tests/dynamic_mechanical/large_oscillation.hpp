// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/QR>

#include "small_oscillation.hpp"

namespace tunica::dynamic_mechanical {

/// The axes of a specimen in the material. A strip is pulled `along`, and `normal` is one of its free axes; a block is
/// sheared by γ `along`, on planes with this `normal`.
struct Specimen {
  std::size_t along = 0, normal = 1;
  bool shear = false;
  [[nodiscard]] std::size_t third() const { return 3 - along - normal; }
  [[nodiscard]] std::size_t sheared() const { return along + normal == 1 ? 3 : along + normal == 3 ? 4 : 5; }
};

/// σ = c1 S1 − c3 S3 and r = c2 S2 − c3 S3 of a strip, with their changes by l = ln λ1 and y = ln λ2², real or complex:
/// δc/δl = (2 c1, 0, −2 c3), δc/δy = (0, c2, −c3).
template <class T>
struct StripSlopes {
  double stress, r;
  T stress_l, stress_y, r_l, r_y;

  StripSlopes(const Specimen& strip, const Tensor& S, const Tensor& C, const std::array<T, 6>& by_l,
              const std::array<T, 6>& by_y) {
    const std::size_t third = strip.third();
    const double c1 = C[strip.along], c2 = C[strip.normal], c3 = C[third];
    const double S1 = S[strip.along], S2 = S[strip.normal], S3 = S[third];
    const T n_l = c3 * by_l[third], n_y = c3 * by_y[third];
    stress = c1 * S1 - c3 * S3;
    r = c2 * S2 - c3 * S3;
    stress_l = c1 * by_l[strip.along] + 2 * c1 * S1 - n_l + 2 * c3 * S3;
    stress_y = c1 * by_y[strip.along] - n_y + c3 * S3;
    r_l = c2 * by_l[strip.normal] - n_l + 2 * c3 * S3;
    r_y = c2 * by_y[strip.normal] + c2 * S2 - n_y + c3 * S3;
  }
};

/// Oscillations of finite amplitude, many at once, each where its cycles repeat:
///
///     λ = λ_0 + A sin ωt, or γ = A sin ωt;   M* = (2/AT) ∫ P (sin ωt + i cos ωt) dt over one cycle,
///
/// the first harmonic of the nominal stress, of the shear stress σ_ab = S_ab + γ S_bb (Hyun et al., Prog. Polym. Sci.
/// 36:1697, 2011, §2.2). As A → 0 it is the modulus of SmallOscillation, with an error of A².
///
/// Cycles go in `steps` and in twice as many steps of the model, and M* is extrapolated from both. Newton's method
/// finds the state that a cycle comes back to, also where branches forget over thousands of cycles.
///
/// Threads: one a call.
class LargeOscillation {
 public:
  static constexpr std::size_t steps = 64;
  struct Row {
    double period, centre, amplitude;              ///< s; λ_0, of shear 0; A
    double y;                                      ///< ln λ2² of the static strip
    Tensor C;                                      ///< of the static state
    std::vector<double> state;                     ///< of the model in it
    std::array<std::complex<double>, 2> excess{};  ///< of a small oscillation in `steps`, and in twice as many; kPa
  };
  /// Model and parameters outlive this.
  LargeOscillation(const Model& model, std::span<const double> parameters, const Specimen& specimen)
      : model_(model), parameters_(parameters), specimen_(specimen) {}

  /// M* of each row, kPa. False where the model fails, or has no equilibrium, or cycles do not settle.
  bool moduli(std::span<const Row> rows, std::span<std::complex<double>> found);
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// None where the model failed in a batch of rows.
  [[nodiscard]] std::optional<std::size_t> failed_row() const { return failed_row_; }

 private:
  bool forget(std::span<const Row> rows);
  bool settled(std::span<const Row> rows, std::size_t per_cycle, std::span<std::complex<double>> found);
  bool cycle(std::span<const Row> rows, std::size_t per_cycle, std::vector<double>& guess,
             std::span<std::complex<double>> found);
  bool step(std::span<const Row> rows, std::size_t per_cycle, double sine);
  void place(std::size_t n, std::size_t i, double strain);
  bool fail(std::optional<std::size_t> row, std::string why);

  const Model& model_;
  std::span<const double> parameters_;
  Specimen specimen_;
  std::string failure_;
  std::optional<std::size_t> failed_row_;
  std::vector<Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>> left_;  ///< 1 − P of each row
  std::vector<std::vector<bool>> grows_;  ///< of each row: whether a variable of the state takes what a cycle leaves
  std::vector<double> alike_;             ///< of each row: how far moduli of two settled cycles differ, relative
  // Structures of arrays over the rows.
  std::vector<double> C_, stress_, tangent_, time_, state_, after_, y_, nominal_;
};

}  // namespace tunica::dynamic_mechanical
