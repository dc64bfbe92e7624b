#include "course/vision_simulator.h"

#include <cmath>
#include <fstream>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::vision_simulator_test {

nlohmann::json golden() {
  std::ifstream stream(sourcePath("tests/golden/exercises.json"));
  return nlohmann::json::parse(stream)["vision"];
}

TEST(VisionSimulator, AgreesWithTheGoldenNumbers) {
  const nlohmann::json vision = golden();
  VisionSimulator simulator;
  const auto& P = simulator.getProjection();
  const double scale = vision["P"][0][0].get<double>() / P(0, 0);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      EXPECT_NEAR(scale * P(row, column),
                  vision["P"][static_cast<std::size_t>(row)][static_cast<std::size_t>(column)].get<double>(),
                  1e-8);
  for (std::size_t i = 0; i < vision["points"].size(); ++i) {
    Eigen::Matrix4Xd point(4, 1);
    for (std::size_t k = 0; k < 4; ++k)
      point(static_cast<Eigen::Index>(k), 0) = vision["points"][i][k].get<double>();
    const Eigen::Matrix3Xd pixel = simulator.projectWorldPoints(point, 0);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(pixel(static_cast<Eigen::Index>(k), 0), vision["pixels"][i][k].get<double>(), 1e-10);
  }
}

// The exercise itself: the matrix from points and pixels by the direct linear transform, and the camera's
// place as its null vector.
TEST(VisionSimulator, CanBeCalibrated) {
  VisionSimulator simulator(1);
  const Eigen::Matrix4Xd X = simulator.getRandomWorldPoints(100);
  EXPECT_LE(X.topRows<3>().cwiseAbs().maxCoeff(), 1);
  const auto placeFrom = [&](double noise) -> Eigen::Vector3d {
    const Eigen::Matrix3Xd pixels = simulator.projectWorldPoints(X, noise);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(200, 12);
    for (Eigen::Index i = 0; i < 100; ++i) {
      A.block<1, 4>(2 * i, 0) = A.block<1, 4>(2 * i + 1, 4) = X.col(i).transpose();
      A.block<1, 4>(2 * i, 8) = -pixels(0, i) * X.col(i).transpose();
      A.block<1, 4>(2 * i + 1, 8) = -pixels(1, i) * X.col(i).transpose();
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinV);
    const Eigen::VectorXd p = svd.matrixV().col(11);
    Eigen::Matrix<double, 3, 4> P;
    P << p.head<4>().transpose(), p.segment<4>(4).transpose(), p.tail<4>().transpose();
    return -P.leftCols<3>().inverse() * P.col(3);
  };
  EXPECT_LT((placeFrom(0) - Eigen::Vector3d(10, -15, 8)).norm(), 1e-6);
  EXPECT_LT((placeFrom(.5) - Eigen::Vector3d(10, -15, 8)).norm(), 3);
}

TEST(VisionSimulator, SaysWhatIsWrong) {
  VisionSimulator simulator;
  EXPECT_REX_ERROR(simulator.getRandomWorldPoints(-1), "points: found -1, wanted 0 or more");
  const Eigen::Vector4d behind(20, -30, 16, 1);
  EXPECT_REX_ERROR(simulator.projectWorldPoints(behind, 0), "point 0: found a position behind the camera");
  EXPECT_REX_ERROR(simulator.projectWorldPoints(Eigen::Vector4d(0, 0, 0, 1), -1),
                   "noise of pixels: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(simulator.projectWorldPoints(Eigen::Vector4d(0, INFINITY, 0, 1)),
                   "points: number 1: found inf");
}

}  // namespace rex::vision_simulator_test
