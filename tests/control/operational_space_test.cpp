#include "control/operational_space.h"

#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "control/computed_torque.h"
#include "control/point_mass.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/stepper.h"
#include "formats/scene_file.h"
#include "kinematics/task_maps.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::operational_space_test {

Model robot(const std::string& file) { return compile(readScene(sourcePath("data/robots") / file).spec); }

// An arm of seven joints, as it comes to a table.
const Model& arm() {
  static const Model model = robot("arm7dof/arm7dof.urdf");
  return model;
}

// Neither stretched nor folded.
State startOf(const Model& model) {
  State state = initialState(model);
  if (model.nq() == 3)
    state.q << 0.4, -0.9, 0.7;
  else
    state.q << 0.2, 0.5, -0.1, -1.6, 0.3, 1.4, 0.1;
  return state;
}

BodyId lastBody(const Model& model) { return model.joints().back().child; }

State bentState(Rng& rng, const Model& model) {
  return {model.initialPositions() + 0.5 * rng.normalVector(model.nq()), rng.normalVector(model.nv())};
}

Eigen::MatrixXd randomMetric(Rng& rng, int n) {
  const Eigen::MatrixXd A = rng.normalVector(n * n).reshaped(n, n);
  return A * A.transpose() / n + Eigen::MatrixXd::Identity(n, n);
}

TaskValue valueAt(const Model& model, const State& state, const TaskMap& map) {
  const BodyPoses poses = forwardKinematics(model, state.q);
  TaskValue value;
  map({model, state.q, poses}, value);
  return value;
}

// y'' under forces u, which is affine in them.
Eigen::VectorXd accelerationUnder(const Model& model, const State& state, const TaskMap& map,
                                  const Eigen::VectorXd& u) {
  return valueAt(model, state, map).J * forwardDynamics(model, state.q, state.v, u) +
         velocityAcceleration(model, state, map);
}

// Its derivative by u, without a mass matrix.
Eigen::MatrixXd gainOfForces(const Model& model, const State& state, const TaskMap& map) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.nv());
  const Eigen::VectorXd still = accelerationUnder(model, state, map, none);
  Eigen::MatrixXd T(still.size(), model.nv());
  for (int i = 0; i < model.nv(); ++i)
    T.col(i) = accelerationUnder(model, state, map, Eigen::VectorXd::Unit(model.nv(), i)) - still;
  return T;
}

OperationalTask pointTask(const Model& model, const Eigen::Vector3d& target, double lambda = 0.2,
                          double xi = 0.7) {
  return {
      .task = {.name = "point", .map = positionTask(lastBody(model), {0.05, 0.02, 0.1}), .target = target},
      .gains = pdGains(1, lambda, xi)};
}

TEST(VelocityAcceleration, IsCentripetalOnACircle) {
  const Model model = robot("arm3.ors");
  State state = initialState(model);
  const Joint& joint = model.joints().front();
  state.v = 3 * Eigen::VectorXd::Unit(3, joint.vIndex);
  const BodyPoses poses = forwardKinematics(model, state.q);
  const Eigen::Vector3d p_WQ = poses[lastBody(model)].p;
  const Eigen::Vector3d toAxis = (poses[joint.parent] * joint.X_PF).p - p_WQ;
  const Eigen::VectorXd a = velocityAcceleration(model, state, positionTask(lastBody(model)));
  EXPECT_LT((a - 9 * Eigen::Vector3d(0, toAxis.y(), toAxis.z())).norm(), 1e-9);
}

// y'' = J a + J' v along a motion that was simulated, by second differences of y.
TEST(VelocityAcceleration, CompletesTheAccelerationOfEveryMap) {
  Rng rng(1);
  const double h = 1e-3;
  const BodyId body = lastBody(arm());
  const TaskMap maps[] = {positionTask(body, {0.1, 0, 0.2}), vectorTask(body, {0, 0, 1}),
                          quaternionTask(body), poseTask(body, {}), centerOfMassTask()};
  for (const TaskMap& map : maps) {
    const State now = bentState(rng, arm());
    const Eigen::VectorXd u = gravityForces(arm(), now.q);
    State after = now, before = now;
    Stepper stepper(arm());
    stepper.step(after, u, h);
    before.v = -now.v;  // back in time
    stepper.step(before, u, h);
    const Eigen::VectorXd y = valueAt(arm(), now, map).y;
    const Eigen::VectorXd differences =
        (valueAt(arm(), before, map).y - 2 * y + valueAt(arm(), after, map).y) / (h * h);
    EXPECT_LT((accelerationUnder(arm(), now, map, u) - differences).norm(), 1e-2 * (1 + differences.norm()));
  }
}

