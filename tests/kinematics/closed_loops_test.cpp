#include "kinematics/closed_loops.h"

#include <array>
#include <cmath>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "geometry/rotation.h"
#include "kinematics/jacobians.h"
#include "scene/state.h"
#include "support/expect_error.h"
#include "support/four_bar.h"

namespace rex::closed_loops_test {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::array<int, 1> kCrank{0};

TEST(ClosedLoops, OfAFourBarCloseWhereCirclesMeet) {
  const FourBar bar;
  const Model model = compile(bar.scene());
  const std::vector<TaskMap> loops = pinTasks(model);
  VectorXd q = bar.closedForm(0) + Vector3d(0, -.2, .2);
  for (int k = 0; k <= 36; ++k) {
    q[0] = k * M_PI / 18;
    const ClosedPosture closed = assemble(model, loops, q, kCrank);
    ASSERT_EQ(closed.status, ClosedPosture::Status::kClosed) << k << ": " << closed.message;
    q = closed.q;
    const Vector3d wanted = bar.closedForm(q[0]);
    EXPECT_EQ(q[0], k * M_PI / 18);
    EXPECT_NEAR(std::remainder(q[1] - wanted[1], 2 * M_PI), 0, 1e-10) << k;
    EXPECT_NEAR(std::remainder(q[2] - wanted[2], 2 * M_PI), 0, 1e-10) << k;
    // One way to move, with the speeds that the closed form's differences give.
    const Eigen::MatrixXd motions = loopMotions(model, loops, q);
    ASSERT_EQ(motions.cols(), 1) << k;
    constexpr double kStep = 1e-6;
    const Vector3d slope = (bar.closedForm(q[0] + kStep) - bar.closedForm(q[0] - kStep)) / (2 * kStep);
    EXPECT_LT((motions.col(0) / motions(0, 0) - slope).norm(), 1e-7) << k;
  }
}

// A Delta robot: three arms on the world, and a platform that only shifts, on three rods.
struct Delta {
  static constexpr double kBase = 0.3, kArm = 0.4, kRod = 0.9, kPlatform = 0.1;

  static double directionOf(int k) { return 2 * M_PI / 3 * k; }
  static Vector3d outwards(int k) { return {std::cos(directionOf(k)), std::sin(directionOf(k)), 0}; }

  static SceneSpec scene() {
    SceneSpec spec{.name = "delta", .bodies = {}, .joints = {}, .worldShapes = {}};
    const auto add = [&](const std::string& name, const std::string& parent, JointType type) -> JointSpec& {
      spec.bodies.push_back({.name = name, .X_WB = {}, .mass = 1});
      spec.joints.push_back(
          {.name = name + "-joint", .parent = parent, .child = name, .X_PF = {}, .X_MC = {}});
      spec.joints.back().type = type;
      return spec.joints.back();
    };
    for (int k = 0; k < 3; ++k) {
      JointSpec& hinge = add("arm" + std::to_string(k), "world", JointType::kHinge);
      hinge.axis = Vector3d::UnitY();  // a positive angle lowers the arm
      hinge.X_PF = {expSO3(Vector3d(0, 0, directionOf(k))), kBase * outwards(k)};
    }
    add("slideX", "world", JointType::kSlider).axis = Vector3d::UnitX();
    add("slideY", "slideX", JointType::kSlider).axis = Vector3d::UnitY();
    add("platform", "slideY", JointType::kSlider).axis = Vector3d::UnitZ();
    return spec;
  }

  static std::vector<TaskMap> rods(const Model& model) {
    std::vector<TaskMap> all;
    for (int k = 0; k < 3; ++k)
      all.push_back(rodTask(model.body("arm" + std::to_string(k)), {kArm, 0, 0}, model.body("platform"),
                            kPlatform * outwards(k), kRod));
    return all;
  }

