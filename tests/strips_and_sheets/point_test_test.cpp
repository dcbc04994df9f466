// SPDX-License-Identifier: Apache-2.0
// A test of one material point with two abscissae and with memory, held to the test of sheets, which has its own code.
#include "tunica/tests/point_test.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/sheet.hpp"

namespace tunica::testing::point_test_test {
namespace {

using ::testing::HasSubstr;

/// A sheet with a free face: σ_k = λ_k² (S_kk − S_rr C_rr / λ_k²).
struct Sheet {
  static constexpr const char *type = "two_stretches", *doc = "A sheet.", *reference = "none",
                              *admitted = "stretches above 0";
  static constexpr std::size_t abscissa_count = 2;
  static std::vector<Option> options() { return {}; }
  static std::vector<Observable> observables() {
    using Role = Observable::Role;
    return {{"stretch_t", "1", Role::abscissa, true, "Circumferential."},
            {"stretch_z", "1", Role::abscissa, true, "Axial."},
            {"time", "s", Role::time, false, "Since rest."},
            {"stress_t", "kPa", Role::channel, false, "Circumferential."},
            {"stress_z", "kPa", Role::channel, false, "Axial."}};
  }
  explicit Sheet(const TestSetup&) {}
  template <class T>
  std::array<T, 6> deformation(const std::array<T, 2>& x) const {
    const T t = x[0] * x[0], z = x[1] * x[1];
    return {t, z, 1.0 / (t * z), T(0.0), T(0.0), T(0.0)};
  }
  template <class T>
  T channel(std::size_t k, const std::array<T, 2>& x, const std::array<T, 6>& S) const {
    const std::array<T, 6> C = deformation(x);
    return C[k] * S[k] - C[2] * S[2];
  }
  [[nodiscard]] bool admits(const std::array<double, 2>& x) const { return x[0] > 0 && x[1] > 0; }
};

const std::vector<double> along_t{1, 1.1, 1.25, 1.4, 1.3, 1.3, 1.1}, along_z{1, 1.02, 1.2, 1.1, 1.25, 1.25, 1.05},
    clock{0, 0.5, 1, 4, 5, 30, 31};

PointTest<Sheet> make_points(const std::vector<double>& time = {}) {
  TestSetup setup;
  setup.rows.count = along_t.size();
  setup.rows.abscissae = {{"stretch_z", along_z}, {"stretch_t", along_t}};
  setup.rows.channels = {"stress_z", "stress_t"};
  setup.rows.time = time;
  return PointTest<Sheet>(setup);
}

std::unique_ptr<Test> make_biaxial(const std::vector<double>& time = {}) {
  SheetSetup sheet;
  sheet.channels = {"stress_axial", "stress_circumferential"};
  sheet.time = time;
  return make_sheet("general", {{"stretch_circumferential", along_t}, {"stretch_axial", along_z}}, sheet);
}

void expect_close(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-11 * (1 + std::abs(expected[i]))) << i;
}

const std::vector<double> gho{20, 30, 0.9, 45, 0.1};

TEST(PointTest, TakesTwoAbscissae) {
  const auto model = make_model("gho");
  ASSERT_EQ(model->describe().parameters.size(), gho.size());
  expect_close(stresses(make_points(), *model, gho), stresses(*make_biaxial(), *model, gho));
}

TEST(PointTest, DerivativesFollowBothAbscissaeAndTheParameters) {
  const auto model = make_model("gho");
  const auto points = make_points();
  const auto sheet = make_biaxial();
  const std::size_t n = along_t.size();
  std::vector<double> jacobian(gho.size() * 2 * n), of_sheet(jacobian.size()), by_x(4 * n), sheet_by_x(4 * n);
  ASSERT_TRUE(points.predict({*model, gho, {}}, {{}, jacobian, by_x, {}}).ok());
  const std::vector<double> own(sheet->describe().parameters.size(), 0.0);
  ASSERT_TRUE(sheet->predict({*model, gho, own}, {{}, of_sheet, sheet_by_x, {}}).ok());
  expect_close(jacobian, of_sheet);
  expect_close(by_x, sheet_by_x);
}

TEST(PointTest, ModelsWithMemoryFollowTheRows) {
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {});
  const std::vector<double> p{40, 0.8, 3};  // mu, g, tau
  expect_close(stresses(make_points(clock), *viscous, p), stresses(*make_biaxial(clock), *viscous, p));
}

TEST(PointTest, WithMemoryItAnswersNoDerivativesThatItDoesNotHave) {
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {});
  const std::vector<double> p{40, 0.8, 3};
  std::vector<double> jacobian(3 * 2 * along_t.size()), by_x(4 * along_t.size());
  EXPECT_THAT(make_points(clock).predict({*viscous, p, {}}, {{}, jacobian, {}, {}}).reason(),
              HasSubstr("difference the whole prediction"));
  EXPECT_THAT(make_points(clock).predict({*viscous, p, {}}, {{}, {}, by_x, {}}).reason(), HasSubstr("along the path"));
}

TEST(PointTest, RefusesAMissingAbscissaAndTimeThatRunsBack) {
  TestSetup setup;
  setup.rows.count = along_t.size();
  setup.rows.abscissae = {{"stretch_t", along_t}};
  setup.rows.channels = {"stress_t"};
  EXPECT_THROW(PointTest<Sheet>{setup}, InputError);
  EXPECT_THROW(make_points({0, 1, 2, 3, 4, 3, 6}), InputError);
}

}  // namespace
}  // namespace tunica::testing::point_test_test