TEST(VelocityAcceleration, GrowsWithTheSquareOfTheVelocity) {
  Rng rng(2);
  State state = bentState(rng, arm());
  const TaskMap map = poseTask(lastBody(arm()), {});
  const Eigen::VectorXd once = velocityAcceleration(arm(), state, map);
  for (const double factor : {1e-8, -1., 100.}) {
    const State other{state.q, factor * state.v};
    EXPECT_LT((velocityAcceleration(arm(), other, map) - factor * factor * once).norm(),
              1e-9 * factor * factor * (1 + once.norm()));
  }
  state.v.setZero();
  EXPECT_EQ(velocityAcceleration(arm(), state, map), Eigen::VectorXd::Zero(6));
}

// Slide 3:32 as a least squares problem: rows sqrt(rho) T and the root of H.
TEST(OperationalSpaceForces, MinimiseTheirCost) {
  Rng rng(3);
  for (int i = 0; i < 10; ++i) {
    const State state = bentState(rng, arm());
    OperationalTask point = pointTask(arm(), rng.normalVector(3)), home{};
    point.task.precision = 40;
    point.velocity = rng.normalVector(3);
    point.acceleration = rng.normalVector(3);
    home.task = {.map = homingTask(arm().initialPositions()), .precision = 0.2};
    home.gains = pdGains(1, 0.5, 1);
    const OperationalSpaceOptions options{.H = randomMetric(rng, 7), .u0 = rng.normalVector(7)};
    const std::vector<OperationalTask> tasks{point, home};
    const Eigen::VectorXd u = operationalSpaceForces(arm(), state, tasks, options);

    Eigen::MatrixXd A(17, 7);
    Eigen::VectorXd b(17);
    int row = 0;
    for (const OperationalTask& one : tasks) {
      const TaskValue value = valueAt(arm(), state, one.task.map);
      const int d = static_cast<int>(value.y.size());
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(d);
      const auto orZero = [&](const Eigen::VectorXd& x) { return x.size() > 0 ? x : zero; };
      const Eigen::VectorXd wanted = orZero(one.acceleration) +
                                     one.gains.Kp * (orZero(one.task.target) - value.y) +
                                     one.gains.Kd * (orZero(one.velocity) - value.J * state.v);
      const double weight = std::sqrt(one.task.precision);
      A.middleRows(row, d) = weight * gainOfForces(arm(), state, one.task.map);
      b.segment(row, d) =
          weight * (wanted - accelerationUnder(arm(), state, one.task.map, Eigen::VectorXd::Zero(7)));
      row += d;
    }
    const Eigen::MatrixXd root = options.H.llt().matrixU();
    A.bottomRows(7) = root;
    b.tail(7) = root * options.u0;
    const Eigen::VectorXd best = A.colPivHouseholderQr().solve(b);
    EXPECT_LT((u - best).norm(), 1e-7 * (1 + best.norm()));
  }
}

TEST(OperationalSpaceForces, ComeToTheirLimitOfLargePrecision) {
  Rng rng(4);
  const State state = bentState(rng, arm());
  const OperationalSpaceOptions options{.H = randomMetric(rng, 7), .damping = 0};
  OperationalTask point = pointTask(arm(), {0.3, 0.2, 0.5});
  const Eigen::VectorXd limit = prioritisedForces(arm(), state, {&point, 1}, options);
  double before = std::numeric_limits<double>::infinity();
  for (const double precision : {1e2, 1e4, 1e6, 1e8}) {
    point.task.precision = precision;
    const double distance = (operationalSpaceForces(arm(), state, {&point, 1}, options) - limit).norm();
    EXPECT_LT(distance, before);
    before = distance;
  }
  EXPECT_LT(before, 1e-4 * limit.norm());

  // H^-1 T^T (T H^-1 T^T)^-1 of slide 3:33.
  const Eigen::MatrixXd T = gainOfForces(arm(), state, point.task.map);
  const Eigen::MatrixXd X = options.H.llt().solve(T.transpose());
  const TaskValue value = valueAt(arm(), state, point.task.map);
  const Eigen::VectorXd wanted = point.gains.Kp * (point.task.target - value.y) -
                                 point.gains.Kd * value.J * state.v -
                                 accelerationUnder(arm(), state, point.task.map, Eigen::VectorXd::Zero(7));
  EXPECT_LT((X * (T * X).lu().solve(wanted) - limit).norm(), 1e-7 * (1 + limit.norm()));
}

