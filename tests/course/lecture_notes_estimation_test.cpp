// The same as lecture_notes_test.cpp for what the notes say about filters, maps and cameras.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "course/linear_algebra.h"
#include "course/vision_simulator.h"
#include "estimation/resampling.h"
#include "geometry/rotation.h"
#include "support/integral.h"
#include "support/lecture_note.h"

namespace rex::lecture_notes_estimation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double kPi = std::numbers::pi;

TEST(LectureNotesOnEstimation, TheMeanOfACloud) {
  Rng rng(8);
  const int n = 40, samples = 20000;
  const double v = .1, turn = .1, sigma = .2;
  Eigen::Vector2d mean(0, 0), closed(0, 0);
  for (int k = 0; k < samples; ++k) {
    double heading = 0;
    for (int t = 0; t < n; ++t) {
      mean += v * Eigen::Vector2d(std::cos(heading), std::sin(heading)) / samples;
      heading += turn + sigma * rng.normal();
    }
  }
  for (int t = 0; t < n; ++t)
    closed += v * std::exp(-t * sigma * sigma / 2) * Eigen::Vector2d(std::cos(t * turn), std::sin(t * turn));
  EXPECT_LT((mean - closed).norm(), .02);
  // The width across a straight way.
  double square = 0;
  for (int k = 0; k < samples; ++k) {
    double heading = 0, across = 0;
    for (int t = 0; t < 200; ++t) across += v * (heading += .001 * rng.normal());
    square += across * across / samples;
  }
  EXPECT_NEAR(std::sqrt(square) / (v * .001 * std::sqrt(200. * 200 * 200 / 3)), 1, .03);
}

TEST(LectureNotesOnEstimation, VariancesOfResampling) {
  const Eigen::Vector3d weights(.55, .25, .2);
  Rng rng(9);
  const auto variances = [&](Resampling how) {
    const int runs = 200000;
    Eigen::Vector3d square(0, 0, 0);
    for (int k = 0; k < runs; ++k) {
      Eigen::Vector3d children(0, 0, 0);
      for (const int parent : resampled(weights, 10, how, rng)) children[parent] += 1;
      square += (children - 10 * weights).cwiseAbs2() / runs;
    }
    return square;
  };
  const Eigen::Vector3d multinomial = variances(Resampling::kMultinomial),
                        residual = variances(Resampling::kResidual);
  EXPECT_LT((multinomial - Eigen::Vector3d(2.475, 1.875, 1.6)).cwiseAbs().maxCoeff(), .03);
  EXPECT_LT((residual - Eigen::Vector3d(.25, .25, 0)).cwiseAbs().maxCoeff(), .005);
  expectStated("05-car", "the variances 2.475, 1.875 and 1.6, residual resampling 0.25, 0.25 and 0");
  // Until all descend from one.
  double rounds = 0;
  const int N = 50, runs = 300;
  for (int k = 0; k < runs; ++k) {
    std::vector<int> origin(N);
    for (int i = 0; i < N; ++i) origin[static_cast<std::size_t>(i)] = i;
    while (std::set<int>(origin.begin(), origin.end()).size() > 1) {
      std::vector<int> next;
      for (const int parent : resampled(VectorXd::Ones(N), N, Resampling::kMultinomial, rng))
        next.push_back(origin[static_cast<std::size_t>(parent)]);
      origin = next;
      rounds += 1. / runs;
    }
  }
  EXPECT_NEAR(rounds / (2 * N), 1, .15);
}

TEST(LectureNotesOnEstimation, EffectiveShares) {
  const auto share = [](double r) {
    const auto prior = [](double x) { return std::exp(-x * x / 2) / std::sqrt(2 * kPi); };
    const auto weight = [&](double x) { return std::exp(-x * x / (2 * r * r)); };
    const double first = integral(-9, 9, [&](double x) { return prior(x) * weight(x); });
    return first * first / integral(-9, 9, [&](double x) { return prior(x) * weight(x) * weight(x); });
  };
  expectStated("05-car",
               fmt::format("which is {:.3f} for $r = s$ and {:.3f} for $r = s / 10$", share(1), share(.1)));
  expectStated("05-car", fmt::format("$20 \\cdot 20 \\cdot 18 = {}$ cells", 20 * 20 * 18));
  EXPECT_NEAR(7200. * 7200 / 5e7, 1, .05);
}

TEST(LectureNotesOnEstimation, FiltersAndMaps) {
  // The car of the sheet, one step: turn by the model and by x + B u.
  const double L = 2, v = .1, steer = .2;
  expectStated("06-kalmanSLAM",
               fmt::format("it turns by {:.5f} rad per step instead of {:.5f}",
                           std::tan(steer) / L * v + v / (L * std::pow(std::cos(steer), 2)) * steer,
                           v / L * std::tan(steer)));
  // A landmark seen n times from an uncertain start, as a product of Gaussians.
  const double P0 = .7, r = .3;
  const int n = 25;
  Eigen::Matrix2d precision;  // of the start and the landmark
  precision << 1 / P0 + n / r, -n / r, -n / r, n / r;
  EXPECT_NEAR(inverse(precision)(1, 1), P0 + r / n, 1e-12);
  expectStated("06-kalmanSLAM", fmt::format("$g = {:.2f}$ accepts 99 %", -2 * std::log(.01)));
  expectStated("06-kalmanSLAM", fmt::format("$1 - 0.99^{{300}} = {:.3f}$", 1 - std::pow(.99, 300)));
  // 12.13.1: the derivatives of the view.
  Rng rng(10);
  const VectorXd z = rng.normalVector(5);  // position, heading, landmark
  const auto view = [](const VectorXd& at) -> VectorXd {
    return Eigen::Rotation2Dd(at[2]).inverse() * Eigen::Vector2d(at.tail<2>() - at.head<2>());
  };
  const Eigen::Matrix2d back = Eigen::Rotation2Dd(-z[2]).toRotationMatrix();
  Eigen::Matrix2d quarter;
  quarter << 0, -1, 1, 0;
  MatrixXd J(2, 5);
  J << -back, -quarter * back * (z.tail<2>() - z.head<2>()), back;
  EXPECT_LT((J - numericJacobian(view, z)).norm(), 1e-7);
}

