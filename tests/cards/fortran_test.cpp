// SPDX-License-Identifier: Apache-2.0
// The user subroutine is compiled as Abaqus would, called with what its card says, and compared with the derivatives of
// the models.
#include <cmath>
#include <cstdlib>

#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cards/card.hpp"
#include "cards/given.hpp"
#include "cards/reading.hpp"
#include "conformance/material_point.hpp"
#include "execution/folder.hpp"

namespace tunica::testing {
namespace {

using Subroutine = void (*)(const double* invariants, double* energy, const double* zeta, const int* fibres,
                            const int* count, double* first, double* second, double* third, const double* temperature,
                            const int* element, const char* name, const int* incompressible, const int* hybrid,
                            const int* states, double* state, const int* fields, const double* field,
                            const double* field_step, const int* properties, const double* property,
                            std::size_t name_length);

/// The compiled source. What Abaqus brings is its include file and the routine that ends a job.
class Compiled {
 public:
  Compiled() {
    folder_.write("uanisohyper.f", cards::uanisohyper_inv());
    folder_.write("aba_param.inc", "      implicit real*8 (a-h,o-z)\n");
    folder_.write("xit.f", "      subroutine xit\n      stop 1\n      end\n");
    const std::string command = fmt::format(
        "cd '{}' && gfortran -shared -fPIC -O1 -Wall -Wno-unused-dummy-argument -Werror -ffixed-line-length-72 "
        "-o uanisohyper.so uanisohyper.f xit.f > log 2>&1",
        folder_.path().string());
    if (std::system(command.c_str()) != 0) throw std::runtime_error(trial::text_of(folder_.path() / "log"));
    void* library = dlopen((folder_.path() / "uanisohyper.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) throw std::runtime_error(dlerror());
    call = reinterpret_cast<Subroutine>(dlsym(library, "uanisohyper_inv_"));
    if (!call) throw std::runtime_error("no uanisohyper_inv_ in the library");
  }
  Subroutine call;

 private:
  trial::Folder folder_;
};

/// U and its derivatives by the invariants, as the subroutine gives them.
struct Derivatives {
  double energy;
  std::vector<double> first, second;
};

Derivatives by_fortran(const std::vector<double>& invariants, const std::vector<double>& properties, int fibres,
                       bool incompressible = true) {
  static const Compiled compiled;
  const int count = static_cast<int>(invariants.size()), packed = count * (count + 1) / 2, none = 0, one = 1;
  const int flag = incompressible, property_count = static_cast<int>(properties.size());
  std::vector<double> zeta(10), first(count, NAN), second(packed, NAN), third(packed, NAN);
  std::array<double, 2> energy{NAN, NAN};
  const double temperature = 0;
  const std::string name(80, ' ');
  double nothing = 0;
  compiled.call(invariants.data(), energy.data(), zeta.data(), &fibres, &count, first.data(), second.data(),
                third.data(), &temperature, &one, name.data(), &flag, &none, &none, &nothing, &none, &nothing, &nothing,
                &property_count, properties.data(), name.size());
  return {energy[0], first, second};
}

/// I1, I2, J, then I4 and I5 of every pair of directions, as Abaqus numbers them; and ∂I/∂C of those that are used.
struct Invariants {
  std::vector<double> values;
  std::vector<Eigen::Matrix3d> by_C;
};

Invariants invariants_of(const Eigen::Matrix3d& C, const std::vector<Eigen::Vector3d>& directions) {
  Invariants found;
  const auto add = [&](double value, const Eigen::Matrix3d& derivative) {
    found.values.push_back(value);
    found.by_C.push_back(derivative);
  };
  add(C.trace(), Eigen::Matrix3d::Identity());
  add((C.trace() * C.trace() - (C * C).trace()) / 2, Eigen::Matrix3d::Zero());
  add(std::sqrt(C.determinant()), Eigen::Matrix3d::Zero());
  for (std::size_t b = 0; b < directions.size(); ++b)
    for (std::size_t a = 0; a <= b; ++a) {
      add(directions[a].dot(C * directions[b]), directions[a] * directions[b].transpose());
      add(directions[a].dot(C * C * directions[b]), Eigen::Matrix3d::Zero());
    }
  return found;
}

constexpr std::array<std::pair<int, int>, 6> components{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

void compare(const std::string& type, const std::string& fibre_switch) {
  Options options;
  options.set("fibre_switch", fibre_switch);
  const auto model = make_model(type, options);
  conformance::Sampler sampler(23);  // deterministic
  int active = 0;
  for (int draw = 0; draw < 100; ++draw) {
    auto p = sampler.parameters(model->describe());
    Given given{type, {}, options};
    for (std::size_t k = 0; k < p.size(); ++k) {
      const auto& name = model->describe().parameters[k].name;
      if (name.starts_with("k2")) p[k] = draw % 10 == 0 ? 0 : std::min(p[k], 10.0);
      given.values[name] = p[k];
    }
    const auto card = cards::write_card(cards::Target::abaqus, material(given),
                                        {.units = cards::unit_system("mm-mN-kPa"), .subroutine = true});
    const auto properties = trial::data_of(card, "ANISOTROPIC HYPERELASTIC, USER");
    const auto directions = trial::directions_of(card);
    ASSERT_GE(directions.size(), 2U);

    const Eigen::Matrix3d C = conformance::to_matrix(sampler.right_cauchy_green());
    const auto expected = conformance::evaluate(*model, conformance::to_tensor(C), p);
    const auto at = invariants_of(C, directions);
    const auto found = by_fortran(at.values, properties, static_cast<int>(directions.size()));

    // S = 2 Σ U_i ∂I_i/∂C and 2 ∂S/∂C = 4 Σ U_ij ∂I_i/∂C ⊗ ∂I_j/∂C, the invariants being linear in C.
    Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < at.values.size(); ++i) S += 2 * found.first[i] * at.by_C[i];
    double largest_stress = 0, largest_tangent = 0;
    for (const double s : expected.stress) largest_stress = std::max(largest_stress, std::abs(s));
    for (const double t : expected.tangent) largest_tangent = std::max(largest_tangent, std::abs(t));
    EXPECT_NEAR(found.energy, expected.energy, 1e-10 * std::max(1.0, std::abs(expected.energy)));
    for (std::size_t a = 0; a < 6; ++a) {
      const auto [r, c] = components[a];
      EXPECT_NEAR((S(r, c) + S(c, r)) / 2, expected.stress[a], 1e-10 * largest_stress) << type << ' ' << a;
      for (std::size_t b = 0; b < 6; ++b) {
        const auto [k, l] = components[b];
        double tangent = 0;
        for (std::size_t i = 0; i < at.values.size(); ++i)
          for (std::size_t j = 0; j < at.values.size(); ++j) {
            const std::size_t low = std::min(i, j), high = std::max(i, j);
            tangent += 4 * found.second[low + high * (high + 1) / 2] * at.by_C[i](r, c) * at.by_C[j](k, l);
          }
        EXPECT_NEAR(tangent, expected.tangent[6 * a + b], 1e-10 * std::max(largest_tangent, largest_stress))
            << type << ' ' << a << ' ' << b;
      }
    }
    active += largest_tangent > 0;
  }
  EXPECT_GT(active, 50) << "most draws have fibres that carry load";
}

}  // namespace

class Fortran : public ::testing::TestWithParam<std::pair<const char*, const char*>> {
 protected:
  void SetUp() override {
    if (std::system("command -v gfortran > /dev/null") != 0) GTEST_SKIP() << "no gfortran here (Debian: gfortran)";
  }
};

TEST_P(Fortran, HasTheEnergyAndTheDerivativesOfTheModel) { compare(GetParam().first, GetParam().second); }

INSTANTIATE_TEST_SUITE_P(OfFibres, Fortran,
                         ::testing::Values(std::pair("gho", "strain"), std::pair("gho", "none"),
                                           std::pair("gho", "stretch"), std::pair("holzapfel_2015", "strain"),
                                           std::pair("holzapfel_2015", "none"), std::pair("hgo", "strain"),
                                           std::pair("four_fibre", "strain")));

TEST_F(Fortran, HasTheBulkModulusOfACompressibleCard) {
  // K = 2/D; U(J) = K/2 [(J² − 1)/2 − ln J], so U'' = K at J = 1.
  const double bulk = 5000;
  const std::vector<double> properties = {10, 2 / bulk, 0, 1, 1, 0, 1, 1, 1, 0, 1};
  const double J = 1.02, h = 1e-4;
  const auto at = [&](double volume) { return by_fortran({3, 3, volume, 1, 1, 0, 0, 1, 1}, properties, 2, false); };
  EXPECT_NEAR(at(1).second[5], bulk, 1e-9 * bulk);
  EXPECT_NEAR(at(J).first[2], (at(J + h).energy - at(J - h).energy) / (2 * h), 1e-5 * bulk);
  EXPECT_NEAR(at(J).second[5], (at(J + h).first[2] - at(J - h).first[2]) / (2 * h), 1e-5 * bulk);
}

}  // namespace tunica::testing