// u = J^T Lambda (y''* - J' v) + J^T Lambda J M^-1 F, with the inertia Lambda = (J M^-1 J^T)^-1 that is felt
// at the hand.
TEST(PrioritisedForces, AreThoseOfKhatibInTheMetricOfTheInverseMassMatrix) {
  Rng rng(5);
  for (int i = 0; i < 10; ++i) {
    const State state = bentState(rng, arm());
    const OperationalTask point = pointTask(arm(), {0.3, 0.2, 0.5});
    const auto [M, F] = equationOfMotion(arm(), state.q, state.v);
    const Eigen::MatrixXd inverse = M.inverse(), H = (inverse + inverse.transpose()) / 2;
    const TaskValue value = valueAt(arm(), state, point.task.map);
    const Eigen::MatrixXd Lambda = (value.J * inverse * value.J.transpose()).inverse();
    const Eigen::VectorXd wanted = point.gains.Kp * (point.task.target - value.y) -
                                   point.gains.Kd * value.J * state.v -
                                   velocityAcceleration(arm(), state, point.task.map);
    const Eigen::VectorXd khatib = value.J.transpose() * Lambda * (wanted + value.J * inverse * F);
    const Eigen::VectorXd u = prioritisedForces(arm(), state, {&point, 1}, {.H = H, .damping = 0});
    EXPECT_LT((u - khatib).norm(), 1e-7 * (1 + khatib.norm()));
  }
}

// The second task pulls hard at the posture and at another place of the hand.
TEST(PrioritisedForces, NeverLetTheSecondTaskDisturbTheFirst) {
  Rng rng(6);
  for (int i = 0; i < 20; ++i) {
    const State state = bentState(rng, arm());
    OperationalTask first = pointTask(arm(), {0.3, 0.2, 0.5}), second{};
    second.task = {.name = "posture", .map = homingTask(rng.normalVector(7))};
    second.gains = pdGains(1, 0.05, 1);
    const Eigen::VectorXd alone = prioritisedForces(arm(), state, {&first, 1}, {.damping = 0});
    const Eigen::VectorXd both = prioritisedForces(arm(), state, std::vector{first, second},
                                                   {.u0 = rng.normalVector(7), .damping = 0});
    const auto accelerationOfFirst = [&](const Eigen::VectorXd& u) {
      return accelerationUnder(arm(), state, first.task.map, u);
    };
    EXPECT_GT((both - alone).norm(), 1);
    EXPECT_LT((accelerationOfFirst(both) - accelerationOfFirst(alone)).norm(), 1e-7 * (1 + both.norm()));
    // A weighted sum of the tasks is a compromise.
    const Eigen::VectorXd weighted = operationalSpaceForces(arm(), state, std::vector{first, second});
    EXPECT_GT((accelerationOfFirst(weighted) - accelerationOfFirst(alone)).norm(), 1e-2);
  }
}

// The greatest distance between the point's way and that of a free point mass on the same spring (slide
// 3:34), under forces that are held for h.
double distanceFromPointMass(const Model& model, const TaskMap& map, const Eigen::VectorXd& e, double h) {
  State state = startOf(model);
  const Eigen::VectorXd target = valueAt(model, state, map).y - e;
  OperationalTask task{.task = {.map = map, .target = target}, .gains = pdGains(1, 0.15, 0.6)};
  OperationalTask posture{.task = {.map = homingTask(state.q)}, .gains = pdGains(1, 0.15, 1)};
  Stepper stepper(model);
  double worst = 0;
  for (int i = 1; i <= std::lround(1 / h); ++i) {
    stepper.step(state, prioritisedForces(model, state, std::vector{task, posture}, {.damping = 0}), h);
    const Eigen::VectorXd y = valueAt(model, state, map).y;
    for (Eigen::Index k = 0; k < e.size(); ++k)
      worst =
          std::max(worst, std::abs(y[k] - target[k] - pdResponse({1}, task.gains, {e[k], 0}, 0, i * h).q));
  }
  return worst;
}

