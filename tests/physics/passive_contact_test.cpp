// Contacts take energy and give none back, whatever hits and however deep it starts.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "dynamics/energy.h"
#include "formats/scene_file.h"
#include "geometry/rotation.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/paths.h"
#include "support/rounds.h"

namespace rex::passive_contact_test {

using Eigen::Vector3d;

// The least energy so far, and by how much it has risen since at most.
struct Account {
  double start = 0, least = 0, rise = 0;
  double lost() const { return start - least; }
};

Account accountOf(PhysicsWorld& world, const Model& model, double seconds) {
  const auto total = [&] {
    const State state = world.state();
    return energy(model, state.q, state.v).total();
  };
  Account account{.start = total(), .least = total()};
  for (int i = 0; i < static_cast<int>(std::lround(seconds / 1e-3)); ++i) {
    world.step(1e-3);
    const double now = total();
    account.least = std::min(account.least, now);
    account.rise = std::max(account.rise, now - account.least);
  }
  return account;
}

// An arm of six links with boxes, some of which stay in each other as they turn, above a floor.
Model boxedArm() {
  struct Part {
    double mass;
    Vector3d at, axis;
    double length;
    Vector3d along;
    double width;
  };
  const Vector3d y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const Part parts[] = {{3.7, {0, 0, 0.09}, z, 0.05, z, 0.12},      {8.4, {0, 0.136, 0}, y, 0.425, z, 0.11},
                        {2.3, {0, -0.12, 0.425}, y, 0.39, z, 0.09}, {1.2, {0, 0, 0.39}, y, 0.05, y, 0.08},
                        {1.2, {0, 0.093, 0}, z, 0.05, z, 0.08},     {0.2, {0, 0, 0.095}, y, 0.04, y, 0.08}};
  SceneSpec spec;
  addGround(spec);
  std::string parent = "world";
  for (const Part& part : parts) {
    const std::string name = fmt::format("link{}", spec.bodies.size());
    JointSpec& joint = addHinged(spec, name, part.mass, 0);
    joint.parent = parent;
    joint.axis = part.axis;
    joint.X_PF.p = part.at;
    BodySpec& body = spec.bodies.back();
    body.p_BBcm = part.length / 2 * part.along;
    const double across = part.mass * part.length * part.length / 12,
                 round = part.mass * part.width * part.width / 10;
    body.inertia =
        (across + round) * Eigen::Matrix3d::Identity() - across * part.along * part.along.transpose();
    ShapeSpec box;
    box.name = name;
    box.X_BS.p = body.p_BBcm;
    const Vector3d sides = Vector3d::Constant(part.width) + part.length * part.along;
    box.shape = boxShape(sides.x(), sides.y(), sides.z());
    box.contact = parent != "world";
    body.shapes.push_back(box);
    parent = name;
  }
  return compile(spec);
}

// While links kept the speed that separated them, such arms gained up to 2.8 kJ in 3 s.
TEST(PassiveContacts, OfAnArmThatFallsOnAFloor) {
  const Model model = boxedArm();
  Rng rng(5);
  double most = 0;
  for (int round = 0; round < rounds(12, 100); ++round) {
    PhysicsWorld world(model);
    State state = initialState(model);
    state.q = rng.uniformVector(6, -1.5, 1.5);
    state.q[1] *= 0.6;
    world.setState(state);
    const Account account = accountOf(world, model, 2);
    most = std::max(most, account.rise / account.lost());
    EXPECT_LT(account.rise, 0.01 * account.lost()) << "round " << round << ": " << account.rise << " J";
  }
  RecordProperty("most", fmt::format("{:.3g} % of what was lost", 100 * most));
}

// It rises by no more than being lifted takes, and has hardly any speed afterwards.
TEST(PassiveContacts, OfWhatStartsInTheFloor) {
  for (const double depth : {1e-3, 1e-2, 0.05}) {
    for (const bool hasPart : {false, true}) {
      SceneSpec spec;
      addLoose(spec, "thing", 2, boxShape(0.4, 0.4, 0.2), translation(0, 0, 0.1 - depth));
      addGround(spec);
      double mass = 2;
      if (hasPart) {
        addHinged(spec, "part", 1, 0.01).parent = "thing";
        mass = 3;
      }
      const Model model = compile(spec);
      PhysicsWorld world(model);
      double fastest = 0;
      const double before = energy(model, world.state().q, world.state().v).total();
      for (int i = 0; i < 1000; ++i) {
        world.step(1e-3);
        fastest = std::max(fastest, world.state().v.norm());
      }
      const State state = world.state();
      EXPECT_NEAR(state.q[2], 0.1, 2e-4);
      EXPECT_LT(fastest, 2e-3) << depth << " m deep";
      EXPECT_LT(energy(model, state.q, state.v).total() - before, mass * 9.81 * depth * 1.01);
    }
  }
}

// Dropped from all sides, at up to 3 m/s.
TEST(PassiveContacts, OfAHumanoidThatIsThrown) {
  const SceneFile file = readScene(sourcePath("data/robots/humanoid/humanoid.urdf"));
  SceneSpec spec = file.spec;
  addGround(spec, translation(0, 0, -2));
  const Model model = compile(spec);
  Rng rng(6);
  for (int round = 0; round < rounds(2, 20); ++round) {
    PhysicsWorld world(model);
    State state = initialState(model);
    if (model.joints().front().type == JointType::kFree) {
      state.q.segment<4>(3) = rng.uniformVector(4, -1, 1).normalized();
      state.v.head<3>() = rng.uniformVector(3, -3, 3);
    }
    world.setState(state);
    const Account account = accountOf(world, model, 2);
    EXPECT_LT(account.rise, 0.01 * account.lost()) << "round " << round;
  }
}

}  // namespace rex::passive_contact_test
