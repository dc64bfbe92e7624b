#include "control/operational_contacts.h"

#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/loop_dynamics.h"
#include "formats/scene_file.h"
#include "kinematics/task_maps.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::operational_contacts_test {

using Eigen::VectorXd;

const Model& arm() {
  static const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  return model;
}

TaskValue valueAt(const State& state, const TaskMap& map) {
  const BodyPoses poses = forwardKinematics(arm(), state.q);
  TaskValue value;
  map({arm(), state.q, poses}, value);
  return value;
}

// Some coordinates of a point of the last body.
TaskMap coordinates(int first, int count) {
  return taskRows(positionTask(arm().joints().back().child, {0.05, 0.02, 0.1}), first, count);
}

// The point lies on a table: its height does not change.
OperationalContact onTable(double force) {
  return {.name = "table", .map = coordinates(2, 1), .force = VectorXd::Constant(1, force)};
}

OperationalTask alongTable() {
  return {.task = {.name = "along", .map = coordinates(0, 2), .target = Eigen::Vector2d(0.3, 0.2)},
          .gains = pdGains(1, 0.2, 0.7)};
}

// The point moves along the table.
State slidingState(Rng& rng) {
  State state{arm().initialPositions() + 0.5 * rng.normalVector(7), rng.normalVector(7)};
  const Eigen::MatrixXd J = valueAt(state, coordinates(2, 1)).J;
  state.v -= J.transpose() * (J * state.v) / J.squaredNorm();
  return state;
}

VectorXd wantedOf(const OperationalTask& task, const State& state) {
  const TaskValue at = valueAt(state, task.task.map);
  return task.gains.Kp * (task.task.target - at.y) - task.gains.Kd * (at.J * state.v);
}

// Newton's law, with the wanted force in place of the table, gives the motion that the task wants, and leaves
// the point on the table.
TEST(ForcesInContact, PressAsWantedWhileTheHandMoves) {
  Rng rng(8);
  for (int i = 0; i < 10; ++i) {
    const OperationalContact contact = onTable(25);
    const OperationalTask along = alongTable();
    const State state = slidingState(rng);
    const VectorXd u =
        forcesInContact(arm(), state, {&contact, 1}, {&along, 1}, {.u0 = rng.normalVector(7), .damping = 0});
    const TaskValue height = valueAt(state, contact.map), place = valueAt(state, along.task.map);
    const VectorXd a = forwardDynamics(arm(), state.q, state.v, u + height.J.transpose() * contact.force);
    const double rounding = 1e-7 * (1 + a.norm());
    EXPECT_NEAR((height.J * a + velocityAcceleration(arm(), state, contact.map))[0], 0, rounding);
    const VectorXd found = place.J * a + velocityAcceleration(arm(), state, along.task.map);
    EXPECT_LT((found - wantedOf(along, state)).norm(), rounding);
  }
}

// All of 200 other forces near them that press as much miss the task by as much or more, or are larger; here
// the arm cannot do what is asked: three coordinates of which the table takes one.
TEST(ForcesInContact, FulfilTasksAsWellAsTheContactAllows) {
  Rng rng(9);
  const OperationalContact contact = onTable(25);
  OperationalTask all = alongTable();
  all.task.map = coordinates(0, 3);
  all.task.target = Eigen::Vector3d(0.3, 0.2, 0.9);
  const State state = slidingState(rng);
  const VectorXd u = forcesInContact(arm(), state, {&contact, 1}, {&all, 1}, {.damping = 0});
  const auto motion = [&](const VectorXd& forces) {
    return loopDynamics(arm(), state, std::array{contact.map}, forces);
  };
  const auto miss = [&](const VectorXd& forces) {
    return (valueAt(state, all.task.map).J * motion(forces).a +
            velocityAcceleration(arm(), state, all.task.map) - wantedOf(all, state))
        .norm();
  };
  const double least = miss(u);
  EXPECT_NEAR(motion(u).forces[0], 25, 1e-6);
  EXPECT_NEAR(least, std::abs(wantedOf(all, state)[2]), 1e-6 * least) << "all that is missed is the height";
  const Eigen::MatrixXd pressing = loopResponse(arm(), state.q, std::array{contact.map}).forces_u;
  for (int i = 0; i < 200; ++i) {
    VectorXd aside = rng.normalVector(7);
    aside -= pressing.transpose() * (pressing * aside) / pressing.squaredNorm();
    const VectorXd other = u + 0.1 * aside;
    EXPECT_NEAR(motion(other).forces[0], 25, 1e-6);
    EXPECT_TRUE(miss(other) > least || other.norm() > u.norm());
  }
}

// Without a wanted force a contact only holds; without contacts they are those of prioritisedForces().
TEST(ForcesInContact, LeaveForcesOpen) {
  Rng rng(10);
  const State state = slidingState(rng);
  OperationalContact contact = onTable(0);
  contact.force.resize(0);
  const OperationalTask along = alongTable();
  const VectorXd u = forcesInContact(arm(), state, {&contact, 1}, {&along, 1}, {.damping = 0});
  const VectorXd a = loopDynamics(arm(), state, std::array{contact.map}, u).a;
  const VectorXd found =
      valueAt(state, along.task.map).J * a + velocityAcceleration(arm(), state, along.task.map);
  EXPECT_LT((found - wantedOf(along, state)).norm(), 1e-7 * (1 + a.norm()));
  const VectorXd alone = prioritisedForces(arm(), state, {&along, 1});
  EXPECT_LT((forcesInContact(arm(), state, {}, {&along, 1}) - alone).norm(), 1e-9 * alone.norm());
  EXPECT_GT((u - alone).norm(), 1e-3);
}

// Two maps that say the same: each takes half.
TEST(ForcesInContact, ShareWhatDependsOnEachOther) {
  Rng rng(11);
  const State state = slidingState(rng);
  const std::array contacts{onTable(10), onTable(10)};
  const OperationalTask along = alongTable();
  const VectorXd twice = forcesInContact(arm(), state, contacts, {&along, 1}, {.damping = 0}),
                 once = forcesInContact(arm(), state, std::array{onTable(20)}, {&along, 1}, {.damping = 0});
  EXPECT_LT((twice - once).norm(), 1e-6 * once.norm());
}

TEST(ForcesInContact, NameWhatIsWrong) {
  const State state = initialState(arm());
  OperationalContact contact = onTable(1);
  const OperationalTask along = alongTable();
  const auto forces = [&] { return forcesInContact(arm(), state, {&contact, 1}, {&along, 1}); };
  contact.force = Eigen::Vector2d(0, 1);
  EXPECT_REX_ERROR(forces(), "contact 'table': force: found a vector of size 2, wanted size 1");
  contact.force = VectorXd::Constant(1, std::nan(""));
  EXPECT_REX_ERROR(forces(), "contact 'table': force: number 0: found nan");
  contact.map = nullptr;
  EXPECT_REX_ERROR(forces(), "task 'table': map: found none");
}

}  // namespace rex::operational_contacts_test