TEST(PrioritisedForces, MakeTheHandBehaveLikeAPointMass) {
  const TaskMap hand = positionTask(lastBody(arm()));
  const Eigen::Vector3d e(0.05, 0.1, -0.08);
  const double coarse = distanceFromPointMass(arm(), hand, e, 2e-3);
  const double fine = distanceFromPointMass(arm(), hand, e, 1e-3);
  EXPECT_LT(fine, 0.02 * e.norm());
  EXPECT_NEAR(coarse / fine, 2, 0.2);
}

// pegArm moves in a plane, and y holds what it can do: two coordinates.
TEST(PrioritisedForces, MakeThePegBehaveLikeAPointMass) {
  const Model model = robot("pegArm.ors");
  const TaskMap whole = positionTask(model.body("peg"));
  const Eigen::MatrixXd J = valueAt(model, startOf(model), whole).J;
  Eigen::Vector3d::Index outside = 0;
  J.rowwise().norm().minCoeff(&outside);
  ASSERT_LT(J.row(outside).norm(), 1e-12);
  const TaskMap inPlane = [whole, outside](const Posture& at, TaskValue& value) {
    TaskValue all;
    whole(at, all);
    const Eigen::Vector2i kept((outside + 1) % 3, (outside + 2) % 3);
    value = {all.y(kept), all.J(kept, Eigen::all)};
  };
  const Eigen::Vector2d e(0.05, -0.03);
  const double coarse = distanceFromPointMass(model, inPlane, e, 2e-3);
  const double fine = distanceFromPointMass(model, inPlane, e, 1e-3);
  EXPECT_LT(fine, 0.03 * e.norm());
  EXPECT_NEAR(coarse / fine, 2, 0.3);
}

// The hand stays where it is while the arm turns towards another posture: as far as the hand allows, so that
// in the end nothing in the nullspace of the hand pulls any more.
TEST(PrioritisedForces, ChangeThePostureBehindTheHand) {
  State state = startOf(arm());
  const TaskMap map = poseTask(lastBody(arm()), forwardKinematics(arm(), state.q)[lastBody(arm())]);
  const Eigen::VectorXd home = state.q + 0.8 * Eigen::VectorXd::Unit(7, 0);
  const OperationalTask hand{.task = {.map = map}, .gains = pdGains(1, 0.05, 1)};
  const OperationalTask posture{.task = {.map = homingTask(home)}, .gains = pdGains(1, 0.2, 1)};
  Stepper stepper(arm());
  const double before = (home - state.q).norm();
  double greatest = 0;
  for (int i = 0; i < 3000; ++i) {
    stepper.step(state, prioritisedForces(arm(), state, std::vector{hand, posture}), 1e-3);
    greatest = std::max(greatest, valueAt(arm(), state, map).y.norm());
  }
  EXPECT_LT(greatest, 2e-3);
  EXPECT_LT(state.v.norm(), 1e-3);
  EXPECT_LT((home - state.q).norm(), 0.95 * before);
  const Eigen::MatrixXd kernel = valueAt(arm(), state, map).J.fullPivLu().kernel();
  ASSERT_EQ(kernel.cols(), 1);
  EXPECT_LT(std::abs(kernel.col(0).normalized().dot(home - state.q)), 5e-3);
}

