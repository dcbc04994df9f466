// SPDX-License-Identifier: Apache-2.0
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "data/strip.hpp"

/// Preload, gauge lengths and rates of data as testing machines write them.
namespace tunica::data {
namespace {

using testing::by_force;
using testing::Mapping;
using testing::read_strip;
using testing::strip_of;
using testing::strip_refusal;

TEST(RigData, TrimsTheToeAtAPreloadAndTakesTheGaugeLengthThere) {
  const char* const text = "Size [mm],Force [mN]\n10,0\n11,0\n12,20\n13,60\n14,100\n13,60\n12,20\n11,0\n";
  const Mapping columns = {{"length", "Size"}, {"force", "Force"}};
  DataRequest request = strip_of(1, 1, 10);
  request.preload = Preload{40, true};
  const Dataset trimmed = read_strip(text, columns, request);
  EXPECT_EQ(trimmed.channels[0].values, (std::vector<double>{60, 100, 60}));
  EXPECT_DOUBLE_EQ(trimmed.abscissae[0].second[0], 1.3);
  request.specimen.all.gauge_length.reset();
  request.specimen.gauge_at_preload = true;
  EXPECT_DOUBLE_EQ(read_strip(text, columns, request).abscissae[0].second[0], 13 / 12.5);
  request.preload = Preload{400, true};
  EXPECT_EQ(strip_refusal(text, columns, request),
            "strip.csv, line 1, column 2 ('Force'): the preload of 400 mN is not reached; the values lie between 0 and "
            "100. Correct \"preload\", or leave it out.");
}

TEST(RigData, ShiftsADisplacementToThePreload) {
  DataRequest request = strip_of(1, 1, 0);
  request.specimen.all.gauge_length.reset();
  request.specimen.gauge_at_preload = true;
  request.specimen.all.grip_distance = 9;
  request.preload = Preload{40, true};
  const Dataset strip = read_strip("Way [mm],Force [mN]\n0,0\n1,0\n2,80\n3,120\n", by_force, request);
  ASSERT_EQ(strip.count, 2u);
  EXPECT_DOUBLE_EQ(strip.abscissae[0].second[0], 11 / 10.5);  // 9 + 1.5 mm at 40 mN
}

/// A sheet pulled along both axes.
const std::vector<Observable> sheet = {
    {"stretch_circumferential", "1", Observable::Role::abscissa, false, "", Observable::Kind::stretch},
    {"stretch_axial", "1", Observable::Role::abscissa, false, "", Observable::Kind::stretch},
    {"stress_circumferential", "kPa", Observable::Role::channel, false, "", Observable::Kind::stress},
    {"stress_axial", "kPa", Observable::Role::channel, false, "", Observable::Kind::stress}};

TEST(RigData, TakesTheGaugeLengthOfEachDirectionAtThePreload) {
  const testing::Folder folder;
  DataRequest request = strip_of(1, 1, 0);
  request.files = {
      folder.write("sheet.csv", "x [mm],y [mm],Fx [mN],Fy [mN]\n10,20,0,0\n11,22,20,5\n12,24,60,9\n13,30,100,20\n")};
  request.columns = {
      {"length_circumferential", "x"}, {"length_axial", "y"}, {"force_circumferential", "Fx"}, {"force_axial", "Fy"}};
  request.specimen.all.gauge_length.reset();
  request.specimen.gauge_at_preload = true;
  request.preload = Preload{40, true};  // half-way between the second row and the third
  const auto stretches = [&] { return read_dataset(request, sheet).abscissae; };
  EXPECT_DOUBLE_EQ(stretches()[0].second[0], 12 / 11.5);
  EXPECT_DOUBLE_EQ(stretches()[1].second[0], 24 / 23.0);
  Sizes axial;
  axial.gauge_length = 20;
  request.specimen.directions = {{"axial", axial}};
  EXPECT_DOUBLE_EQ(stretches()[0].second[0], 12 / 11.5);
  EXPECT_DOUBLE_EQ(stretches()[1].second[0], 24 / 20.0);
}

TEST(RigData, ARowWithoutALoadDoesNotBearThePreload) {
  const testing::Folder folder;
  DataRequest request = strip_of(1, 1, 10);
  request.files = {folder.write("sheet.csv", "x [mm],Fx [mN],Fy [mN]\n10,0,0\n11,,30\n12,60,50\n13,100,70\n")};
  request.columns = {{"length_circumferential", "x"}, {"force_circumferential", "Fx"}, {"force_axial", "Fy"}};
  request.preload = Preload{40, true};
  const Dataset dataset = read_dataset(request, sheet);
  EXPECT_EQ(dataset.channels[0].values, (std::vector<double>{60, 100}));
}

// The same strip, measured as stretch, displacement, length and strain, is pulled at 0.02/s.
TEST(RigData, ARateIsThatOfTheStretchWhateverWasMeasured) {
  DataRequest request = strip_of(1, 1, 20);
  request.time_rate = 0.02;
  const auto time_of = [&](const char* name, double factor, double rest) {
    std::string text = "x,Force [mN]\n";
    for (const double stretch : {1.1, 1.3, 1.2}) text += fmt::format("{:.15g},5\n", rest + factor * (stretch - 1));
    return read_strip(text, {{name, "x"}, {"force", "Force"}}, request).time;
  };
  const std::vector<double> expected{5, 15, 20};
  for (const auto& [name, factor, rest] : {std::tuple("stretch", 1.0, 1.0), std::tuple("displacement", 20.0, 0.0),
                                           std::tuple("length", 20.0, 20.0), std::tuple("strain", 1.0, 0.0)}) {
    const auto time = time_of(name, factor, rest);
    ASSERT_EQ(time.size(), 3u) << name;
    for (std::size_t row = 0; row < 3; ++row) EXPECT_NEAR(time[row], expected[row], 1e-12) << name;
  }
}

}  // namespace
}  // namespace tunica::data
