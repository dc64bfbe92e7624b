#include "estimation/camera_calibration.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Projection = Eigen::Matrix<double, 3, 4>;
using Parameters = Eigen::VectorXd;  // the twelve numbers of P, row by row

Projection matrixOf(const Parameters& p) { return p.reshaped<Eigen::RowMajor>(3, 4); }

// Moves the middle of the points to zero, and scales them to a mean distance of sqrt(dimension).
Eigen::MatrixXd normalizing(const Eigen::MatrixXd& points) {
  const Eigen::Index n = points.rows();
  const Eigen::VectorXd middle = points.rowwise().mean();
  const double distance = (points.colwise() - middle).colwise().norm().mean();
  const double scale = distance > 0 ? std::sqrt(static_cast<double>(n)) / distance : 1;
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(n + 1, n + 1);
  T.diagonal().head(n) *= scale;
  T.col(n).head(n) = -scale * middle;
  return T;
}
Eigen::MatrixXd normalized(const Eigen::MatrixXd& T, const Eigen::MatrixXd& points) {
  return (T(0, 0) * points).colwise() + T.col(points.rows()).head(points.rows());
}

// Two rows of each point; p minimises |rows p| with |p| = 1.
Parameters linearTransform(const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels) {
  const Eigen::Index n = points.cols();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * n, 12);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector4d X(points(0, i), points(1, i), points(2, i), 1);
    for (int k = 0; k < 2; ++k) {
      rows.block<1, 4>(2 * i + k, 4 * k) = X.transpose();
      rows.block<1, 4>(2 * i + k, 8) = -pixels(k, i) * X.transpose();
    }
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows.transpose() * rows, Eigen::ComputeFullV);
  const Eigen::VectorXd& values = svd.singularValues();  // squares: noise of a pixel stays far above 1e-14
  if (values[10] <= 1e-12 * values[0])
    throw Error({.what = "camera calibration",
                 .found = "points that more than one camera sees so",
                 .wanted = "points that do not lie in one plane, or on one curve with the camera"});
  return svd.matrixV().col(11);
}

// Pixels of P minus those seen, and their derivatives with respect to P; false if a depth is zero.
bool residuals(const Parameters& p, const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels,
               Eigen::VectorXd& e, Eigen::MatrixXd& J) {
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector4d X(points(0, i), points(1, i), points(2, i), 1);
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

// J^T J, and a term that keeps the scale.
Eigen::MatrixXd curvature(const Eigen::MatrixXd& J, const Parameters& p) {
  Eigen::MatrixXd H = J.transpose() * J;
  H += p * p.transpose() * H.trace();
  return H;
}

// Levenberg-Marquardt steps in all twelve numbers, of which the scale has no effect.
bool refine(Parameters& p, const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels) {
  Eigen::VectorXd e(2 * points.cols()), next(e.size());
  Eigen::MatrixXd J(e.size(), 12), nextJ(e.size(), 12);
  if (!residuals(p, points, pixels, e, J)) return false;
  double damping = 1e-6;
  for (int i = 0; i < 100; ++i) {
    Eigen::MatrixXd H = curvature(J, p);
    H.diagonal() *= 1 + damping;
    const Eigen::VectorXd slope = J.transpose() * e, step = -H.ldlt().solve(slope);
    Parameters moved = p + step;
    moved.normalize();
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
  const double sign = P.leftCols<3>().determinant() > 0 ? -1 : 1, scale = P.row(2).head<3>().norm();
  camera.P = (sign / scale) * P;
  const Eigen::MatrixXd M = camera.P.leftCols<3>();
  const Eigen::Vector3d u = M.row(0), v = M.row(1), r3 = -M.row(2);
  // The zeros of K make the first row of R orthogonal to the last two of M.
  const Eigen::Vector3d r1 = v.cross(r3).normalized(), r2 = r3.cross(r1);
  camera.focal = {u.dot(r1), v.dot(r2)};
  camera.skew = u.dot(r2);
  camera.centre = {-u.dot(r3), -v.dot(r3)};
  camera.X_WC.R.col(0) = r1;
  camera.X_WC.R.col(1) = r2;
  camera.X_WC.R.col(2) = r3;
  const Eigen::VectorXd shift = camera.P.col(3), centre = M.colPivHouseholderQr().solve(shift);
  camera.X_WC.p = -centre;
}

Eigen::VectorXd numbersOf(const Parameters& p) {
  CameraCalibration camera;
  decompose(matrixOf(p), camera);
  Eigen::VectorXd numbers(6);
  numbers.head<3>() = camera.X_WC.p;
  numbers.segment<2>(3) = camera.focal;
  numbers[5] = camera.skew;
  return numbers;
}

// To first order, for independent noise of the pixels.
Eigen::Matrix<double, 6, 1> deviations(const Parameters& p, const Eigen::MatrixXd& J, double variance) {
  Eigen::MatrixXd D(6, 12);
  for (int i = 0; i < 12; ++i) {
    Parameters after = p, before = p;
    after[i] += 1e-7;
    before[i] -= 1e-7;
    D.col(i) = (numbersOf(after) - numbersOf(before)) / 2e-7;
  }
  const Eigen::VectorXd ofScale = D * p;
  D -= ofScale * p.transpose();  // a change of scale changes nothing
  const Eigen::MatrixXd Dt = D.transpose(), solved = curvature(J, p).ldlt().solve(Dt), C = D * solved;
  return (variance * C.diagonal()).cwiseMax(0).cwiseSqrt();
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
  const Eigen::MatrixXd T = normalizing(points), U = normalizing(pixels);
  const Eigen::Matrix3Xd X = normalized(T, points);
  const Eigen::Matrix2Xd x = normalized(U, pixels);

  Parameters p = linearTransform(X, x);
  Eigen::VectorXd e(2 * n);
  Eigen::MatrixXd J(2 * n, 12);
  // Of the pixels as they were given.
  const auto rms = [&] { return e.norm() / U(0, 0) / std::sqrt(static_cast<double>(n)); };
  CameraCalibration camera;
  if (residuals(p, X, x, e, J)) camera.initialRms = rms();
  camera.isRefined = refine(p, X, x);
  const Eigen::MatrixXd back = Eigen::Matrix3d(U).inverse(), fitted = matrixOf(p), P = back * fitted * T;
  decompose(P, camera);
  p = P.reshaped<Eigen::RowMajor>();
  p.normalize();
  residuals(p, points, pixels, e, J);
  camera.rms = e.norm() / std::sqrt(static_cast<double>(n));
  // Eleven numbers were fitted.
  const double variance = e.squaredNorm() / std::max<double>(1, 2. * static_cast<double>(n) - 11);
  camera.deviation = deviations(p, J, variance);
  return camera;
}

}  // namespace rex