TEST(OperationalSpaceForces, RefuseBadTasks) {
  const State state = initialState(arm());
  OperationalTask task = pointTask(arm(), {0, 0, 1});
  const auto forces = [&](const OperationalSpaceOptions& options = {}) {
    return operationalSpaceForces(arm(), state, {&task, 1}, options);
  };
  task.velocity = Eigen::Vector2d(0, 0);
  EXPECT_REX_ERROR(forces(), "task 'point': reference velocity: found a vector of size 2, wanted size 3");
  task.velocity.resize(0);
  task.acceleration = Eigen::Vector2d(0, 0);
  EXPECT_REX_ERROR(forces(), "task 'point': reference acceleration: found a vector of size 2, wanted size 3");
  task.acceleration.resize(0);
  EXPECT_REX_ERROR(forces({.H = -Eigen::MatrixXd::Identity(7, 7)}), "positive definite");
  EXPECT_REX_ERROR(prioritisedForces(arm(), state, {&task, 1}, {.u0 = Eigen::Vector2d(0, 0)}),
                   "found a vector of size 2, wanted size 7");
  EXPECT_REX_ERROR(velocityAcceleration(arm(), {state.q, Eigen::Vector2d(0, 0)}, task.task.map),
                   "joint velocities v: found a vector of size 2, wanted size 7");
  task.task.precision = 0;
  EXPECT_REX_ERROR(forces(), "'point'");
}

TEST(OperationalSpaceForces, RefuseNumbersThatAreNotFinite) {
  State state = initialState(arm());
  OperationalTask task = pointTask(arm(), {0, 0, 1});
  const double nan = std::nan("");
  const auto forces = [&](const OperationalSpaceOptions& options = {}) {
    return prioritisedForces(arm(), state, {&task, 1}, options);
  };
  task.velocity = Eigen::Vector3d(0, 0, nan);
  EXPECT_REX_ERROR(forces(), "task 'point': reference velocity: number 2: found nan, wanted a finite number");
  task.velocity.resize(0);
  task.acceleration = Eigen::Vector3d(0, nan, 0);
  EXPECT_REX_ERROR(forces(), "task 'point': reference acceleration: number 1: found nan");
  task.acceleration.resize(0);
  task.gains.Kd = nan;
  EXPECT_REX_ERROR(forces(), "task 'point': gain Kd: found nan");
  task.gains = {.Kp = nan};
  EXPECT_REX_ERROR(forces(), "task 'point': gain Kp: found nan");
  task.gains = {};
  EXPECT_REX_ERROR(forces({.gravity_W = {0, 0, nan}}), "gravity: number 2: found nan");
  state.v[6] = nan;
  EXPECT_REX_ERROR(forces(), "joint velocities v: number 6: found nan");
  EXPECT_REX_ERROR(velocityAcceleration(arm(), state, task.task.map),
                   "joint velocities v: number 6: found nan");
  state.q[1] = nan;
  EXPECT_REX_ERROR(forces(), "joint positions q: number 1: found nan");
}

// Two bodies on hinges about the same axis, of which the first has no mass: what rounding leaves of its
// inertia is now and then positive, so that M has a factor.
TEST(OperationalSpaceForces, NameTheBodyThatNeedsMass) {
  SceneSpec spec;
  for (int i = 0; i < 2; ++i) {
    const std::string number = std::to_string(i);
    spec.bodies.push_back({.name = "body" + number, .X_WB = {}, .mass = 1. * i, .p_BBcm = {0.3, 0.1, 0}});
    spec.joints.push_back({.name = "joint" + number,
                           .parent = i == 0 ? "world" : "body0",
                           .child = "body" + number,
                           .X_PF = {},
                           .X_MC = {}});
    spec.joints.back().axis = Eigen::Vector3d::UnitZ();
  }
  const Model model = compile(spec);
  const std::string text = "joint 'joint0' moves no mass: wanted some: give body 'body0' a mass";
  const OperationalTask task = pointTask(model, {1, 0, 0});
  Rng rng(7);
  int withFactor = 0;
  for (int i = 0; i < 100; ++i) {
    const State state{rng.normalVector(2), rng.normalVector(2)};
    if (massMatrix(model, state.q).llt().info() == Eigen::Success) ++withFactor;
    EXPECT_REX_ERROR(operationalSpaceForces(model, state, {&task, 1}), text);
    EXPECT_REX_ERROR(prioritisedForces(model, state, {&task, 1}), text);
  }
  EXPECT_GT(withFactor, 0);
}

}  // namespace rex::operational_space_test