TEST(LectureNotesOnEstimation, CertainCellsAndRays) {
  const auto scansToTurn = [](int passed, double bound) {
    double odds = 0;
    for (int k = 0; k < passed; ++k) odds = std::max(odds - .6, -bound);
    int count = 0;
    for (; odds <= 1e-9; ++count) odds += 1.5;
    return count;
  };
  ASSERT_EQ(scansToTurn(1000, 6), 5);
  expectStated("18-gridSLAM", "five that end in it make it a wall");
  expectStated("18-gridSLAM", fmt::format("a hundred that passed would need {}", scansToTurn(100, 1e9)));
  const auto density = [](double off) { return std::pow(std::exp(-off * off / (2 * .15 * .15)), 45); };
  const double ratio = density(.10) / density(.12);
  expectStated("18-gridSLAM", fmt::format("{:.0f} times as likely; divided by 6 it is {:.1f} times", ratio,
                                          std::pow(ratio, 1. / 6)));
}

// The two equations of the direct linear transform for each point, in the numbers of P row by row.
MatrixXd linearEquations(const Eigen::Matrix4Xd& points, const Eigen::Matrix3Xd& pixels) {
  MatrixXd A = MatrixXd::Zero(2 * points.cols(), 12);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (int k = 0; k < 2; ++k) {
      A.block<1, 4>(2 * i + k, 4 * k) = points.col(i).transpose();
      A.block<1, 4>(2 * i + k, 8) = -pixels(k, i) * points.col(i).transpose();
    }
  return A;
}

TEST(LectureNotesOnEstimation, WhatACameraSees) {
  VisionSimulator simulator(3);
  const Eigen::Matrix<double, 3, 4> P = simulator.getProjection();
  const Eigen::Matrix4Xd points = simulator.getRandomWorldPoints(30);
  const Eigen::Matrix3Xd pixels = simulator.projectWorldPoints(points, 1), seen = P * points;
  // Errors of the linear equations are those in pixels times the depth.
  const VectorXd p = P.reshaped<Eigen::RowMajor>(), algebraic = linearEquations(points, pixels) * p;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector2d e = seen.col(i).hnormalized() - pixels.col(i).head<2>();
    EXPECT_LT((algebraic.segment<2>(2 * i) - seen(2, i) * e).norm(), 1e-9);
  }
  // The corners of the cube, from there and from 1 % farther away with a longer lens.
  const Pose& X_WC = simulator.getCameraPose();
  const double distance = X_WC.p.norm();
  double depth = 0, shift = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d X(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1),
        p_C = X_WC.R.transpose() * (X - X_WC.p), back = p_C - .01 * distance * Eigen::Vector3d::UnitZ();
    depth = std::max(depth, std::abs(-p_C.z() / distance - 1));
    const double focal = 200 / std::tan(6 * kPi / 180);
    shift = std::max(shift, focal * (p_C.head<2>() / p_C.z() - 1.01 * back.head<2>() / back.z()).norm());
  }
  expectStated("15-graphSLAM", fmt::format("is {:.1f} m away", distance));
  expectStated("15-graphSLAM", fmt::format("at most {:.1f} %, the weights by {:.0f} %", 100 * depth,
                                           100 * (std::pow(1 + depth, 2) - 1)));
  expectStated("15-graphSLAM", fmt::format("is {:.0f} cm farther away", distance));
  expectStated("15-graphSLAM", fmt::format("moves by more than {:.2f} pixels", shift));
  // A plane leaves three numbers free besides the scale.
  Eigen::Matrix4Xd flat = points;
  const Eigen::RowVector4d n(.3, -.2, 1, .1);
  flat.row(2) = -(n[0] * flat.row(0) + n[1] * flat.row(1)).array() - n[3];
  const VectorXd values = svd(linearEquations(flat, simulator.projectWorldPoints(flat, 0))).s;
  EXPECT_LT(values[8], 1e-9 * values[0]);
  EXPECT_GT(values[7], 1e-6 * values[0]);
  // A chessboard, and the lens from P.
  Eigen::Matrix3d K;
  K << 900, 8, 310, 0, 950, 240, 0, 0, 1;
  const Eigen::Matrix3d R = rotation(1, Eigen::Vector3d(1, 2, 3)).R, W = (K * K.transpose()).inverse(),
                        H = 3 * K *
                            (Eigen::Matrix3d() << R.leftCols<2>(), Eigen::Vector3d(1, 2, 9)).finished();
  EXPECT_NEAR(H.col(0).dot(W * H.col(1)), 0, 1e-9);
  EXPECT_NEAR(H.col(0).dot(W * H.col(0)), H.col(1).dot(W * H.col(1)), 1e-9);
  const Eigen::Matrix3d M = K * R.transpose(), turned = (M * M.transpose()).reverse(),
                        L = Eigen::LLT<Eigen::Matrix3d>(turned).matrixL();
  EXPECT_LT((Eigen::Matrix3d(L.reverse()) - K).norm(), 1e-9);
}

}  // namespace rex::lecture_notes_estimation_test
