// The identities of share/doc/geometry.md by their numbers, with random numbers and without the functions of
// the library, whose own tests are elsewhere; those that give the same are compared in passing.
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/pose.h"
#include "geometry/rotation.h"

namespace rex::geometry_notes_test {

using Eigen::Matrix3d, Eigen::Matrix4d, Eigen::Vector3d, Eigen::Vector4d;

constexpr double kStep = 1e-5, kExact = 1e-12, kByDifferences = 1e-8;
const Vector3d e1 = Vector3d::UnitX(), e2 = Vector3d::UnitY(), e3 = Vector3d::UnitZ();

Vector3d randomVector(Rng& rng) { return rng.normalVector(3); }
Matrix3d Rx(double angle) { return Eigen::AngleAxisd(angle, e1).toRotationMatrix(); }
Matrix3d Ry(double angle) { return Eigen::AngleAxisd(angle, e2).toRotationMatrix(); }
Matrix3d Rz(double angle) { return Eigen::AngleAxisd(angle, e3).toRotationMatrix(); }
Matrix3d randomRotation(Rng& rng) {
  return Eigen::AngleAxisd(3 * rng.uniform(), randomVector(rng).normalized()).toRotationMatrix();
}

Matrix4d homogeneous(const Matrix3d& R, const Vector3d& p) {
  Matrix4d X = Matrix4d::Identity();
  X.topLeftCorner<3, 3>() = R;
  X.topRightCorner<3, 1>() = p;
  return X;
}

template <typename Matrix>
Matrix exponentialSeries(const Matrix& A) {
  Matrix sum = Matrix::Identity(), term = sum;
  for (int k = 1; k < 60; ++k) sum += term = term * A / k;
  return sum;
}

Matrix4d twistMatrix(const Vector3d& v, const Vector3d& w) {
  Matrix4d xi = Matrix4d::Zero();
  xi.topLeftCorner<3, 3>() = skew(w);
  xi.topRightCorner<3, 1>() = v;
  return xi;
}

template <typename Function>
auto derivative(Function f, double t) {
  return ((f(t + kStep) - f(t - kStep)) / (2 * kStep)).eval();
}

Vector3d vee(const Matrix3d& A) { return {A(2, 1), A(0, 2), A(1, 0)}; }

Vector4d product(const Vector4d& r, const Vector4d& s) {
  Vector4d result;
  result[0] = r[0] * s[0] - r.tail<3>().dot(s.tail<3>());
  result.tail<3>() = r[0] * s.tail<3>() + s[0] * r.tail<3>() + r.tail<3>().cross(s.tail<3>());
  return result;
}
Vector4d inverse(const Vector4d& r) { return Vector4d(r[0], -r[1], -r[2], -r[3]) / r.squaredNorm(); }
Vector4d pure(const Vector3d& v) { return {0, v[0], v[1], v[2]}; }
Vector4d fromAxis(double angle, const Vector3d& u) {
  Vector4d r;
  r << std::cos(angle / 2), std::sin(angle / 2) * u;
  return r;
}

TEST(GeometryNotes, N1To3FramesAndTheBook) {
  Rng rng(1);
  const Matrix3d R = randomRotation(rng), S = randomRotation(rng);
  const Vector3d p = randomVector(rng), q = randomVector(rng), point = randomVector(rng);
  const Matrix4d X = homogeneous(R, p), Y = homogeneous(S, q);
  EXPECT_LT(((X * point.homogeneous()).head<3>() - (R * point + p)).norm(), kExact);
  EXPECT_LT((X.inverse() - homogeneous(R.transpose(), -R.transpose() * p)).norm(), kExact);
  EXPECT_LT((((X * Y) * point.homogeneous()).head<3>() - (R * (S * point + q) + p)).norm(), kExact);
  const Matrix4d book = homogeneous(Rz(std::numbers::pi / 4), e1);
  EXPECT_LT(((book * Vector4d(1, 1, 0, 1)) - Vector4d(1, std::numbers::sqrt2, 0, 1)).norm(), kExact);
  EXPECT_LT(((book.inverse() * Vector4d(0, 1, 0, 1)) - Vector4d(0, std::numbers::sqrt2, 0, 1)).norm(),
            kExact);
}

TEST(GeometryNotes, N4To6RotationVectors) {
  Rng rng(2);
  for (int k = 0; k < 20; ++k) {
    const Matrix3d R = randomRotation(rng);
    const Vector3d v = randomVector(rng), w = randomVector(rng).normalized() * 3.1 * rng.uniform();
    const double theta = w.norm();
    EXPECT_LT((skew(w) * v - w.cross(v)).norm(), kExact);
    EXPECT_LT((skew(w) * skew(w) - (w * w.transpose() - theta * theta * Matrix3d::Identity())).norm(),
              kExact);
    EXPECT_LT((R * skew(w) * R.transpose() - skew(R * w)).norm(), kExact);
    const Matrix3d byAngle = Matrix3d::Identity() + std::sin(theta) / theta * skew(w) +
                             (1 - std::cos(theta)) / (theta * theta) * skew(w) * skew(w);
    EXPECT_LT((byAngle - exponentialSeries(skew(w))).norm(), 1e-11);
    EXPECT_LT((byAngle - expSO3(w)).norm(), kExact);
    EXPECT_NEAR(std::cos(theta), (byAngle.trace() - 1) / 2, kExact);
    EXPECT_LT((2 * std::sin(theta) * skew(w / theta) - (byAngle - byAngle.transpose())).norm(), kExact);
    const Vector3d u = w / theta, column = (expSO3(std::numbers::pi * u) + Matrix3d::Identity()).col(1);
    EXPECT_LT(column.cross(u).norm(), 1e-11);  // at a half turn
  }
}

TEST(GeometryNotes, N7To11VelocitiesAndQuaternions) {
  Rng rng(3);
  for (int k = 0; k < 20; ++k) {
    const Vector3d w0 = randomVector(rng), w1 = randomVector(rng), v = randomVector(rng);
    const auto R = [&](double t) -> Matrix3d { return expSO3(w0 * t) * expSO3(w1 * t * t); };
    const auto r = [&](double t) -> Vector4d {
      return product(fromAxis(t * w0.norm(), w0.normalized()), fromAxis(t * t * w1.norm(), w1.normalized()));
    };
    const double t = .3 + rng.uniform();
    const Matrix3d S = derivative(R, t) * R(t).transpose();
    const Vector3d omega = vee(S);
    EXPECT_LT((S + S.transpose()).norm(), kByDifferences);
    EXPECT_LT((R(t) * skew(R(t).transpose() * omega) - derivative(R, t)).norm(), kByDifferences);

    EXPECT_LT((rotationFromQuaternion(r(t)) - R(t)).norm(), kExact);  // R(r o s) = R(r) R(s)
    EXPECT_LT((rotationFromQuaternion(-r(t)) - R(t)).norm(), kExact);
    EXPECT_LT((product(product(r(t), pure(v)), inverse(r(t))) - pure(R(t) * v)).norm(), kExact);
    const Vector4d rate = derivative(r, t);
    EXPECT_LT((rate - product(pure(omega), r(t)) / 2).norm(), kByDifferences);
    EXPECT_LT((rate - product(r(t), pure(R(t).transpose() * omega)) / 2).norm(), kByDifferences);
    EXPECT_NEAR(r(t).dot(rate), 0, kByDifferences);

    Eigen::Matrix<double, 3, 4> axes;
    for (int i = 0; i < 4; ++i) axes.col(i) = 2 * product(Vector4d::Unit(i), inverse(r(t))).tail<3>();
    EXPECT_LT((axes * rate - omega).norm(), kByDifferences);
    EXPECT_LT((axes * r(t)).norm(), kExact);
    EXPECT_EQ(axes.fullPivLu().rank(), 3);

    const Vector4d a = fromAxis(2 * rng.uniform(), randomVector(rng).normalized());
    Vector4d b = fromAxis(2 * rng.uniform(), randomVector(rng).normalized());
    if (a.dot(b) < 0) b = -b;
    const double angle = std::acos(a.dot(b)), s = rng.uniform();
    const Vector4d between = (std::sin((1 - s) * angle) * a + std::sin(s * angle) * b) / std::sin(angle);
    const Matrix3d A = rotationFromQuaternion(a), B = rotationFromQuaternion(b);
    EXPECT_LT((rotationFromQuaternion(between) - A * expSO3(s * logSO3(A.transpose() * B))).norm(), 1e-10);
  }
}

TEST(GeometryNotes, N12And13EulerAngles) {
  Rng rng(4);
  for (int k = 0; k < 20; ++k) {
    const Vector3d at = 2 * randomVector(rng), rates = randomVector(rng);
    const auto omegaOf = [&](const auto& R) -> Vector3d {
      return vee(derivative(R, 0.) * R(0.).transpose());
    };
    const auto R313 = [&](double t) -> Matrix3d {
      const Vector3d x = at + t * rates;
      return Rz(x[0]) * Rx(x[1]) * Rz(x[2]);
    };
    Matrix3d E;
    E << e3, Rz(at[0]) * e1, Rz(at[0]) * Rx(at[1]) * e3;
    EXPECT_LT((E * rates - omegaOf(R313)).norm(), kByDifferences);
    EXPECT_NEAR(E.determinant(), -std::sin(at[1]), kExact);
    const auto R321 = [&](double t) -> Matrix3d {
      const Vector3d x = at + t * rates;
      return Rz(x[0]) * Ry(x[1]) * Rx(x[2]);
    };
    E << e3, Rz(at[0]) * e2, Rz(at[0]) * Ry(at[1]) * e1;
    EXPECT_LT((E * rates - omegaOf(R321)).norm(), kByDifferences);
    EXPECT_NEAR(E.determinant(), -std::cos(at[1]), kExact);
  }
}

TEST(GeometryNotes, N14To16MovingFrames) {
  Rng rng(5);
  for (int k = 0; k < 20; ++k) {
    const Vector3d w = randomVector(rng), v = randomVector(rng), a = randomVector(rng), b = randomVector(rng);
    const auto R = [&](double t) -> Matrix3d { return expSO3(w * t); };
    const auto origin = [&](double t) -> Vector3d { return v * t; };
    const auto attached = [&](double t) -> Vector3d { return origin(t) + R(t) * a; };
    const double t = rng.uniform();
    EXPECT_LT((derivative(attached, t) - (v + w.cross(attached(t) - origin(t)))).norm(), kByDifferences);
    const auto p = [&](double s) -> Vector3d { return a + b * s * s; };
    const auto forward = [&](double s) -> Vector3d { return R(s) * p(s); };
    const auto backward = [&](double s) -> Vector3d { return R(s).transpose() * p(s); };
    const Vector3d rate = 2 * b * t;
    EXPECT_LT((derivative(forward, t) - (R(t) * rate + w.cross(R(t) * p(t)))).norm(), kByDifferences);
    EXPECT_LT((derivative(backward, t) - R(t).transpose() * (rate - w.cross(p(t)))).norm(), kByDifferences);

    const double theta = w.norm();
    const Matrix3d V = Matrix3d::Identity() + (1 - std::cos(theta)) / (theta * theta) * skew(w) +
                       (theta - std::sin(theta)) / std::pow(theta, 3) * skew(w) * skew(w);
    const Matrix4d screw = exponentialSeries(twistMatrix(v, w));
    EXPECT_LT((screw - homogeneous(R(1), V * v)).norm(), 1e-10);
    const Pose same = expSE3((Vector6d() << v, w).finished());
    EXPECT_LT((screw - homogeneous(same.R, same.p)).norm(), 1e-10);
  }
}

// Hinges and sliders in turn, with random transforms between them.
struct Chain {
  std::vector<Matrix4d> fixed{};
  std::vector<Vector3d> axes{};  // in the joint's own frame
  static bool isHinge(std::size_t i) { return i % 2 == 0; }