  // Where three spheres of the rods' length meet, below.
  static Vector3d platform(const Vector3d& angles) {
    std::array<Vector3d, 3> centre;
    for (int k = 0; k < 3; ++k)
      centre[static_cast<std::size_t>(k)] = (kBase - kPlatform + kArm * std::cos(angles[k])) * outwards(k) -
                                            kArm * std::sin(angles[k]) * Vector3d::UnitZ();
    const Vector3d a = centre[1] - centre[0], b = centre[2] - centre[0], x = a.normalized(),
                   y = (b - b.dot(x) * x).normalized(), z = x.cross(y);
    const double px = a.norm() / 2, i = b.dot(x), j = b.dot(y), py = (b.squaredNorm() / 2 - i * px) / j,
                 pz = std::sqrt(kRod * kRod - px * px - py * py);
    const Vector3d low = centre[0] + px * x + py * y - pz * z, high = centre[0] + px * x + py * y + pz * z;
    return low.z() < high.z() ? low : high;
  }
};

TEST(ClosedLoops, OfADeltaRobotCloseWhereSpheresMeet) {
  const Model model = compile(Delta::scene());
  const std::vector<TaskMap> loops = Delta::rods(model);
  constexpr std::array<int, 3> kArms{0, 1, 2};
  Rng rng(1);
  for (int k = 0; k < 20; ++k) {
    VectorXd q = VectorXd::Zero(6);
    q.head<3>() = rng.uniformVector(3, -.3, .9);
    q[5] = -.8;
    const ClosedPosture closed = assemble(model, loops, q, kArms);
    ASSERT_EQ(closed.status, ClosedPosture::Status::kClosed) << closed.message;
    EXPECT_EQ(closed.q.head<3>(), q.head<3>());
    EXPECT_LT((closed.q.tail<3>() - Delta::platform(q.head<3>())).norm(), 1e-10) << k;
    EXPECT_EQ(loopMotions(model, loops, closed.q).cols(), 3) << "three motors move it everywhere";
  }
}

TEST(ClosedLoops, HaveTheRightJacobians) {
  const FourBar bar;
  const Model model = compile(bar.scene());
  const BodyId coupler = model.body("coupler"), rocker = model.body("rocker");
  const std::array loops{pinTask(coupler, {.3, .1, .2}, rocker, {.1, 0, -.2}),
                         rodTask(coupler, {.3, .1, .2}, kWorld, {.5, -.4, 1}, .8)};
  Rng rng(2);
  for (const double size : {0., 1e-8, 1.}) {
    const VectorXd q = size * rng.normalVector(3);
    const VectorFunction value = [&](const VectorXd& at) { return stackLoops(model, loops, at).y; };
    const TaskValue at = stackLoops(model, loops, q);
    ASSERT_EQ(at.J.rows(), 4);
    EXPECT_LT((at.J - numericJacobian(value, q)).cwiseAbs().maxCoeff(), 1e-8) << size;
  }
  EXPECT_EQ(loopMotions(model, {}, VectorXd::Zero(3)), Eigen::Matrix3d::Identity());
}

TEST(ClosedLoops, SayThatTheyCannotClose) {
  const FourBar bar{.ground = 3};
  const Model model = compile(bar.scene());
  const std::vector<TaskMap> loops = pinTasks(model);
  const ClosedPosture open = assemble(model, loops, Vector3d(.2, 2.5, .1));
  EXPECT_EQ(open.status, ClosedPosture::Status::kStuck);
  EXPECT_NEAR(open.error, 3 - .3 - .9 - .7, .01) << "nearly stretched as far as it goes";
  EXPECT_THAT(open.message, testing::StartsWith("no step closes the loops: 1.1 are left"));
}

TEST(ClosedLoops, NameWhatIsWrong) {
  const FourBar bar;
  const Model model = compile(bar.scene());
  const std::vector<TaskMap> loops = pinTasks(model);
  constexpr std::array<int, 1> kNone{3};
  EXPECT_REX_ERROR(assemble(model, loops, Vector3d::Zero(), kNone),
                   "driven joints: found entry 3 of v, wanted entries from 0 to 2");
  EXPECT_REX_ERROR(assemble(model, loops, VectorXd::Zero(2)), "size 2");
  EXPECT_REX_ERROR(rodTask(kWorld, {}, kWorld, {}, 0), "rod: length: found 0 m");
}

}  // namespace rex::closed_loops_test
