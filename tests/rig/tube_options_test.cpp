// SPDX-License-Identifier: Apache-2.0
// What import asks of tubes, and proposes for them.
#include <gmock/gmock.h>

#include "assembly/record.hpp"
#include "execution/folder.hpp"
#include "importing/options.hpp"
#include "support/loaded.hpp"

namespace tunica::importing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Asked {
  std::vector<std::string> options;
  Ask ask = [this](const Question& question) {
    options.push_back(question.option);
    return question.example;
  };
};

TEST(TubeOptions, AreAskedAsFarAsTheTypeDeclaresThem) {
  TestFactory other;
  other.type = "cuffed_tube";
  other.options = {Option::quantity("bore", "mm", 0, "Bore."), Option::quantity("thickness", "mm", 0, "Wall.")};
  Asked of_other;
  Json entry = Json::object();
  add_tube_options(entry, other, {}, false, of_other.ask);
  EXPECT_THAT(of_other.options, ElementsAre("--thickness"));
  EXPECT_EQ(entry, Json({{"thickness", "0.8 mm"}}));

  other.options = {Option::quantity("bore", "mm", 0, "Bore.")};
  Answers answers;
  answers.thickness = "1 mm";
  entry = Json::object();
  add_tube_options(entry, other, answers, false, of_other.ask);
  EXPECT_EQ(entry, Json::object());

  Asked of_own;
  entry = Json::object();
  add_tube_options(entry, testing::catalogue().tests().at("thick_wall_pressurisation").factory, {}, false, of_own.ask);
  EXPECT_THAT(of_own.options, ElementsAre("--set axial_stretch=NUMBER", "--thickness", "--set outer_radius=LENGTH"));
}

/// The type of the model that is proposed for a record of a twisted specimen.
std::string model_for(const Pairs& options) {
  const trial::Folder folder;
  folder.write("twist.csv", "twist [deg/mm],torque [mN.mm]\n0,0\n1,2\n2,4\n3,6\n4,8\n");
  Answers answers;
  answers.files = {folder.path() / "twist.csv"};
  answers.test = "torsion";
  answers.options = options;
  answers.columns = {{"twist", "twist [deg/mm]"}, {"torque", "torque [mN.mm]"}};
  answers.units = {{"twist [deg/mm]", "deg/mm"}, {"torque [mN.mm]", "mN.mm"}};
  Asked asked;
  const Json experiment = propose(answers, folder.path(), testing::catalogue(), asked.ask).experiment;
  EXPECT_THAT(asked.options, IsEmpty());
  return experiment.at("models").begin()->at("type").get<std::string>();
}

TEST(TubeOptions, SayWhetherATwistedSpecimenIsATubeThatMayHaveFibres) {
  EXPECT_EQ(model_for({{"outer_radius", "3 mm"}}), "ogden");
  EXPECT_EQ(model_for({{"outer_radius", "3 mm"}, {"thickness", "0.5 mm"}}), "hgo");
  EXPECT_EQ(model_for({{"inner_radius", "2 mm"}, {"outer_radius", "3 mm"}}), "hgo");
}

TEST(TubeOptions, SayNothingOfADiameterWithoutTheSizesThatMakeIt) {
  experiment::TestEntry entry;
  entry.options.set("inner_radius", 2.0);
  entry.options.set("axial_stretch", 1.0);
  data::Dataset dataset;
  dataset.count = 1;
  dataset.lines = {2};
  dataset.abscissae = {{"pressure", {0.0}}};
  data::Channel diameter;
  diameter.observable = "outer_diameter";
  diameter.values = {6.0};
  dataset.channels = {diameter};
  const auto findings = [&] {
    std::vector<data::Finding> found;
    assembly::look_at_unloaded_tube(entry, dataset, found);
    return found.size();
  };
  EXPECT_EQ(findings(), 0u) << "the wall may be 1 mm";
  entry.options.set("thickness", 0.5);
  EXPECT_EQ(findings(), 1u);
  entry.options.set("thickness", 1.0);
  EXPECT_EQ(findings(), 0u);
}

}  // namespace
}  // namespace tunica::importing
