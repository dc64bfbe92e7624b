// Where the ground of pictures is if the scene has one, or a floor was added.
#include <gtest/gtest.h>

#include "formats/mjcf_reader.h"
#include "live/live_simulation.h"
#include "render/picture.h"
#include "support/paths.h"

namespace rex::added_floor_test {

SceneSpec falling(const std::string& world = "") {
  return parseMjcf("<mujoco><worldbody>" + world +
                       "<body pos='0 0 1'><freejoint/><geom size='.1' contype='1' conaffinity='0'/></body>"
                       "</worldbody></mujoco>",
                   "m.xml")
      .spec;
}

double groundOf(const SceneSpec& spec) {
  const Model model = compile(spec);
  return scenePicture(model, forwardKinematics(model, model.initialPositions())).ground.height;
}

TEST(AddedFloor, IsTheGroundOfPictures) {
  SceneSpec spec = falling();
  EXPECT_EQ(groundOf(spec), 0);
  spec.worldShapes.push_back(floorAt(0.7));
  EXPECT_NEAR(groundOf(spec), 0.7, 1e-12);
  spec.worldShapes.push_back(floorAt(-2));
  EXPECT_NEAR(groundOf(spec), 0.7, 1e-12) << "the highest";
  SceneSpec deep = falling();
  deep.worldShapes.push_back(floorAt(5));
  EXPECT_NEAR(groundOf(deep), 5, 1e-12) << "also above the robot";
}

TEST(AddedFloor, IsThePlaneOfMujoco) {
  EXPECT_NEAR(groundOf(falling("<geom type='plane' size='0 0 1' pos='0 0 -.3'/>")), -0.3, 1e-12);
  EXPECT_NEAR(groundOf(falling("<geom type='plane' size='0 0 1' pos='0 0 .5' zaxis='1 0 0'/>")), -49.5, 1e-3)
      << "a wall is no ground";
}

// In the live page: what was recorded on a floor shows it.
TEST(AddedFloor, HoldsWhatFallsInTheLivePage) {
  const SceneSpec spec = falling();
  const Model model = compile(spec);
  LiveSimulation simulation(spec, {.floor = 0.2}, initialState(model));
  LiveRecording recording{.floor = 0.2};
  for (int i = 0; i < 10; ++i) {
    simulation.advance(100, {});
    recording.times.push_back(0.1 * i);
    recording.postures.push_back(simulation.state().q);
  }
  EXPECT_NEAR(simulation.state().q[2], 0.3, 1e-4);
  EXPECT_NE(toReplay(model, recording), toReplay(model, {recording.times, recording.postures, {}}));
}

}  // namespace rex::added_floor_test
