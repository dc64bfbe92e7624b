// The course's scenes without recorded numbers: a second opinion by homogeneous matrices, joint after joint
// as the course's tables list them.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "formats/ors_reader.h"
#include "kinematics/forward_kinematics.h"
#include "support/paths.h"

namespace rex::course_scenes_test {

using Eigen::Matrix4d;

Matrix4d move(double x, double y, double z) {
  Matrix4d T = Matrix4d::Identity();
  T.col(3).head<3>() << x, y, z;
  return T;
}

Matrix4d turnBy(double radians, char axis) {
  const int i = (axis - 'x' + 1) % 3, j = (axis - 'x' + 2) % 3;
  Matrix4d T = Matrix4d::Identity();
  T(i, i) = T(j, j) = std::cos(radians);
  T(i, j) = -std::sin(radians);
  T(j, i) = std::sin(radians);
  return T;
}

Matrix4d turn(double degrees, char axis) { return turnBy(degrees * std::numbers::pi / 180, axis); }

struct Row {
  std::string body;
  Matrix4d A = Matrix4d::Identity(), B = Matrix4d::Identity();
  double degrees = 0;  // where the file shows the hinge
};

// Row 0 is the post, whose pose in the world is A.
struct Table {
  std::string scene;
  std::vector<Row> rows;
  double mass = 0;  // of all bodies, kg
};

Table sevenLinks(const std::string& scene, const std::string& last, double halfOfLast, double mass) {
  Table table{scene, {{.body = "stem", .A = move(0, 0, 1)}}, 8 * mass};
  table.rows.push_back({"arm1", move(0, 0, 1) * turn(90, 'x'), move(0, 0, 0.2)});
  for (int i = 2; i <= 7; ++i) {
    table.rows.push_back({i < 7 ? "arm" + std::to_string(i) : last, move(0, 0, 0.2) * turn(45, 'z'),
                          move(0, 0, i < 7 ? 0.2 : halfOfLast)});
  }
  return table;
}

Table pinBalancing() {
  Table table{"pin_balancing", {{.body = "stem", .A = move(0, 0, 1)}}, 0.9};
  table.rows.push_back({"arm1", move(0, 0, 1) * turn(-90, 'z') * turn(90, 'x'), move(0, 0, 0.2)});
  const double shown[] = {60, 60, 30, 0, 0};
  for (int i = 2; i <= 6; ++i) {
    table.rows.push_back(
        {"arm" + std::to_string(i), move(0, 0, 0.2) * turn(30, 'z'), move(0, 0, 0.2), shown[i - 2]});
  }
  table.rows.push_back({"universalJoint", move(0, 0, 0.2) * turn(90, 'y'), move(0, 0, 0), -40});
  table.rows.push_back({"pin", turn(90, 'z'), move(0, 0, 0.4)});
  return table;
}

class CourseScene : public testing::TestWithParam<Table> {};

TEST_P(CourseScene, StandsAsItsTableSays) {
  const Table& table = GetParam();
  const Model model = compile(readOrs(sourcePath("data/robots") / (table.scene + ".ors")).spec);
  ASSERT_EQ(model.nq(), static_cast<int>(table.rows.size()) - 1);
  EXPECT_NEAR(model.mass(), table.mass, 1e-12);
  for (int i = 0; i < model.nq(); ++i)
    EXPECT_NEAR(model.initialPositions()[i],
                table.rows[static_cast<std::size_t>(i) + 1].degrees * std::numbers::pi / 180, 1e-12);

  Rng rng(17);
  for (int sample = 0; sample < 20; ++sample) {
    Eigen::VectorXd q = model.initialPositions();
    if (sample > 0) q += rng.normalVector(model.nq());
    const BodyPoses poses = forwardKinematics(model, q);
    Matrix4d T = Matrix4d::Identity();
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const Row& row = table.rows[i];
      T = T * row.A;
      if (i > 0) T = T * turnBy(q[static_cast<Eigen::Index>(i) - 1], 'x') * row.B;
      const Pose& X_WB = poses[model.body(row.body)];
      EXPECT_LE((X_WB.R - T.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff(), 1e-12) << row.body;
      EXPECT_LE((X_WB.p - T.topRightCorner<3, 1>()).cwiseAbs().maxCoeff(), 1e-12) << row.body;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Course, CourseScene,
                         testing::Values(sevenLinks("pegArm2", "peg", 0.4, 0.1),
                                         sevenLinks("arm7", "arm7", 0.2, 1), pinBalancing()),
                         [](const auto& i) { return i.param.scene; });

}  // namespace rex::course_scenes_test
