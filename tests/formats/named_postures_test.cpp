// Postures that files name: keys of MJCF and states of an SRDF.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/mjcf_reader.h"
#include "formats/srdf.h"
#include "formats/urdf_reader.h"
#include "scene/model.h"
#include "support/expect_error.h"

namespace rex::named_postures_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SceneFile mjcf(const std::string& keys, bool strict = false) {
  // MuJoCo goes depth first: base (7), shoulder (1), wrist (4), other (1). rex goes breadth first.
  return parseMjcf(
      "<mujoco><worldbody><body name='base'><freejoint name='base'/><geom size='.1'/>"
      "<body name='arm'><joint name='shoulder'/><geom size='.1'/>"
      "<body name='hand'><joint name='wrist' type='ball'/><geom size='.1'/></body></body>"
      "<body name='leg'><joint name='other' type='slide' ref='.5'/><geom size='.1'/></body>"
      "</body></worldbody><keyframe>" +
          keys + "</keyframe></mujoco>",
      "m.xml", {.strict = strict});
}

SceneFile urdf(const std::string& states) {
  const auto joint = [](const std::string& name, const std::string& child, const std::string& more = "") {
    return "<link name='" + child + "'/><joint name='" + name +
           "' type='revolute'><parent link='base'/><child link='" + child +
           "'/><limit lower='-9' upper='9' velocity='1' effort='1'/>" + more + "</joint>";
  };
  SceneFile robot = parseUrdf("<robot name='r'><link name='base'/>" + joint("a", "la") + joint("b", "lb") +
                                  joint("m", "lm", "<mimic joint='a' multiplier='2'/>") + "</robot>",
                              "r.urdf");
  parseSrdf("<robot name='r'>" + states + "</robot>", "r.srdf", robot);
  return robot;
}

std::vector<std::string> notesOf(const SceneFile& scene) {
  std::vector<std::string> notes;
  for (const Diagnostic& one : scene.notes) notes.push_back(toString(one));
  return notes;
}

std::vector<std::string> namesOf(const Model& model) {
  std::vector<std::string> names;
  for (const NamedPosture& one : model.postures()) names.push_back(one.name);
  return names;
}

TEST(NamedPostures, OfMujocoAreInItsOrderOfCoordinates) {
  const SceneFile file =
      mjcf("<key name='home' qpos='1 2 3 1 0 0 0  .1  0 0 2 0  .7' ctrl='1'/><key time='2'/>");
  const Model model = compile(file.spec);
  EXPECT_THAT(namesOf(model), ElementsAre("key:home", "key:1"));
  Eigen::VectorXd q(13);  // base, shoulder, other, wrist
  q << 1, 2, 3, 1, 0, 0, 0, .1, .7, 0, 0, 1, 0;
  EXPECT_EQ(model.posture("key:home"), q);
  EXPECT_EQ(model.posture("key:1"), model.initialPositions()) << "without qpos it is the posture of the file";
  EXPECT_EQ(model.initialPositions()[8], .5);
  EXPECT_REX_ERROR(
      model.posture("key:hom"),
      "scene 'm.xml' has no posture 'key:hom': wanted key:home, key:1 (did you mean 'key:home'?)");
}

TEST(NamedPostures, OfMujocoThatDoNotFitAreLeftOut) {
  const SceneFile file = mjcf("<key name='home' qpos='1 2'/>");
  EXPECT_THAT(file.spec.postures, IsEmpty());
  EXPECT_THAT(notesOf(file),
              ElementsAre(HasSubstr("key 'home': attribute 'qpos': found 2 numbers, wanted 13")));
  EXPECT_REX_ERROR(mjcf("<key name='home' qpos='1 2'/>", true), "found 2 numbers, wanted 13");
  EXPECT_REX_ERROR(mjcf("<key name='a'/><key name='a'/>"), "key 'a': a second key of this name");
  const std::string none = "<key name='a' qpos='1 2 3 0 0 0 0 .1 1 0 0 0 .7'/>";
  EXPECT_TRUE(mjcf(none).spec.postures.empty());
  EXPECT_EQ(mjcf(none).notes.size(), 1u);
  EXPECT_REX_ERROR(mjcf(none, true), "found a quaternion of length zero of joint 'base'");
  EXPECT_REX_ERROR(mjcf("<key name='a' qpos='1 x'/>"), "'x'");
}

TEST(NamedPostures, OfAnSrdfAreTheStatesOfAllGroupsWithTheirName) {
  const SceneFile file = urdf(
      "<group_state name='ready' group='arm'><joint name='a' value='0.5'/><joint name='m' value='1'/>"
      "</group_state><group_state name='ready' group='hand'><joint name='b' value='-1'/></group_state>"
      "<group_state name='open' group='hand'><joint name='b' value='2'/></group_state>");
  EXPECT_THAT(file.notes, IsEmpty());
  const Model model = compile(file.spec);
  EXPECT_THAT(namesOf(model), ElementsAre("state:ready", "state:open"));
  EXPECT_EQ(model.posture("state:ready"), Eigen::Vector2d(.5, -1));
  EXPECT_EQ(model.posture("state:open"), Eigen::Vector2d(0, 2));
}

TEST(NamedPostures, OfAnSrdfWarnOfWhatTheRobotLacks) {
  EXPECT_THAT(notesOf(urdf("<group_state name='s'><joint name='aa' value='1'/></group_state>")),
              ElementsAre(HasSubstr("the robot has no joint 'aa': ignored (did you mean 'a'?)")));
  EXPECT_THAT(notesOf(urdf("<group_state name='s'><joint name='a' value='1'/></group_state>"
                           "<group_state name='s'><joint name='a' value='2'/></group_state>")),
              ElementsAre(HasSubstr("joint 'a' has another value in 'state:s' already, which counts: 1")));
  EXPECT_REX_ERROR(urdf("<group_state name='s'><joint name='a' value='x'/></group_state>"), "'x'");
  EXPECT_REX_ERROR(urdf("<group_state><joint name='a' value='1'/></group_state>"),
                   "attribute 'name' is missing");
}

}  // namespace rex::named_postures_test
