// SPDX-License-Identifier: Apache-2.0
#include "compressible.hpp"

#include <cmath>
#include <numbers>

#include "tunica/detail/compressible_prediction.hpp"

namespace tunica::uniaxial {
namespace {

using free_faces::TensorOf;

class Specimen {
 public:
  Specimen(const Strip& strip, bool radial) : strip_(strip), radial_(radial) {}

  [[nodiscard]] std::size_t count() const { return strip_.stretch.size(); }
  [[nodiscard]] std::size_t channels() const { return strip_.channels.size(); }
  [[nodiscard]] static std::size_t faces() { return 2; }

  template <class T>
  TensorOf<T> prescribed(std::span<const T> x, std::span<const T> q) const {
    TensorOf<T> C = along(0, q);
    for (T& entry : C) entry *= x[0] * x[0];
    return C;
  }
  template <class T>
  TensorOf<T> face(std::size_t k, std::span<const T> q) const {
    return along(k + 1, q);
  }
  template <class T>
  T channel(std::size_t k, std::span<const T> x, std::span<const T> q, const TensorOf<T>& C,
            const TensorOf<T>& S) const {
    using std::sqrt;
    switch (strip_.channels[k]) {
      case Channel::transverse_stretch:
        return sqrt(free_faces::contract(along(1, q), C));
      case Channel::normal_stretch:
        return sqrt(free_faces::contract(along(2, q), C));
      case Channel::volume_ratio:
        return sqrt(free_faces::determinant(C));
      case Channel::stress:
        break;
    }
    const T S11 = free_faces::contract(along(0, q), S);
    switch (strip_.measure) {
      case Measure::first_piola_kirchhoff:
        return x[0] * S11;
      case Measure::second_piola_kirchhoff:
        return S11;
      case Measure::cauchy:
        break;
    }
    return x[0] * x[0] * S11 / sqrt(free_faces::determinant(C));
  }
  [[nodiscard]] double diagnostic(std::size_t d, std::span<const double> q, const free_faces::Tensor& C,
                                  const free_faces::Tensor&) const {
    return d < 2 ? std::sqrt(free_faces::contract(along(d + 1, q), C)) : std::sqrt(free_faces::determinant(C));
  }
  [[nodiscard]] std::string row_name(std::size_t row, std::span<const double> x) const {
    return "uniaxial: row " + std::to_string(row + 1) + " (stretch " + std::to_string(x[0]) + ")";
  }

 private:
  /// e_k⊗e_k: along the strip, across it in the plane, and along its normal.
  template <class T>
  TensorOf<T> along(std::size_t k, std::span<const T> q) const {
    using std::cos, std::sin;
    const T zero(0), one(1);
    std::array<std::array<T, 3>, 3> e{{{zero, zero, one}, {one, zero, zero}, {zero, one, zero}}};
    if (!radial_) {
      const T turn = (strip_.turn + q[0]) * (std::numbers::pi / 180), c = cos(turn), s = sin(turn);
      if (strip_.loaded == 0)
        e = {{{c, s, zero}, {-s, c, zero}, {zero, zero, one}}};
      else
        e = {{{s, c, zero}, {c, -s, zero}, {zero, zero, one}}};
    }
    return free_faces::dyad(e[k], e[k]);
  }

  const Strip& strip_;
  bool radial_;
};

}  // namespace

Status predict_compressible(const Strip& strip, bool radial, const TestInput& input, const TestOutput& output) {
  const std::span<const double> bound(strip.stretch);
  const std::span<const std::span<const double>> columns =
      input.abscissae.empty() ? std::span<const std::span<const double>>(&bound, 1) : input.abscissae;
  return free_faces::predict(Specimen(strip, radial), columns, input, output);
}

}  // namespace tunica::uniaxial
