#include "estimation/camera_calibration.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::camera_calibration_test {

using Eigen::Matrix2Xd;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// A camera at any place that looks at the points, about 10 m away.
struct Camera {
  explicit Camera(Rng& rng) {
    const Vector3d back = rng.normalVector(3).normalized();
    X_WC.p = rng.uniform(8, 12) * back + 0.3 * rng.normalVector(3);
    X_WC.R << back.cross(Vector3d(rng.normalVector(3))).normalized(), Vector3d::Zero(), back;
    X_WC.R.col(1) = X_WC.R.col(2).cross(X_WC.R.col(0));
  }
  Matrix2Xd seen(const Matrix3Xd& points) const {
    Matrix2Xd pixels(2, points.cols());
    for (int i = 0; i < points.cols(); ++i) {
      const Vector3d p_C = X_WC.inverse() * Vector3d(points.col(i));
      const double x = p_C[0] / -p_C[2], y = p_C[1] / -p_C[2];
      pixels.col(i) << 900 * x + 12 * y + 310, 950 * y + 240;
    }
    return pixels;
  }
  Pose X_WC;
};

Matrix3Xd randomPoints(int count, Rng& rng) { return rng.uniformVector(3 * count, -1, 1).reshaped(3, count); }

TEST(CameraCalibration, FindsTheCameraFromSixPoints) {
  Rng rng(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Camera truth(rng);
    const Matrix3Xd points = randomPoints(trial % 2 ? 6 : 30, rng);
    const CameraCalibration found = calibratedCamera(points, truth.seen(points));
    ASSERT_TRUE(isApprox(found.X_WC, truth.X_WC, 1e-5)) << trial;
    EXPECT_NEAR(found.focal[0], 900, 1e-3);
    EXPECT_NEAR(found.focal[1], 950, 1e-3);
    EXPECT_NEAR(found.skew, 12, 1e-3);
    EXPECT_NEAR(found.centre[0], 310, 1e-3);
    EXPECT_NEAR(found.centre[1], 240, 1e-3);
    EXPECT_LT(found.rms, 1e-6);
    // Depths in metres.
    const Vector3d p_C = truth.X_WC.inverse() * Vector3d(points.col(0));
    EXPECT_NEAR(found.P.row(2).dot(points.col(0).homogeneous()), -p_C[2], 1e-5);
  }
}

// Of 2 n numbers with deviation 1, 11 are explained by the fit; the deviations of the numbers are what
// repetition shows.
TEST(CameraCalibration, IsAsGoodAsItsStatisticsSay) {
  Rng rng(2);
  const Camera truth(rng);
  const Matrix3Xd points = randomPoints(40, rng);
  const Matrix2Xd pixels = truth.seen(points);
  const int runs = 300;
  double square = 0, initial = 0;
  Eigen::Matrix<double, 6, 1> spread = Eigen::Matrix<double, 6, 1>::Zero(), claimed = spread, wanted;
  wanted << truth.X_WC.p, 900, 950, 12;
  for (int run = 0; run < runs; ++run) {
    const CameraCalibration found = calibratedCamera(points, pixels + rng.normalVector(80).reshaped(2, 40));
    EXPECT_TRUE(found.isRefined);
    EXPECT_LE(found.rms, found.initialRms);
    square += found.rms * found.rms / runs;
    initial += found.initialRms * found.initialRms / runs;
    Eigen::Matrix<double, 6, 1> numbers;
    numbers << found.X_WC.p, found.focal, found.skew;
    spread += (numbers - wanted).cwiseAbs2() / runs;
    claimed += found.deviation.cwiseAbs2() / runs;
  }
  EXPECT_NEAR(square, (80. - 11) / 40, 0.05);
  EXPECT_GT(initial, square);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(std::sqrt(claimed[i] / spread[i]), 1, 0.2) << i;
}

TEST(CameraCalibration, TurnsAndScalesWithTheWorld) {
  Rng rng(3);
  const Camera truth(rng);
  const Matrix3Xd points = randomPoints(20, rng);
  const Matrix2Xd pixels = truth.seen(points) + 0.5 * rng.normalVector(40).reshaped(2, 20);
  const CameraCalibration plain = calibratedCamera(points, pixels);
  const Pose X_VW = translation(100, -50, 3) * rotation(1, Vector3d(1, 2, 3));
  Matrix3Xd moved = points;
  for (auto point : moved.colwise()) point = X_VW * Vector3d(point);
  const CameraCalibration other = calibratedCamera(moved, pixels);
  EXPECT_TRUE(isApprox(other.X_WC, X_VW * plain.X_WC, 1e-4));
  EXPECT_NEAR(other.focal[0], plain.focal[0], 1e-2);
  EXPECT_NEAR(other.rms, plain.rms, 1e-7);
}

TEST(CameraCalibration, RefusesWhatDoesNotDetermineACamera) {
  Rng rng(4);
  const Camera truth(rng);
  Matrix3Xd points = randomPoints(20, rng);
  const Matrix2Xd pixels = truth.seen(points);
  EXPECT_REX_ERROR(
      (void)calibratedCamera(points.leftCols(5), pixels.leftCols(5)),
      "camera calibration: found 5 points and 5 pixels, wanted as many pixels as points, at least 6");
  EXPECT_REX_ERROR((void)calibratedCamera(points, pixels.leftCols(7)), "found 20 points and 7 pixels");
  EXPECT_REX_ERROR((void)calibratedCamera(points * std::nan(""), pixels),
                   "camera calibration: points: number 0: found nan");
  EXPECT_REX_ERROR((void)calibratedCamera(points, pixels * HUGE_VAL),
                   "camera calibration: pixels: number 0: found inf");
  points.row(2).setConstant(0.3);
  EXPECT_REX_ERROR(
      (void)calibratedCamera(points, truth.seen(points)),
      "camera calibration: found points that more than one camera sees so, wanted points that do not lie in "
      "one plane, or on one curve with the camera");
}

}  // namespace rex::camera_calibration_test
