// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <ceres/jet.h>

#include "tunica/detail/compressible_prediction.hpp"
#include "tunica/detail/point_rows.hpp"
#include "tunica/plugin.hpp"

namespace tunica {

/// A test of one material point whose deformation follows from the abscissae of its row: no equation has to be solved.
///
/// A Geometry is a type with the two formulas, written for any scalar type T:
///
///     static constexpr const char *type, *doc, *reference;               // as in TestFactory
///     static std::vector<Option> options();
///     static std::vector<Observable> observables();                      // channels in the order of k
///     explicit Geometry(const TestSetup& setup);                         // throws InputError
///     template <class T> std::array<T, 6> deformation(const T& x) const; // C at abscissa x, as MaterialPoints::C
///     template <class T> T channel(std::size_t k, const T& x, const std::array<T, 6>& S) const;
///     bool admits(double x) const;                                       // whether the test can reach x
///     static constexpr const char* admitted;                             // "a height above 0"
///
/// and, if the test has diagnostics,
///
///     static constexpr std::array diagnostics{Quantity{"pole_stretch", "1"}};
///     double diagnostic(std::size_t d, double x) const;
///
/// With several abscissae, x is a std::array of them in the order of observables(), and the Geometry has
///
///     static constexpr std::size_t abscissa_count = 2;
///
/// Mathematics: channel k is y = channel(k, x, S), linear in S; a free surface makes it so, because it fixes the
/// pressure that S leaves open. Hence ∂y/∂p_j = channel(k, x, ∂S/∂p_j). The derivative by the abscissa follows by
/// automatic differentiation, with dS/dx = ½ (2 ∂S/∂C) : dC/dx.
///
/// Compressible models are refused, unless the deformation and the channels say what becomes of J, S then being the
/// whole stress: `static constexpr auto volume = TestDescription::Volume::free;` where the deformation prescribes all
/// of C, or
///
///     std::array<double, 3> free_face() const;  // unit vector d (t, z, r) of a face without traction, C d ∥ d
///
/// where the squared stretch along d follows from d·S d = 0. Where J = 1, it is the one that deformation() has.
///
/// Models with history follow the rows in their order, with time if observables() has a time and the data map it. The
/// host then differences predictions. Together with a change of volume they are refused. Threads and failure: as Test.
template <class Geometry>
class PointTest final : public Test {
 public:
  /// Copies the rows. Throws InputError if an abscissa has no column, if a row is not admitted, or if time runs back.
  explicit PointTest(const TestSetup& setup)
      : geometry_(setup), points_(Geometry::type, Geometry::observables(), setup.rows) {
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!geometry_.admits(Points::at_row(points_.columns(), i)))
        throw InputError(begin() + points_.named(i, points_.columns()) + "; expected " + Geometry::admitted);
    rows_ = points_.rows();
    if constexpr (requires { Geometry::volume; })
      description_.volume = Geometry::volume;
    else if (has_free_face)
      description_.volume = TestDescription::Volume::either;
    if constexpr (requires { Geometry::diagnostics; }) {
      for (const auto& [name, unit] : Geometry::diagnostics) {
        description_.diagnostics.push_back(name);
        description_.diagnostic_units.push_back(unit);
      }
    }
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const auto kept = [this](const TestInput& at, const TestOutput& out) {
      if (description_.volume != TestDescription::Volume::free) return predict_at_constant_volume(at, out);
      return Status::failed(begin() +
                            "the material keeps its volume at these parameters, and this load changes it; keep the "
                            "compressibility off 0");
    };
    return free_faces::by_volume(input, output, kept, [this](const TestInput& at, const TestOutput& out) {
      const Columns columns = at.abscissae.empty() ? points_.columns() : at.abscissae;
      set_diagnostics(columns, out.diagnostics);
      TestOutput others = out;
      others.diagnostics = {};
      return free_faces::predict(Specimen{*this}, columns, at, others);
    });
  }