  explicit Chain(Rng& rng) {
    for (int i = 0; i < 5; ++i) {
      fixed.push_back(homogeneous(randomRotation(rng), randomVector(rng)));
      axes.push_back(randomVector(rng).normalized());
    }
  }
  // The frames before the motion of each joint, and the end's.
  [[nodiscard]] std::vector<Matrix4d> frames(const Eigen::VectorXd& q) const {
    std::vector<Matrix4d> result;
    Matrix4d X = Matrix4d::Identity();
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      result.push_back(X = X * fixed[i]);
      const double x = q[static_cast<Eigen::Index>(i)];
      X = X * (isHinge(i) ? homogeneous(expSO3(axes[i] * x), Vector3d::Zero())
                          : homogeneous(Matrix3d::Identity(), axes[i] * x));
    }
    result.push_back(X);
    return result;
  }
};

TEST(GeometryNotes, N17And18ChainsAndExponentials) {
  Rng rng(6);
  const Chain chain(rng);
  const Vector3d point = randomVector(rng);
  const Eigen::VectorXd q = rng.normalVector(5), rest = Eigen::VectorXd::Zero(5);
  const auto frames = chain.frames(q), atRest = chain.frames(rest);
  const Vector3d p = (frames[5] * point.homogeneous()).head<3>(), v = frames[5].topLeftCorner<3, 3>() * point;
  Matrix4d exponentials = Matrix4d::Identity();
  for (std::size_t i = 0; i < 5; ++i) {
    const auto moved = [&](double x) -> Matrix4d {
      Eigen::VectorXd at = q;
      at[static_cast<Eigen::Index>(i)] += x;
      return chain.frames(at)[5];
    };
    const Matrix4d rate = derivative(moved, 0.);
    const Vector3d a = frames[i].topLeftCorner<3, 3>() * chain.axes[i],
                   p_i = frames[i].topRightCorner<3, 1>();
    const bool turns = Chain::isHinge(i);
    EXPECT_LT(((rate * point.homogeneous()).head<3>() - (turns ? a.cross(p - p_i) : a)).norm(),
              kByDifferences);
    EXPECT_LT((rate.topLeftCorner<3, 3>() * point - (turns ? a.cross(v) : Vector3d(0, 0, 0))).norm(),
              kByDifferences);
    const Vector3d b = atRest[i].topLeftCorner<3, 3>() * chain.axes[i], o = atRest[i].topRightCorner<3, 1>();
    const double x = q[static_cast<Eigen::Index>(i)];
    exponentials =
        exponentials * exponentialSeries<Matrix4d>(
                           x * (turns ? twistMatrix(-b.cross(o), b) : twistMatrix(b, Vector3d(0, 0, 0))));
  }
  EXPECT_LT((exponentials * atRest[5] - frames[5]).norm(), 1e-10);
}

