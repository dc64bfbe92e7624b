#include "estimation/camera_calibration.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Projection = Eigen::Matrix<double, 3, 4>;
using Parameters = Eigen::Matrix<double, 12, 1>;  // P row by row

// Moves the middle of the points to zero, and scales them to a mean distance of sqrt(dimension).
template <int N>
Eigen::Matrix<double, N + 1, N + 1> normalizing(const Eigen::Matrix<double, N, Eigen::Dynamic>& points) {
  const Eigen::Matrix<double, N, 1> middle = points.rowwise().mean();
  const double distance = (points.colwise() - middle).colwise().norm().mean();
  const double scale = distance > 0 ? std::sqrt(static_cast<double>(N)) / distance : 1;
  Eigen::Matrix<double, N + 1, N + 1> T = Eigen::Matrix<double, N + 1, N + 1>::Identity();
  T.template topLeftCorner<N, N>() *= scale;
  T.template topRightCorner<N, 1>() = -scale * middle;
  return T;
}

// Two rows of each point; P minimises |rows p| with |p| = 1.
Projection linearTransform(const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels) {
  const Eigen::Index n = points.cols();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * n, 12);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::RowVector4d X = points.col(i).homogeneous().transpose();
    for (int k = 0; k < 2; ++k) {
      rows.block<1, 4>(2 * i + k, 4 * k) = X;
      rows.block<1, 4>(2 * i + k, 8) = -pixels(k, i) * X;
    }
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows.transpose() * rows, Eigen::ComputeFullV);
  const Eigen::VectorXd& values = svd.singularValues();  // squares: noise of a pixel stays far above 1e-14
  if (values[10] <= 1e-12 * values[0])
    throw Error({.what = "camera calibration",
                 .found = "points that more than one camera sees so",
                 .wanted = "points that do not lie in one plane, or on one curve with the camera"});
  return svd.matrixV().col(11).reshaped<Eigen::RowMajor>(3, 4);
}

// Pixels of P minus those seen, and their derivatives with respect to P; false if a depth is zero.
bool residuals(const Parameters& p, const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels,
               Eigen::VectorXd& e, Eigen::MatrixXd& J) {
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector4d X = points.col(i).homogeneous();
    const double depth = X.dot(p.tail<4>());
    if (!(std::abs(depth) > 0)) return false;
    for (int k = 0; k < 2; ++k) {
      const double pixel = X.dot(p.segment<4>(4 * k)) / depth;
      e[2 * i + k] = pixel - pixels(k, i);
      J.row(2 * i + k).setZero();
      J.block<1, 4>(2 * i + k, 4 * k) = X.transpose() / depth;
      J.block<1, 4>(2 * i + k, 8) = -pixel / depth * X.transpose();
    }
  }
  return true;
}

// Levenberg-Marquardt steps in all twelve numbers, of which the scale has no effect.
bool refine(Parameters& p, const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels) {
  Eigen::VectorXd e(2 * points.cols()), next(e.size());
  Eigen::MatrixXd J(e.size(), 12), nextJ(e.size(), 12);
  if (!residuals(p, points, pixels, e, J)) return false;
  double damping = 1e-6;
  for (int i = 0; i < 100; ++i) {
    Eigen::MatrixXd H = J.transpose() * J;
    H += p * p.transpose() * H.trace();  // keeps the scale
    H.diagonal() *= 1 + damping;
    const Parameters step = -H.ldlt().solve(J.transpose() * e);
    const Parameters moved = (p + step).normalized();
    if (residuals(moved, points, pixels, next, nextJ) && next.squaredNorm() <= e.squaredNorm()) {
      const bool isDone =
          step.norm() < 1e-12 || e.squaredNorm() - next.squaredNorm() < 1e-14 * e.squaredNorm();
      p = moved, e = next, J = nextJ;
      if (isDone) return true;
      damping /= 10;
    } else {
      if (step.norm() < 1e-12) return true;
      damping *= 10;
    }
  }
  return false;
}

