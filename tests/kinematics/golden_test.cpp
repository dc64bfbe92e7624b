// Numbers recorded from an independent implementation: positions, axes, orientations, Jacobians, centre of
// mass.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "formats/ors_reader.h"
#include "geometry/rotation.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"
#include "support/paths.h"

namespace rex::golden_test {

constexpr double kTolerance = 1e-9;

Eigen::VectorXd vectorFrom(const nlohmann::json& numbers) {
  const auto values = numbers.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXd matrixFrom(const nlohmann::json& rows) {
  Eigen::MatrixXd m(rows.size(), rows.at(0).size());
  for (std::size_t i = 0; i < rows.size(); ++i) m.row(static_cast<Eigen::Index>(i)) = vectorFrom(rows[i]);
  return m;
}

void expectNear(const Eigen::MatrixXd& got, const Eigen::MatrixXd& wanted, double tolerance,
                const std::string& what) {
  ASSERT_EQ(got.rows(), wanted.rows()) << what;
  ASSERT_EQ(got.cols(), wanted.cols()) << what;
  EXPECT_LE((got - wanted).cwiseAbs().maxCoeff(), tolerance) << what;
}

void compareConfiguration(const Model& model, const nlohmann::json& golden,
                          const nlohmann::json& configuration) {
  const BodyPoses poses = forwardKinematics(model, vectorFrom(configuration.at("q")));
  for (std::size_t i = 0; i < golden.at("bodies").size(); ++i) {
    const std::string name = golden["bodies"][i];
    const BodyId body = model.body(name);
    expectNear(poses[body].p, vectorFrom(configuration.at("pos")[i]), kTolerance, name + " position");
    expectNear(poses[body].R.col(2), vectorFrom(configuration.at("zaxis")[i]), kTolerance, name + " z axis");
    expectNear(poses[body].R, rotationFromQuaternion(vectorFrom(configuration.at("quat_wxyz")[i])),
               kTolerance, name + " orientation");
  }
  for (const auto& [name, jacobians] : configuration.at("jac").items()) {
    const BodyId body = model.body(name);
    expectNear(positionJacobian(model, poses, body, Eigen::Vector3d::Zero()),
               matrixFrom(jacobians.at("Jpos")), kTolerance, name + " Jpos");
    expectNear(directionJacobian(model, poses, body, Eigen::Vector3d::UnitZ()),
               matrixFrom(jacobians.at("JvecZ")), kTolerance, name + " JvecZ");
  }
  const nlohmann::json& dynamics = configuration.at("dynamics");
  EXPECT_NEAR(model.mass(), dynamics.at("mass").get<double>(), kTolerance);
  expectNear(centerOfMass(model, poses), vectorFrom(dynamics.at("com")), kTolerance, "centre of mass");
  expectNear(centerOfMassJacobian(model, poses), matrixFrom(dynamics.at("comJ")), kTolerance,
             "centre of mass Jacobian");
}

void compareWithGolden(const std::filesystem::path& scene, const std::string& name) {
  std::ifstream file(sourcePath("tests/golden") / (name + ".json"));
  ASSERT_TRUE(file) << name;
  const nlohmann::json golden = nlohmann::json::parse(file);
  const Model model = compile(readOrs(scene).spec);
  ASSERT_EQ(model.nq(), golden.at("ndof").get<int>());
  ASSERT_EQ(model.joints().size(), golden.at("joints").size());
  for (std::size_t j = 0; j < golden["joints"].size(); ++j) {
    const nlohmann::json& joint = golden["joints"][j];
    EXPECT_EQ(model.joints()[j].name,
              joint.at("from").get<std::string>() + ">" + joint.at("to").get<std::string>());
    EXPECT_EQ(model.joints()[j].qIndex, joint.at("qIndex").get<int>());
  }
  ASSERT_EQ(golden.at("configs").size(), 6u);
  expectNear(model.initialPositions(), vectorFrom(golden["configs"][0].at("q")), kTolerance,
             "posture of the file");
  for (const nlohmann::json& configuration : golden["configs"])
    compareConfiguration(model, golden, configuration);
}

// Of this one there is no file of our own.
TEST(Golden, HistoricalArmMatches) {
  if (!std::filesystem::exists(sharedPath("data/ors/arm3.ors")))
    GTEST_SKIP() << "the sample scenes of the historical course are not here";
  compareWithGolden(sharedPath("data/ors/arm3.ors"), "arm3");
}

class GoldenScene : public testing::TestWithParam<std::string> {};

TEST_P(GoldenScene, OwnFileMatches) {
  compareWithGolden(sourcePath("data/robots") / (GetParam() + ".ors"), GetParam());
}

TEST_P(GoldenScene, HistoricalFileMatches) {
  const std::filesystem::path scene = sharedPath("data/ors") / (GetParam() + ".ors");
  if (!std::filesystem::exists(scene))
    GTEST_SKIP() << "the sample scenes of the historical course are not here";
  compareWithGolden(scene, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Course, GoldenScene, testing::Values("man", "pegInAHole", "pegArm", "arm3"),
                         [](const auto& i) { return i.param; });

}  // namespace rex::golden_test