TEST(GeometryNotes, N19And20ForwardRecursion) {
  Rng rng(7);
  const Chain chain(rng);
  const Eigen::VectorXd q0 = rng.normalVector(5), q1 = rng.normalVector(5), q2 = rng.normalVector(5);
  const auto frame = [&](std::size_t i, double t) { return chain.frames(q0 + q1 * t + q2 * t * t / 2)[i]; };
  const auto at = chain.frames(q0);
  // The frame of entry i belongs to the body before joint i; the first body rests.
  Vector3d w(0, 0, 0), dw = w, v = w, dv = w;
  for (std::size_t i = 0; i < 5; ++i) {
    const Vector3d a = at[i].topLeftCorner<3, 3>() * chain.axes[i];
    const double rate = q1[static_cast<Eigen::Index>(i)], acceleration = q2[static_cast<Eigen::Index>(i)];
    const Vector3d r = (at[i + 1] - at[i]).topRightCorner<3, 1>();
    if (Chain::isHinge(i)) {  // the next frame moves with the body behind the hinge
      dw += w.cross(a * rate) + a * acceleration;
      w += a * rate;
      v += w.cross(r);
      dv += dw.cross(r) + w.cross(w.cross(r));
    } else {
      v += w.cross(r) + a * rate;
      dv += dw.cross(r) + w.cross(w.cross(r)) + a * acceleration + 2 * w.cross(a * rate);
    }
    const auto position = [&](double t) -> Vector3d { return frame(i + 1, t).topRightCorner<3, 1>(); };
    constexpr double h = 1e-3;
    const Vector3d second =
        (-position(2 * h) + 16 * position(h) - 30 * position(0) + 16 * position(-h) - position(-2 * h)) /
        (12 * h * h);
    EXPECT_LT((derivative(position, 0.) - v).norm(), kByDifferences) << i;
    EXPECT_LT((second - dv).norm(), 1e-6) << i;
    const auto R = [&](double t) -> Matrix3d { return frame(i + 1, t).topLeftCorner<3, 3>(); };
    EXPECT_LT((vee(derivative(R, 0.) * R(0).transpose()) - w).norm(), kByDifferences) << i;
  }
}

}  // namespace rex::geometry_notes_test
