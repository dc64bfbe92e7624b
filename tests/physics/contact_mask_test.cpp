// What masks of shapes, ellipsoids and height fields do in the simulated world.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "formats/mjcf_reader.h"
#include "physics/small_scenes.h"

namespace rex::contact_masks_test {

SceneSpec world(const std::string& inside, const std::string& before = "", const std::string& after = "") {
  return parseMjcf("<mujoco>" + before + "<worldbody>" + inside + "</worldbody>" + after + "</mujoco>",
                   "m.xml")
      .spec;
}

std::string ball(const std::string& name, double x, const std::string& bits) {
  return fmt::format("<body name='{}' pos='{} 0 .5'><freejoint/><geom size='.1' {}/></body>", name, x, bits);
}

// A floor that is no neighbour of what slides on the world, as a shape of the world would be.
constexpr const char* kFloor = "<body><geom type='plane' size='0 0 1'/></body>";

// q after some time on a floor at z = 0 that is added to the scene.
Eigen::VectorXd settled(SceneSpec spec, double seconds = 1, bool addsFloor = true) {
  if (addsFloor) addGround(spec);
  PhysicsWorld physics(compile(spec));
  for (int i = 0; i < static_cast<int>(1000 * seconds); ++i) physics.step(1e-3);
  return physics.state().q;
}

constexpr const char* kOneWay = "contype='1' conaffinity='0'";

// Two of them fell through, as they may not touch each other.
TEST(ContactMasksInPhysics, RestOnAFloorThatIsAdded) {
  EXPECT_NEAR(settled(world(ball("a", 0, kOneWay)))[2], 0.1, 1e-4);
  const Eigen::VectorXd q = settled(world(ball("a", 0, kOneWay) + ball("b", 1, kOneWay)));
  EXPECT_NEAR(q[2], 0.1, 1e-4);
  EXPECT_NEAR(q[9], 0.1, 1e-4);
  EXPECT_NEAR(settled(world(ball("a", 0, "contype='2' conaffinity='2'")))[2], 0.5 - 9.81 / 2, 0.01)
      << "by MuJoCo's rule it falls through";
}

// They share the floor, but pass through each other.
TEST(ContactMasksInPhysics, ShareAFloorAndNothingElse) {
  const auto pair = [](const char* bits) {
    return world(ball("a", 0, bits) +
                 fmt::format("<body name='b' pos='0 0 1'><freejoint/><geom size='.1' {}/>"
                             "</body>",
                             bits));
  };
  EXPECT_NEAR(settled(pair(kOneWay))[9], 0.1, 1e-4);
  EXPECT_GT(settled(pair(""))[9], 0.19) << "one lies on the other, or has not rolled far yet";
}

// Of a body with two geoms, each touches its own: the lower one goes through the floor.
TEST(ContactMasksInPhysics, ApplyToEachShapeOfABody) {
  const std::string body =
      "<body name='a' pos='0 0 .5'><freejoint/><geom type='box' size='.3 .3 .05'/>"
      "<geom type='box' size='.1 .1 .05' pos='0 0 -.1' contype='{0}' conaffinity='{0}'/></body>";
  EXPECT_NEAR(settled(world(fmt::format(fmt::runtime(body), 2)))[2], 0.05, 2e-4);
  EXPECT_NEAR(settled(world(fmt::format(fmt::runtime(body), 1)))[2], 0.15, 2e-4);
  // On a tower of two shapes, one for each of its own: compounds against compounds.
  const std::string tower =
      "<geom type='box' size='1 1 .1'/><geom type='box' size='1 1 .1' pos='0 0 .1' contype='2' "
      "conaffinity='2'/>";
  EXPECT_NEAR(settled(world(tower + fmt::format(fmt::runtime(body), 2)), 1, false)[2], 0.35, 2e-4)
      << "the lower geom on the upper shape, at 0.2";
  EXPECT_NEAR(settled(world(tower + fmt::format(fmt::runtime(body), 1)), 1, false)[2], 0.25, 2e-4);
}

// Only its <pair> holds it, as with robots that list all their contacts.
TEST(ContactMasksInPhysics, HoldByAPairOnly) {
  const std::string none = "contype='0' conaffinity='0'";
  const std::string bodies = "<geom name='ground' type='plane' size='5 5 1' " + none +
                             "/><body name='a' pos='0 0 .5'><freejoint/><geom name='foot' size='.1' " + none +
                             "/></body>";
  EXPECT_NEAR(
      settled(world(bodies, "", "<contact><pair geom1='foot' geom2='ground'/></contact>"), 1, false)[2], 0.1,
      1e-4);
  EXPECT_LT(settled(world(bodies), 1, false)[2], -4);
}

// On each of its axes, and where nothing else is in contact.
TEST(Ellipsoids, LieOnTheirAxes) {
  const std::pair<const char*, double> cases[] = {
      {"", 0.1}, {"euler='90 0 0'", 0.2}, {"euler='0 90 0'", 0.3}};
  for (const auto& [turn, height] : cases) {
    // So that it stays on an end that is not stable.
    const SceneSpec spec = world(fmt::format(
        "{}<body pos='0 0 .5'><joint type='slide' axis='0 0 1'/><geom type='ellipsoid' size='.3 .2 .1' "
        "{}/></body>",
        kFloor, turn));
    EXPECT_NEAR(0.5 + settled(spec, 1, false)[0], height, 1e-4) << turn;
  }
}

// Tilted, its lowest point is at sqrt(n^T A^2 n) below the centre.
TEST(Ellipsoids, LieTilted) {
  const double angle = 0.7;
  const SceneSpec spec =
      world(fmt::format("{}<body pos='0 0 .5'><joint type='slide' axis='0 0 1'/><geom type='ellipsoid' "
                        "size='.3 .2 .1' axisangle='0 1 0 {}'/></body>",
                        kFloor, angle),
            "<compiler angle='radian'/>");
  const double height = std::hypot(0.3 * std::sin(angle), 0.1 * std::cos(angle));
  EXPECT_NEAR(0.5 + settled(spec, 1, false)[0], height, 1e-3) << "to the margin of Bullet";
}

constexpr const char* kRamp =
    "<asset><hfield name='h' nrow='2' ncol='3' size='1 1 .5 .1' elevation='0 1 1 0 1 1'/></asset>";

// A ramp up to the middle, and a terrace.
TEST(HeightFields, CarryWhatFallsOnThem) {
  const auto dropped = [](double x) {
    return 1 + settled(world(fmt::format("<body><geom type='hfield' hfield='h'/></body><body pos='{} 0 1'>"
                                         "<joint type='slide' axis='0 0 1'/><geom size='.1'/></body>",
                                         x),
                             kRamp),
                       1, false)[0];
  };
  EXPECT_NEAR(dropped(0.5), 0.6, 1e-4) << "on the terrace";
  const double slope = std::atan(0.5);
  EXPECT_NEAR(dropped(-0.5), 0.25 + 0.1 / std::cos(slope), 1e-3) << "on the ramp, and not on a hull over it";
}

}  // namespace rex::contact_masks_test