 private:
  static constexpr bool has_free_face = requires(const Geometry& geometry) { geometry.free_face(); };
  static constexpr std::size_t count = [] {
    if constexpr (requires { Geometry::abscissa_count; }) return Geometry::abscissa_count;
    return std::size_t{1};
  }();
  using Points = detail::PointRows<count>;
  using Columns = typename Points::Columns;
  /// What the formulas get: one abscissa as it is, several as an array.
  template <class T>
  using At = typename Points::template At<T>;

  /// The geometry as free_faces::predict asks for it.
  struct Specimen {
    const PointTest& test;

    [[nodiscard]] std::size_t count() const { return test.rows_.count; }
    [[nodiscard]] std::size_t channels() const { return test.points_.channels().size(); }
    [[nodiscard]] static std::size_t faces() { return has_free_face ? 1 : 0; }
    template <class T>
    std::array<T, 6> face(std::size_t, std::span<const T>) const {
      std::array<T, 6> out{};
      if constexpr (has_free_face) {
        const std::array<double, 3> d = test.geometry_.free_face();
        const free_faces::Tensor dd = free_faces::dyad(d, d);
        for (std::size_t c = 0; c < 6; ++c) out[c] = T(dd[c]);
      }
      return out;
    }
    template <class T>
    std::array<T, 6> prescribed(std::span<const T> x, std::span<const T> q) const {
      std::array<T, 6> C = test.geometry_.template deformation<T>(Points::at_point(x));
      if constexpr (has_free_face) {
        const std::array<T, 6> dd = face(0, q);
        const T along = free_faces::contract(dd, C);
        for (std::size_t c = 0; c < 6; ++c) C[c] -= along * dd[c];
      }
      return C;
    }
    template <class T>
    T channel(std::size_t k, std::span<const T> x, std::span<const T>, const std::array<T, 6>&,
              const std::array<T, 6>& S) const {
      return test.geometry_.template channel<T>(test.points_.channels()[k], Points::at_point(x), S);
    }
    [[nodiscard]] double diagnostic(std::size_t, std::span<const double>, const std::array<double, 6>&,
                                    const std::array<double, 6>&) const {
      return std::numeric_limits<double>::quiet_NaN();  // never asked for: set_diagnostics()
    }
    [[nodiscard]] std::string row_name(std::size_t row, std::span<const double> x) const {
      return begin() + Points::named(row, x, test.points_.abscissae());
    }
  };

  Status predict_at_constant_volume(const TestInput& input, const TestOutput& output) const {
    const ModelDescription& model = input.model.describe();
    const bool remembers = model.history_size > 0;
    if (!output.jacobian.empty() && (remembers || !model.parameter_derivatives))
      return Status::failed(begin() + "no parameter derivatives with this model; difference the whole prediction");
    if (!output.abscissa_derivative.empty() && remembers)
      return Status::failed(begin() + "no derivative by the abscissa along the path");
    const Columns x = input.abscissae.empty() ? points_.columns() : input.abscissae;
    const std::size_t n = rows_.count, parameters = input.model_parameters.size(), size = points_.channels().size() * n;
    std::vector<double> C(6 * n), S(6 * n), A(output.abscissa_derivative.empty() ? 0 : 36 * n),
        S_dp(output.jacobian.empty() ? 0 : 6 * parameters * n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::array<double, 6> at = geometry_.template deformation<double>(Points::at_row(x, i));
      for (std::size_t c = 0; c < 6; ++c) C[c * n + i] = at[c];
    }
    set_diagnostics(x, output.diagnostics);
    if (Status status = remembers ? follow(input, C, S)
                                  : input.model.evaluate({n, C, input.model_parameters, {}, {}}, {{}, S, A, S_dp, {}});
        !status.ok())
      return status;

    for (std::size_t i = 0; i < n; ++i) {
      const At<double> at = Points::at_row(x, i);
      for (std::size_t k = 0; k < points_.channels().size(); ++k) {
        const double y = geometry_.template channel<double>(points_.channels()[k], at, tensor(S, i));
        if (!std::isfinite(y))
          return Status::failed(begin() + points_.named(i, x) +
                                ", where the energy overflows; narrow the bounds of the model's parameters");
        if (!output.values.empty()) output.values[k * n + i] = y;
        for (std::size_t j = 0; !output.jacobian.empty() && j < parameters; ++j) {
          const std::span<const double> by_p = std::span<const double>(S_dp).subspan(6 * j * n, 6 * n);
          output.jacobian[j * size + k * n + i] =
              geometry_.template channel<double>(points_.channels()[k], at, tensor(by_p, i));
        }
        for (std::size_t a = 0; !A.empty() && a < count; ++a)
          output.abscissa_derivative[(a * points_.channels().size() + k) * n + i] =
              by_abscissa(points_.channels()[k], x, a, S, A, i);
      }
    }
    return {};
  }

