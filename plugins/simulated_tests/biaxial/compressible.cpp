// SPDX-License-Identifier: Apache-2.0
#include "compressible.hpp"

#include <cmath>

#include "tunica/detail/compressible_prediction.hpp"

namespace tunica::biaxial {
namespace {

using free_faces::TensorOf;

class Specimen {
 public:
  Specimen(const Sheet& sheet, std::span<const std::span<const double>> columns) : sheet_(sheet), columns_(columns) {
    // z turns towards t, and t away from z.
    const double c = std::cos(sheet.angle), s = std::sin(sheet.angle);
    const std::array<std::array<double, 3>, 3> e{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
    for (std::size_t a = 0; a < 3; ++a) along_[a] = free_faces::dyad(e[a], e[a]);
    across_ = free_faces::dyad(e[0], e[1]);
  }

  [[nodiscard]] std::size_t count() const { return sheet_.count(); }
  [[nodiscard]] std::size_t channels() const { return sheet_.channels.size(); }
  [[nodiscard]] static std::size_t faces() { return 1; }

  template <class T>
  TensorOf<T> prescribed(std::span<const T> x, std::span<const T>) const {
    TensorOf<T> C{};
    for (std::size_t a = 0; a < 2; ++a) {
      const T stretch = stretch_of(a, x);
      for (std::size_t c = 0; c < 6; ++c) C[c] += stretch * stretch * along_[a][c];
    }
    return C;
  }
  template <class T>
  TensorOf<T> face(std::size_t, std::span<const T>) const {
    TensorOf<T> normal{};
    normal[2] = T(1);
    return normal;
  }
  template <class T>
  T channel(std::size_t k, std::span<const T> x, std::span<const T>, const TensorOf<T>& C, const TensorOf<T>& S) const {
    using std::sqrt;
    T sum(0);
    for (std::size_t a = 0; a < 2; ++a) {
      const double weight = sheet_.channels[k][a];
      if (weight == 0) continue;
      const T stretch = stretch_of(a, x), Saa = free_faces::contract(along_[a], S);
      sum += weight * (sheet_.power == 2   ? Saa
                       : sheet_.power == 1 ? stretch * Saa
                                           : stretch * stretch * Saa / sqrt(free_faces::determinant(C)));
    }
    return sum;
  }
  /// The stretch across the sheet, the shear stress of a turned one, σ = λt λz S/J, and the volume ratio.
  [[nodiscard]] double diagnostic(std::size_t d, std::span<const double>, const free_faces::Tensor& C,
                                  const free_faces::Tensor& S) const {
    if (d == 0) return std::sqrt(C[2]);
    const double in_plane = std::sqrt(free_faces::contract(along_[0], C) * free_faces::contract(along_[1], C));
    return in_plane * free_faces::contract(across_, S) / std::sqrt(free_faces::determinant(C));
  }
  [[nodiscard]] std::string row_name(std::size_t row, std::span<const double>) const {
    return "biaxial: " + sheet_.row_name(columns_, row);
  }

 private:
  template <class T>
  T stretch_of(std::size_t a, std::span<const T> x) const {
    T stretch(sheet_.held()[a]);
    for (std::size_t k = 0; k < x.size(); ++k) stretch += sheet_.direction(k)[a] * x[k];
    return stretch;
  }

  const Sheet& sheet_;
  std::span<const std::span<const double>> columns_;
  std::array<free_faces::Tensor, 3> along_;
  free_faces::Tensor across_;
};

}  // namespace

Status predict_compressible(const Sheet& sheet, std::span<const std::span<const double>> columns,
                            const TestInput& input, const TestOutput& output) {
  return free_faces::predict(Specimen(sheet, columns), columns, input, output);
}

}  // namespace tunica::biaxial