// M = K D R with K upper triangular and positive on its diagonal, D = diag(1, 1, -1) for a camera that looks
// along -z, and R a rotation. The sign of M is free.
void decompose(const Projection& P, CameraCalibration& camera) {
  Projection signedP = P;
  if (P.leftCols<3>().determinant() > 0) signedP = -P;
  const Eigen::Matrix3d M = signedP.leftCols<3>();
  // RQ by QR of the matrix with its rows in reverse order.
  const Eigen::HouseholderQR<Eigen::Matrix3d> qr(M.colwise().reverse().transpose());
  const Eigen::Matrix3d upper = qr.matrixQR().triangularView<Eigen::Upper>();
  Eigen::Matrix3d K = upper.transpose().colwise().reverse().rowwise().reverse();
  Eigen::Matrix3d Q = Eigen::Matrix3d(qr.householderQ()).transpose().colwise().reverse();
  for (int i = 0; i < 3; ++i)
    if (K(i, i) < 0) K.col(i) *= -1, Q.row(i) *= -1;
  const double scale = K(2, 2);
  K /= scale;
  camera.P = signedP / scale;
  camera.focal = {K(0, 0), K(1, 1)};
  camera.skew = K(0, 1);
  camera.centre = K.topRightCorner<2, 1>();
  Q.row(2) *= -1;
  camera.X_WC.R = Q.transpose();
  camera.X_WC.p = -M.partialPivLu().solve(signedP.col(3));
}

Eigen::Matrix<double, 6, 1> numbersOf(const Parameters& p) {
  CameraCalibration camera;
  decompose(p.reshaped<Eigen::RowMajor>(3, 4), camera);
  Eigen::Matrix<double, 6, 1> numbers;
  numbers << camera.X_WC.p, camera.focal, camera.skew;
  return numbers;
}

// To first order, for independent noise of the pixels.
Eigen::Matrix<double, 6, 1> deviations(const Parameters& p, const Eigen::MatrixXd& J, double variance) {
  Eigen::MatrixXd H = J.transpose() * J;
  H += p * p.transpose() * H.trace();
  Eigen::Matrix<double, 6, 12> D;
  for (int i = 0; i < 12; ++i) {
    Parameters step = Parameters::Zero();
    step[i] = 1e-7;
    D.col(i) = (numbersOf(p + step) - numbersOf(p - step)) / 2e-7;
  }
  D -= D * p * p.transpose();  // a change of scale changes nothing
  return (variance * D * H.ldlt().solve(D.transpose())).diagonal().cwiseMax(0).cwiseSqrt();
}

}  // namespace

CameraCalibration calibratedCamera(const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels) {
  const Eigen::Index n = points.cols();
  if (n < 6 || pixels.cols() != n)
    throw Error({.what = "camera calibration",
                 .found = fmt::format("{} points and {} pixels", n, pixels.cols()),
                 .wanted = "as many pixels as points, at least 6"});
  requireFinite("camera calibration: points", points.reshaped());
  requireFinite("camera calibration: pixels", pixels.reshaped());
  const Eigen::Matrix4d T = normalizing<3>(points);
  const Eigen::Matrix3d U = normalizing<2>(pixels);
  const Eigen::Matrix3Xd X = (T * points.colwise().homogeneous()).topRows<3>();
  const Eigen::Matrix2Xd x = (U * pixels.colwise().homogeneous()).topRows<2>();

  Parameters p;
  p = linearTransform(X, x).reshaped<Eigen::RowMajor>();
  Eigen::VectorXd e(2 * n);
  Eigen::MatrixXd J(2 * n, 12);
  // Of the pixels as they were given.
  const auto rms = [&] { return e.norm() / U(0, 0) / std::sqrt(static_cast<double>(n)); };
  CameraCalibration camera;
  if (residuals(p, X, x, e, J)) camera.initialRms = rms();
  camera.isRefined = refine(p, X, x);
  const Projection P = U.inverse() * p.reshaped<Eigen::RowMajor>(3, 4) * T;
  decompose(P, camera);
  p = P.normalized().reshaped<Eigen::RowMajor>();
  residuals(p, points, pixels, e, J);
  camera.rms = e.norm() / std::sqrt(static_cast<double>(n));
  // Eleven numbers were fitted.
  const double variance = e.squaredNorm() / std::max<double>(1, 2. * static_cast<double>(n) - 11);
  camera.deviation = deviations(p, J, variance);
  return camera;
}

}  // namespace rex