  /// S of a model with memory, row by row from rest.
  Status follow(const TestInput& input, std::span<const double> C, std::span<double> S) const {
    const std::size_t n = rows_.count, m = input.model.describe().history_size;
    std::vector<double> before, after(m);
    std::array<double, 6> of_row;
    for (std::size_t i = 0; i < n; ++i) {
      const double step = points_.step(i);
      const std::array<double, 6> at = tensor(C, i);
      if (Status status =
              input.model.evaluate({1, at, input.model_parameters, {&step, rows_.time.empty() ? 0u : 1u}, before},
                                   {{}, of_row, {}, {}, after});
          !status.ok())
        return status;
      for (std::size_t c = 0; c < 6; ++c) S[c * n + i] = of_row[c];
      before = after;
    }
    return {};
  }

  using Jet = ceres::Jet<double, 1>;

  static std::string begin() { return std::string(Geometry::type) + ": "; }
  std::array<double, 6> tensor(std::span<const double> batch, std::size_t i) const {
    std::array<double, 6> t;
    for (std::size_t c = 0; c < 6; ++c) t[c] = batch[c * rows_.count + i];
    return t;
  }
  void set_diagnostics(Columns x, std::span<double> diagnostics) const {
    if constexpr (requires { Geometry::diagnostics; })
      for (std::size_t at = 0; at < diagnostics.size(); ++at)
        diagnostics[at] = geometry_.diagnostic(at / rows_.count, Points::at_row(x, at % rows_.count));
  }

  /// dy/dx with dS_a/dx = ½ Σ_b A_ab dC_b/dx; off-diagonal entries of C count twice.
  double by_abscissa(std::size_t channel, Columns columns, std::size_t moved, std::span<const double> S,
                     std::span<const double> A, std::size_t i) const {
    std::array<Jet, count> x;
    for (std::size_t a = 0; a < count; ++a) x[a] = Jet(columns[a][i]);
    x[moved].v[0] = 1;
    const At<Jet> moving = Points::template at_point<Jet>(x);
    const std::array<Jet, 6> C = geometry_.template deformation<Jet>(moving);
    std::array<Jet, 6> stress;
    for (std::size_t a = 0; a < 6; ++a) {
      stress[a] = Jet(S[a * rows_.count + i]);
      for (std::size_t b = 0; b < 6; ++b)
        stress[a].v[0] += (b < 3 ? 0.5 : 1.0) * A[(6 * a + b) * rows_.count + i] * C[b].v[0];
    }
    return geometry_.template channel<Jet>(channel, moving, stress).v[0];
  }

  Geometry geometry_;
  Points points_;
  TestRows rows_;
  TestDescription description_;
};

/// Name and unit of a diagnostic.
struct Quantity {
  const char *name,  ///< for example "pole_stretch"
      *unit;         ///< base unit
};

/// What a plugin registers: registry.add(tunica::point_test_factory<Bulge>());
template <class Geometry>
TestFactory point_test_factory() {
  return {Geometry::type,          Geometry::doc,
          Geometry::reference,     Geometry::options(),
          Geometry::observables(), [](const TestSetup& setup) { return std::make_unique<PointTest<Geometry>>(setup); }};
}

}  // namespace tunica
