// SPDX-License-Identifier: Apache-2.0
#include "experiment/block.hpp"

#include <gtest/gtest.h>

#include "experiment/reading.hpp"

namespace tunica {
namespace {

using namespace experiment;

struct Camera {
  std::optional<std::uint64_t> frames;
  double exposure = 0.5;
  bool colour = false;
};

/// The block of a camera, with its keys declared here alone.
Block<Camera> camera_block() {
  const auto any = [](const Node&, double) {};
  return Block<Camera>("the camera", "What saw it.",
                       {required(count_key("frames", "Pictures.", &Camera::frames, "a whole number of frames", 1, 9)),
                        quantity_key("exposure", "Time [s].", &Camera::exposure, "s", "an exposure", any),
                        silent_at(flag_key("colour", "Whether it saw colours.", &Camera::colour), false)})
      .expecting("a camera, {\"frames\": …},");
}

Camera read_camera(const std::string& text) {
  const JsonDocument document("camera.json", text);
  Camera camera;
  camera_block().read(Node(document), camera);
  return camera;
}

std::string refused(const std::string& text) {
  return testing::message_of<InputError>([&] { static_cast<void>(read_camera(text)); });
}

TEST(Block, ReadsWhatItsKeysDeclare) {
  const Camera camera = read_camera(R"({"exposure": "2 ms", "frames": 3, "colour": true})");
  EXPECT_EQ(camera.frames, 3u);
  EXPECT_DOUBLE_EQ(camera.exposure, 0.002);
  EXPECT_TRUE(camera.colour);
  EXPECT_EQ(read_camera(R"({"frames": 3})").exposure, 0.5) << "silence keeps the default";
}

TEST(Block, RefusesWhatItsKeysDoNot) {
  EXPECT_EQ(
      refused(R"({"frames": 3, "exposures": 1})"),
      "camera.json: unknown key 'exposures' in the camera (/exposures, line 1, column 15). Did you mean 'exposure'? "
      "Known: frames, exposure, colour.");
  EXPECT_EQ(refused("{}"), "camera.json: the key 'frames' is missing in the camera (line 1, column 1). Add it.");
  EXPECT_NE(refused("[]").find("a camera, {\"frames\": …}"), std::string::npos) << refused("[]");
  EXPECT_NE(refused(R"({"frames": 10})").find("from 1 to 9"), std::string::npos) << refused(R"({"frames": 10})");
}

TEST(Block, WritesWhatItReads) {
  EXPECT_EQ(camera_block().write(read_camera(R"({"exposure": "2 ms", "frames": 3})")).dump(),
            R"({"frames":3,"exposure":0.002})")
      << "a key is silent where it says no more than the default";
  const std::string all = R"({"frames":3,"exposure":0.002,"colour":true})";
  EXPECT_EQ(camera_block().write(read_camera(all)).dump(), all);
}

TEST(Block, HasASchemaOfAllItsKeys) {
  const Json schema = camera_block().schema();
  EXPECT_EQ(schema.at("required"), Json::array({"frames"}));
  EXPECT_EQ(schema.at("additionalProperties"), false);
  EXPECT_EQ(schema.at("properties").at("frames").at("maximum"), 9);
  EXPECT_EQ(schema.at("properties").at("colour").at("type"), "boolean");
  EXPECT_EQ(schema.at("properties").size(), 3u);
}

}  // namespace
}  // namespace tunica
