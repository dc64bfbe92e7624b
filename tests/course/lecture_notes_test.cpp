// What the lecturer's notes (notes/) say in numbers and formulas is computed here in another way. Numbers are
// formatted as they stand there, so that neither can change alone.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "course/linear_algebra.h"
#include "course/simulator.h"
#include "estimation/gaussian.h"
#include "geometry/rotation.h"
#include "kinematics/inverse_kinematics.h"
#include "kinematics/motion_profile.h"
#include "learning/policy_search.h"
#include "planning/car_curves.h"
#include "support/integral.h"
#include "support/lecture_note.h"
#include "support/matrix_product.h"

namespace rex::lecture_notes_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::HasSubstr;
constexpr double kPi = std::numbers::pi;

MatrixXd randomMatrix(int rows, int columns, Rng& rng) {
  return rng.normalVector(rows * columns).reshaped(rows, columns);
}
MatrixXd randomMetric(int size, Rng& rng) {
  const MatrixXd root = randomMatrix(size, size, rng);
  return root * root.transpose() + .1 * MatrixXd::Identity(size, size);
}

// Slide 6:33 takes the root of the determinant twice: the integral by a sum over a fine grid.
TEST(LectureNotes, TheDensityOfSlide633IsNotNormalised) {
  for (const double A : {0.3, 2.}) {
    double printed = 0, right = 0;
    for (double x = -20; x < 20; x += 1e-3) {
      const double bell = std::exp(-x * x / (2 * A)) * 1e-3, determinant = 2 * std::numbers::pi * A;
      right += bell / std::sqrt(determinant);
      printed += bell / std::sqrt(std::sqrt(determinant));
    }
    EXPECT_NEAR(right, 1, 1e-9);
    EXPECT_NEAR(printed, std::pow(2 * std::numbers::pi * A, 0.25), 1e-9);
  }
}

TEST(LectureNotes, MatrixEquations) {
  Rng rng(1);
  const MatrixXd A = randomMatrix(4, 4, rng), B = randomMatrix(4, 4, rng), C = randomMatrix(4, 4, rng);
  const MatrixXd I = MatrixXd::Identity(4, 4);
  const MatrixXd a = product({I - A.transpose(), inverse(A)});
  EXPECT_LT((a * A + A.transpose() - I).norm(), 1e-9);
  const MatrixXd b = product({inverse(C.transpose() - 2 * A), 2 * A, B});
  EXPECT_LT((product({b.transpose(), C}) - product({2 * A, b + B}).transpose()).norm(), 1e-9);
  const MatrixXd tall = randomMatrix(7, 4, rng), metric = randomMetric(4, rng);
  const VectorXd y = rng.normalVector(7);
  const VectorXd d = product({inverse(tall.transpose() * tall + metric), tall.transpose(), y}),
                 residual = tall * d - y;
  EXPECT_LT((product({residual.transpose(), tall}) + product({d.transpose(), metric})).norm(), 1e-9);
  // 12.1.2 e: the minimum, and that nothing near it is smaller.
  const MatrixXd weight = randomMetric(7, rng);
  const auto cost = [&](const VectorXd& x) -> double {
    const VectorXd e = tall * x - y;
    return e.dot(weight * e) + x.dot(metric * x);
  };
  const VectorXd best = product(
                     {inverse(tall.transpose() * weight * tall + metric), tall.transpose(), weight, y}),
                 fitted = tall * best;
  EXPECT_NEAR(cost(best), y.dot(weight * y) - y.dot(weight * fitted), 1e-9);
  for (int k = 0; k < 20; ++k) EXPECT_GT(cost(best + 1e-3 * rng.normalVector(4)), cost(best));
}

// What the notes on frames say of exponentials, digits, interpolation and Jacobians of directions.
TEST(LectureNotes, RotationsAndDirections) {
  Rng rng(6);
  const Eigen::Vector3d a = rng.normalVector(3).normalized(), u = rng.normalVector(3);
  const Eigen::Matrix3d K = skew(a), A = expSO3(rng.normalVector(3)), I = Eigen::Matrix3d::Identity();
  EXPECT_LT((K * K * K + K).norm(), 1e-12);
  EXPECT_LT((expSO3(0.7 * a) - I - std::sin(0.7) * K - (1 - std::cos(0.7)) * K * K).norm(), 1e-12);
  const Eigen::Vector3d turned = A * u;
  EXPECT_LT((A * expSO3(0.4 * u) - expSO3(0.4 * turned) * A).norm(), 1e-12);
  EXPECT_EQ(std::acos(1 - 0.9e-8 * 0.9e-8 / 2), 0);
  expectStated("00b-frames", "an angle below $10^{-8}$ vanishes altogether");
  // The rate of a unit quaternion at the angular velocity w, and that it is across the quaternion.
  const Quaternion q = quaternionFromRotation(A);
  const Eigen::Vector3d w = rng.normalVector(3);
  const Quaternion rate = 0.5 * quaternionProduct({0, w[0], w[1], w[2]}, q);
  const Quaternion later = quaternionFromRotation(expSO3(1e-6 * w) * A),
                   earlier = quaternionFromRotation(expSO3(-1e-6 * w) * A);
  EXPECT_LT(((later - earlier) / 2e-6 - rate).norm(), 1e-8);
  EXPECT_NEAR(rate.dot(q), 0, 1e-12);
  // Where the end of an arm points, by the axes of its joints: J_v = -[v]x J_w, of rank 2.
  const Simulator S("arm7.ors");
  const Eigen::Vector3d v = S.kinematicsVec("arm7");
  const MatrixXd Jv = S.jacobianVec("arm7");
  MatrixXd Jw(3, 7);
  for (int k = 0; k < 7; ++k) {
    Eigen::Matrix3d W;  // dR/dq_k, whose product with R^T is [a_k]x
    for (int i = 0; i < 3; ++i) W.col(i) = S.jacobianVec("arm7", Eigen::Vector3d::Unit(i)).col(k);
    const MatrixXd R = rotationFromQuaternion(S.kinematicsQuat("arm7"));
    const Eigen::Matrix3d wx = W * R.transpose();
    Jw.col(k) << wx(2, 1), wx(0, 2), wx(1, 0);
  }
  EXPECT_LT((Jv + skew(v) * Jw).norm(), 1e-12);
  EXPECT_LT(svd(Jv).s[2], 1e-12);
}

TEST(LectureNotes, StepsThatGainLessAndLess) {
  double x = 2;
  for (int k = 1; k < 60; ++k) {
    const double next = (k % 2 ? -1 : 1) * (1 + std::pow(2., -k));
    if (k < 50) {
      EXPECT_LT(next * next, x * x);
    }
    x = next;
  }
  EXPECT_NEAR(x * x, 1, 1e-12);
}

TEST(LectureNotes, GradientDescentInAValley) {
  // f = (x^2 + 100 y^2) / 2 with exact steps, from the worst start.
  Eigen::Vector2d x(100, 1);
  const Eigen::Vector2d curvature(1, 100);
  const auto f = [&] { return .5 * x.dot(curvature.cwiseProduct(x)); };
  double factor = 0;
  for (int k = 0; k < 20; ++k) {
    const double before = f();
    const Eigen::Vector2d gradient = curvature.cwiseProduct(x);
    x -= gradient * gradient.squaredNorm() / gradient.dot(curvature.cwiseProduct(gradient));
    const Eigen::Vector2d next = curvature.cwiseProduct(x);
    EXPECT_NEAR(gradient.dot(next) / gradient.norm() / next.norm(), 0, 1e-9) << "zigzag";
    factor = f() / before;
  }
  expectStated("00-basics", fmt::format("the factor is {:.4f}: {:.0f} steps for one decimal digit", factor,
                                        std::ceil(std::log(.1) / std::log(factor))));
}

TEST(LectureNotes, MethodsOfBothOrders) {
  // The heavy ball, x <- x - a g + b (x - last), with Polyak's constants, on each curvature of the valley.
  const double kappa = 100, root = std::sqrt(kappa), a = 4 / std::pow(1 + root, 2),
               b = std::pow((root - 1) / (root + 1), 2);
  double factor = 0;
  MatrixXd step(2, 2);
  for (double curvature = 1; curvature <= kappa; ++curvature) {
    step << 1 + b - a * curvature, -b, 1, 0;
    factor = std::max(factor, eigenvalues(step).cwiseAbs().maxCoeff());
  }
  EXPECT_NEAR(factor, (root - 1) / (root + 1), 1e-6);
  expectStated("00-basics", fmt::format("{:.3f} for $\\kappa = 100$, which is {:.0f} steps", factor,
                                        std::log(10) / (-2 * std::log(factor))));
  // Conjugate gradients in five dimensions.
  Rng rng(14);
  const MatrixXd A = randomMetric(5, rng);
  VectorXd g = rng.normalVector(5), d = -g;
  for (int k = 0; k < 5; ++k) {
    const double before = g.squaredNorm();
    EXPECT_GT(before, 1e-12) << k;
    const VectorXd y = product({A, d});
    g += before / d.dot(y) * y;
    d = g.squaredNorm() / before * d - g;
  }
  EXPECT_LT(g.norm(), 1e-8);
  // Newton's step, from differences of f.
  const auto f = [](double x) { return std::sqrt(1 + x * x); };
  const double x = 1.3, h = 1e-4;
  const double newton = -h / 2 * (f(x + h) - f(x - h)) / (f(x + h) - 2 * f(x) + f(x - h));
  EXPECT_NEAR(x + newton, -x * x * x, 1e-4);
}

TEST(LectureNotes, BoxesAndHosts) {
  // By counting equally likely cases: 12 of the script, and a box of 6.
  const double apple = .5 * 8 / 12 + .5 * 5 / 6, pooled = 13. / 18;
  EXPECT_DOUBLE_EQ(apple, .75);
  EXPECT_DOUBLE_EQ(.5 * 8 / 12 / apple, 4. / 9);
  expectStated("00-basics", fmt::format("$13/18 = {:.3f}$ and $8/13 = {:.3f}$", pooled, 8. / 13));
  // The host who guesses, by simulation.
  Rng rng(2);
  int empty = 0, mine = 0;
  for (int k = 0; k < 200000; ++k) {
    const int prize = rng.index(3), opened = 1 + rng.index(2);
    if (opened == prize) continue;
    ++empty;
    mine += prize == 0;
  }
  EXPECT_NEAR(static_cast<double>(mine) / empty, .5, .01);
  expectStated("00-basics", fmt::format("it is $1.01/1.02 = {:.3f}$", 1.01 / 1.02));
}

TEST(LectureNotes, ProofsAboutGaussians) {
  Rng rng(3);
  const VectorXd a = rng.normalVector(3), b = rng.normalVector(3), x = rng.normalVector(3),
                 f = rng.normalVector(3);
  const MatrixXd A = randomMetric(3, rng), B = randomMetric(3, rng), F = randomMatrix(3, 3, rng);
  const double logF = std::log(std::abs(F.determinant()));
  EXPECT_NEAR(logDensity({a, A}, x), logDensity({x, A}, a), 1e-9);
  EXPECT_NEAR(logDensity({a, A}, x), logF + logDensity({F * a, F * A * F.transpose()}, F * x), 1e-8);
  const MatrixXd back = inverse(F);
  EXPECT_NEAR(logDensity({a, A}, F * x + f),
              -logF + logDensity({product({back, a - f}), back * A * back.transpose()}, x), 1e-8);
  const MatrixXd C = inverse(inverse(A) + inverse(B));
  const VectorXd c = product({C, product({inverse(A), a}) + product({inverse(B), b})});
  EXPECT_NEAR(logDensity({a, A}, x) + logDensity({b, B}, x),
              logDensity({c, C}, x) + logDensity({b, A + B}, a), 1e-8);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(MatrixXd(A - C)).eigenvalues().minCoeff(), 0);
  // The precision that is left in x after integrating over y.
  const MatrixXd W = inverse(A), both = inverse(inverse(B) + F.transpose() * W * F),
                 left = W - product({W, F, both, F.transpose(), W});
  EXPECT_LT((left - inverse(A + F * B * F.transpose())).norm(), 1e-8);
}

TEST(LectureNotes, StepsOfInverseKinematics) {
  Rng rng(4);
  const MatrixXd J = randomMatrix(3, 7, rng), W = randomMetric(7, rng), C0 = randomMetric(3, rng);
  const VectorXd dy = rng.normalVector(3), a = rng.normalVector(7);
  // 12.4.1 a: the gradient vanishes.
  const VectorXd step = -product({inverse(J.transpose() * J + W), J.transpose(), dy});
  EXPECT_LT((product({W, step}) + product({J.transpose(), dy + J * step})).norm(), 1e-9);
  const MatrixXd S = J * inverse(W) * J.transpose(), I3 = MatrixXd::Identity(3, 3),
                 I7 = MatrixXd::Identity(7, 7);
  double last = 0;
  for (const double rho : {1., 1e2, 1e4, 1e6}) {
    const MatrixXd C = rho * C0, sharp = product({inverse(J.transpose() * C * J + W), J.transpose(), C});
    const MatrixXd loss = inverse(I3 + S * C);
    EXPECT_LT((I3 - J * sharp - loss).norm(), 1e-7 * loss.norm() + 1e-7);
    EXPECT_LT((product({J, I7 - sharp * J, a}) - product({loss, J, a})).norm(), 1e-7);
    last = (I3 - J * sharp).norm();
  }
  EXPECT_LT(last, 1e-4) << "12.4.1 b and c: the limit";
  // Without full row rank: b still holds, c does not.
  MatrixXd deficient = J;
  deficient.row(2) = deficient.row(0);
  const MatrixXd scaled = 1e6 * deficient.transpose(),
                 sharp = product({inverse(scaled * deficient + W), scaled});
  EXPECT_LT(product({deficient, I7 - sharp * deficient, a}).norm(), 1e-3);
  EXPECT_GT(product({I3 - deficient * sharp, Eigen::Vector3d(1, 0, -1)}).norm(), 1);
  // The share of a singular direction that a step leaves.
  expectStated("01-kinematics", fmt::format("one part in {:.0f} for $s = 0.5$", .5 * .5 / (.01 * .01)));
  MatrixXd one(1, 1);
  one << .5;
  EXPECT_NEAR(1 - .5 * inverseKinematicsStep(one, VectorXd::Ones(1), .01)[0], 1e-4 / (.25 + 1e-4), 1e-15);
}

TEST(LectureNotes, WeightedPriorities) {
  // The deviation of the first task in proportion to the ratio of the precisions, and strict priority as its
  // limit.
  Rng rng(5);
  const MatrixXd J1 = randomMatrix(2, 4, rng), J2 = randomMatrix(3, 4, rng);
  const VectorXd y1 = rng.normalVector(2), y2 = rng.normalVector(3);
  const auto deviation = [&](double ratio) {
    const MatrixXd H = ratio * product({J1.transpose(), J1}) + product({J2.transpose(), J2}) +
                       1e-9 * MatrixXd::Identity(4, 4);
    const VectorXd g = ratio * product({J1.transpose(), y1}) + product({J2.transpose(), y2}),
                   q = H.ldlt().solve(g);
    return (J1 * q - y1).norm();
  };
  EXPECT_NEAR(deviation(1e3) / deviation(1e4), 10, .2);
  EXPECT_NEAR(deviation(1e4) / deviation(1e5), 10, .02);
}

// 01: the lag of the hand behind a target on a line of T steps.
double lagOnLine(int T) {
  Simulator S("man.ors");
  const Eigen::Vector3d start = S.kinematicsPos("handR"), end(-.2, -.4, 1.1);
  double largest = 0;
  for (int t = 1; t <= T; ++t) {
    const Eigen::Vector3d wanted = start + static_cast<double>(t) / T * (end - start);
    S.setJointAngles(S.getJointAngles() +
                     inverseKinematicsStep(S.jacobianPos("handR"), wanted - S.kinematicsPos("handR"), .01));
    largest = std::max(largest, (S.kinematicsPos("handR") - wanted).norm());
  }
  return largest;
}

TEST(LectureNotes, TheLagOnTheLine) {
  const double slow = lagOnLine(200), fast = lagOnLine(100);
  expectStated("01-kinematics",
               fmt::format("With $T = 100$ the hand lags by at most {:.3f} mm, with $T = 200$ by {:.4f} mm",
                           1e3 * fast, 1e3 * slow));
}

// 12.3.1 b: w are the rotation vectors of two hands. At w = 0 their palms are opposite, their fingers alike.
TEST(LectureNotes, ParallelHands) {
  const auto map = [](int which) {
    return [which](const VectorXd& w) -> VectorXd {
      const Eigen::Matrix3d left = expSO3(w.head<3>()), right = expSO3(w.tail<3>());
      const Eigen::Vector3d a = left.col(0), b = -right.col(0);
      if (which == 0) return a + b;
      if (which == 1) return skew(a) * b;
      if (which == 2) return VectorXd::Constant(1, 1 + a.dot(b));
      VectorXd stacked(6);
      stacked << a + b, left.col(2) - right.col(2);
      return stacked;
    };
  };
  const VectorXd parallel = VectorXd::Zero(6), same = kPi * VectorXd::Unit(6, 2);
  EXPECT_LT(map(1)(same).norm(), 1e-15);
  EXPECT_NEAR(map(0)(same).norm(), 2, 1e-15);
  for (const auto& [which, rank] : {std::pair(0, 2), {1, 2}, {2, 0}, {3, 3}}) {
    EXPECT_LT(map(which)(parallel).norm(), 1e-15);
    EXPECT_EQ((svd(numericJacobian(map(which), parallel)).s.array() > 1e-6).count(), rank) << which;
  }
  // The Gauss-Newton step of the scalar product, for one hand that turns about the third axis.
  const VectorFunction scalar = [&](const VectorXd& x) { return map(2)(x[0] * VectorXd::Unit(6, 2)); };
  const VectorXd angle = VectorXd::Constant(1, .1);
  EXPECT_NEAR(scalar(angle)[0] / numericJacobian(scalar, angle)(0, 0), .05, 1e-4);
}

// 12.6.2 a: four seconds as in part 4 of 03. The largest angle, and the largest speed in the last second.
std::pair<double, double> held(Simulator S, const VectorXd& Kp, const VectorXd& Kd) {
  std::pair<double, double> largest(0, 0);
  for (int k = 0; k < 400; ++k) {
    if (k == 100) S.setJointAnglesAndVels(S.getJointAngles(), (S.getJointVels().array() + 1).matrix());
    const VectorXd q = S.getJointAngles(), v = S.getJointVels();
    largest.first = std::max(largest.first, q.cwiseAbs().maxCoeff());
    if (k >= 300) largest.second = std::max(largest.second, v.cwiseAbs().maxCoeff());
    S.stepDynamics(VectorXd(-Kp.cwiseProduct(q) - Kd.cwiseProduct(v)), .01);
  }
  return largest;
}

TEST(LectureNotes, ALongerArm) {
  Simulator arms[] = {Simulator("pegArm.ors"), Simulator("pegArm2.ors")};
  std::vector<double> bound, heaviest, gravity, ratio;
  MatrixXd M;
  for (Simulator& S : arms) {
    VectorXd F;
    S.getDynamics(M, F);
    const Eigen::Index n = F.size();
    const VectorXd s = svd(M).s, ones = VectorXd::Ones(n);
    bound.push_back(2 / .01 * s.minCoeff());
    heaviest.push_back(s.maxCoeff());
    gravity.push_back(std::abs(F[0]));
    EXPECT_LT(held(S, 50 * ones, .95 * bound.back() * ones).second, 1);
    EXPECT_GT(held(S, 50 * ones, 1.1 * bound.back() * ones).second, 50);
    MatrixXd loop = MatrixXd::Zero(2 * n, 2 * n);
    loop.topRightCorner(n, n).setIdentity();
    loop.bottomLeftCorner(n, n) = -50 * inverse(M);
    loop.bottomRightCorner(n, n) = -bound.back() * inverse(M);
    const Eigen::VectorXcd poles = eigenvalues(loop);
    Eigen::Index last = 0;  // of the slowest swing
    poles.real().maxCoeff(&last);
    ratio.push_back(-poles[last].real() / std::abs(poles[last]));
  }
  expectStated("03-dynamics",
               fmt::format("{:.2f} N m s for `pegArm` and {:.2f} for `pegArm2`", bound[0], bound[1]));
  expectStated("03-dynamics", fmt::format("{:.2f} and {:.2f} kg m^2, and gravity takes {:.1f} and {:.1f} N m",
                                          heaviest[0], heaviest[1], gravity[0], gravity[1]));
  expectStated("03-dynamics",
               fmt::format("a ratio of {:.2f} for the one arm, and of only {:.2f}", ratio[0], ratio[1]));
  VectorXd Kp(7), Kd(7);
  Kp << 160, 100, 80, 60, 40, 20, 4;
  Kd << 2, 2, 1, .6, .5, .9, 1;
  const double fastest = eigenvalues(product({inverse(M), MatrixXd(Kd.asDiagonal())})).cwiseAbs().maxCoeff();
  std::vector<int> within;
  for (const double noise : {1., 2., 4.}) {
    arms[1].setDynamicSimulationNoise(noise);
    within.push_back(0);
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      arms[1].setSeed(seed);
      within.back() += held(arms[1], Kp, Kd).first <= .6;
    }
  }
  expectStated(
      "03-dynamics",
      fmt::format("is {:.0f} of the 200 per second that $\\tau$ allows, and the arm stays within 0.6 "
                  "rad in {} of 50 runs with the noise and the push of part 4. With noise of strength 2, "
                  "it does so in {}, with strength 4, in {} runs",
                  fastest, within[0], within[1], within[2]));
}

TEST(LectureNotes, DirectionsAndDensities) {
  const auto share = [](int n) {
    const auto f = [&](double t) { return std::pow(std::sin(t), n - 2); };
    return integral(0, kPi / 9, f) / integral(0, kPi, f);
  };
  expectStated("04-rrt",
               fmt::format("this is {:.3f} in the plane, but {:.6f} in seven dimensions: one step in {:.0f}",
                           share(2), share(7), std::round(1 / share(7) / 100) * 100));
  // The density of the radius against the histogram of uniform angles.
  Rng rng(6);
  const double l1 = .7, l2 = .4, low = .6, high = .9;
  int inside = 0;
  for (int k = 0; k < 200000; ++k) {
    const double q2 = rng.uniform(-kPi, kPi), r = std::sqrt(l1 * l1 + l2 * l2 + 2 * l1 * l2 * std::cos(q2));
    inside += r > low && r < high;
  }
  const auto density = [&](double r) {
    const double cosine = (r * r - l1 * l1 - l2 * l2) / (2 * l1 * l2);
    return r / (kPi * l1 * l2 * std::sqrt(1 - cosine * cosine));
  };
  EXPECT_NEAR(inside / 200000., integral(low, high, density), .005);
  expectStated(
      "04-rrt",
      fmt::format("the mean is {:.1f} s; giving up after 1 s and starting again takes $1 / 0.9 = {:.2f}$ s",
                  .9 * 1 + .1 * 1000, 1 / .9));
}

// 12.7.2 in n pieces: the least sum of u^2 tau of piecewise constant forces that end d away from the drift.
double leastEffort(const Eigen::Vector2d& d, double T, int n = 2000) {
  MatrixXd effect(2, n);
  const double tau = T / n;
  for (int k = 0; k < n; ++k) effect.col(k) << tau * (T - (k + .5) * tau), tau;
  const VectorXd u = product({effect.transpose(), inverse(effect * effect.transpose()), d});
  return tau * u.squaredNorm();
}

TEST(LectureNotes, DistancesInPhaseSpace) {
  const auto between = [](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    return leastEffort({to[0] - from[0] - from[1], to[1] - from[1]}, 1);
  };
  expectStated("04-rrt",
               fmt::format("From $(0, 1)$ to $(1, 0)$ in one second it is {:.0f}; the other way it is {:.0f}",
                           between({0, 1}, {1, 0}), between({1, 0}, {0, 1})));
  expectStated("04-rrt", fmt::format("(from $(0, 1)$ to $(0, 1)$ in one second it is {:.0f})",
                                     between({0, 1}, {0, 1})));
  const double T = 1.7, d1 = .3, d2 = -.8;
  EXPECT_NEAR(leastEffort({d1, d2}, T), 12 / (T * T * T) * d1 * d1 - 12 / (T * T) * d1 * d2 + 4 / T * d2 * d2,
              1e-5);
  // With a price on time: by search over T.
  double best = 1e9, at = 0;
  for (double time = 1; time < 5; time += 1e-3)
    if (const double cost = time + leastEffort({1, 0}, time, 200); cost < best) best = cost, at = time;
  EXPECT_NEAR(at, std::sqrt(6), 3e-3);
  expectStated("04-rrt",
               fmt::format("For $D = 1$, $T^* = {:.3f}$ and the cost is {:.3f}", std::sqrt(6), best));
}

TEST(LectureNotes, CarsWithoutReverse) {
  expectStated("11-nonholonomic", "the length tends to $2 \\pi R$");
  EXPECT_NEAR(dubinsLength({0, 0, 0}, {-1e-6, 0, 0}, 3), 2 * kPi * 3, 1e-2);
  EXPECT_NEAR(dubinsLength({-1e-6, 0, 0}, {0, 0, 0}, 3), 1e-6, 1e-9);
  // Left, right, straight back.
  const double R = 5, delta = .01, s = R * std::acos(1 - delta / (2 * R));
  const double length = 2 * s + 2 * R * std::sin(s / R);
  EXPECT_NEAR(length, 4 * std::sqrt(R * delta), 2e-3);
  expectStated("11-nonholonomic", fmt::format("for $R$ = 5 m and 1 cm that is {:.3f} m", length));
  expectStated("11-nonholonomic", fmt::format("for $d$ = 2 m and 1 m/s in {:.2f} s", 2 * std::log(2)));
  // LSL reaches random poses.
  Rng rng(7);
  for (int k = 0; k < 100; ++k)
    EXPECT_TRUE(std::isfinite(dubinsLength({0, 0, 0}, 3 * rng.normalVector(3), 1)));
}

TEST(LectureNotes, ThePowerOfSeveralFeatures) {
  // The formula of 12.10.1 d, from samples, against the library; and the derivative of log pi.
  Rng rng(11);
  LinearGaussianPolicy policy{.beta = rng.normalVector(2), .Sigma = randomMetric(2, rng)};
  std::vector<Episode> episodes;
  MatrixXd matrix = MatrixXd::Zero(2, 2);
  VectorXd vector = VectorXd::Zero(2);
  for (int k = 0; k < 50; ++k) {
    Episode one{.features = randomMatrix(2, 4, rng),
                .noise = randomMatrix(2, 4, rng),
                .rewards = rng.uniformVector(4, 0, 1)};
    for (int t = 0; t < 4; ++t) {
      const VectorXd phi = one.features.col(t);
      const MatrixXd W = phi * phi.transpose() / phi.dot(policy.Sigma * phi);
      const double Q = one.rewards.tail(4 - t).sum();
      matrix += W * Q;
      vector += W * one.noise.col(t) * Q;
    }
    episodes.push_back(one);
  }
  EXPECT_LT((powerStep(policy, episodes, 1).beta - policy.beta - inverse(matrix) * vector).norm(), 1e-9);
  const VectorXd phi = rng.normalVector(2);
  const double action = .4, variance = phi.dot(policy.Sigma * phi);
  const auto logarithm = [&](const VectorXd& beta) -> VectorXd {
    return VectorXd::Constant(1, -std::pow(action - phi.dot(beta), 2) / (2 * variance));
  };
  const MatrixXd derivative = phi.transpose() * (action - phi.dot(policy.beta)) / variance;
  EXPECT_LT((numericJacobian(logarithm, policy.beta) - derivative).norm(), 1e-6);
  expectStated("08-mdp", fmt::format("for $\\gamma = 0.99$, {:.0f} times the change", .99 / (1 - .99)));
}

TEST(LectureNotes, TheNaturalGradient) {
  // Other features: M^T M g, and w as before.
  Rng rng(12);
  const double discount = .9;
  const MatrixXd M = randomMatrix(2, 2, rng), back = inverse(M.transpose());
  const LinearGaussianPolicy policy{.beta = rng.normalVector(2), .Sigma = randomMetric(2, rng)},
      same{.beta = back * policy.beta, .Sigma = back * policy.Sigma * back.transpose()};
  std::vector<Episode> episodes, changed;
  MatrixXd scores(2, 80);  // each times the root of its weight
  VectorXd Q(80);
  for (int k = 0; k < 20; ++k) {
    const Episode one{.features = randomMatrix(2, 4, rng),
                      .noise = randomMatrix(2, 4, rng),
                      .rewards = rng.normalVector(4)};
    episodes.push_back(one);
    changed.push_back({.features = M * one.features, .noise = back * one.noise, .rewards = one.rewards});
    double after = 0;
    for (int t = 3; t >= 0; --t) {
      after = one.rewards[t] + discount * after;
      const double root = std::pow(discount, .5 * t);
      scores.col(4 * k + t) = root * logGradients(policy, one).col(t);
      Q[4 * k + t] = root * after;
    }
  }
  const auto gradient = [&](const LinearGaussianPolicy& at, const std::vector<Episode>& trials) -> VectorXd {
    return reinforceGradient(at, trials, discount, Baseline::kNone).gradient;
  };
  const auto fisher = [&](const LinearGaussianPolicy& at, const std::vector<Episode>& trials) -> MatrixXd {
    return naturalGradient(at, trials, discount).fisher;
  };
  const VectorXd g = gradient(policy, episodes), w = solve(fisher(policy, episodes), g);
  EXPECT_LT(product({M.transpose(), gradient(same, changed) - M * g}).norm(), 1e-9);
  EXPECT_LT((product({M.transpose(), solve(fisher(same, changed), gradient(same, changed))}) - w).norm(),
            1e-9);
  expectStated("08-mdp", fmt::format("$(180/\\pi)^2 = {:.0f}$", std::pow(180 / kPi, 2)));
  // The fit of Q, by least squares; its errors do not change the gradient.
  EXPECT_LT((leastSquares(scores.transpose(), Q) - w).norm(), 1e-9);
  EXPECT_LT((product({scores, scores.transpose(), w}) / 20 - g).norm(), 1e-9);
  // The divergence of two normal densities, by its integral.
  const VectorXd phi = rng.normalVector(2), delta = rng.normalVector(2);
  const double variance = phi.dot(policy.Sigma * phi), shift = phi.dot(delta),
               reach = 12 * std::sqrt(variance);
  const auto difference = [&](double a) {
    return std::exp(-a * a / (2 * variance)) / std::sqrt(2 * kPi * variance) *
           (std::pow(a - shift, 2) - a * a) / (2 * variance);
  };
  EXPECT_NEAR(integral(-reach, reach, difference), shift * shift / (2 * variance), 1e-9);
}

TEST(LectureNotes, MotionProfiles) {
  const auto largest = [](const MotionProfile& profile, double ProfilePoint::*number) {
    double most = 0;
    for (int i = 0; i <= 100000; ++i) most = std::max(most, profileAt(profile, i / 1e5).*number);
    return most;
  };
  for (const double b : {0.1, 0.25, 0.5}) {
    EXPECT_NEAR(largest({ProfileShape::kTrapezoid, b}, &ProfilePoint::velocity), 1 / (1 - b), 1e-9);
    EXPECT_NEAR(largest({ProfileShape::kTrapezoid, b}, &ProfilePoint::acceleration), 1 / (b * (1 - b)), 1e-9);
  }
  const auto stated = [&](const char* formula, ProfileShape shape, double ProfilePoint::*number) {
    expectStated("02-pegInAHole", fmt::format("${} = {:.3f}$", formula, largest({shape}, number)));
  };
  stated("\\pi / 2", ProfileShape::kSine, &ProfilePoint::velocity);
  stated("\\pi^2 / 2", ProfileShape::kSine, &ProfilePoint::acceleration);
  stated("15 / 8", ProfileShape::kMinimumJerk, &ProfilePoint::velocity);
  stated("10 / \\sqrt 3", ProfileShape::kMinimumJerk, &ProfilePoint::acceleration);
  expectStated("02-pegInAHole", fmt::format("= {:.3f}$", std::sqrt(10 / std::sqrt(3) / 4)));
}

TEST(LectureNotes, LimitsAndFrames) {
  // Two joints within the margin, as one number and as one for each joint.
  const double m = .2;
  const VectorXd brackets = Eigen::Vector2d(.5, .1);
  const MatrixXd each = -MatrixXd::Identity(2, 2) / m, sum = each.colwise().sum();
  const VectorXd pooled = leastSquares(sum, VectorXd::Constant(1, -brackets.sum())),
                 single = leastSquares(each, -brackets);
  EXPECT_NEAR((brackets + each * pooled).cwiseMax(0).sum(), .2, 1e-12);
  EXPECT_LT((brackets + each * single).norm(), 1e-12);
  expectStated("02-pegInAHole", fmt::format("changes both angles by ${:.2f}$", pooled[1]));
  expectStated("02-pegInAHole",
               fmt::format("the second one becomes ${:.1f}$", (brackets + each * pooled)[1]));
  expectStated("02-pegInAHole", fmt::format("by ${:.1f}$ and ${:.2f}$", single[0], single[1]));
  // The Jacobian by the point of the frame that lies where the body's point is.
  Rng rng(13);
  Simulator S("man.ors");
  S.setJointAngles(rng.uniformVector(27, -1, 1));
  const Eigen::Vector3d v = rng.normalVector(3), w = rng.normalVector(3);
  const auto axes = [](const Simulator& at) {
    Eigen::Matrix3d R;
    for (int k = 0; k < 3; ++k) R.col(k) = at.kinematicsVec("waist", Eigen::Vector3d::Unit(k));
    return R;
  };
  S.anchorKinematicChainIn("rfoot");  // so that the waist moves
  const auto y = [&](const VectorXd& q) -> VectorXd {
    Simulator at = S;
    at.setJointAngles(q);
    return axes(at).transpose() * (at.kinematicsPos("handL", v) - at.kinematicsPos("waist", w));
  };
  const VectorXd q = S.getJointAngles();
  const Eigen::Vector3d inFrame = y(q) + w;
  const JacobianCheck checked = checkJacobian(
      y, axes(S).transpose() * (S.jacobianPos("handL", v) - S.jacobianPos("waist", inFrame)), q);
  EXPECT_TRUE(checked.ok) << checked.message;
}

TEST(LectureNotes, FallsAndSlips) {
  // A flood from the start of the cliff walk, 4 rows of 12 cells whose lowest is cliff but for its ends.
  MatrixXd steps = MatrixXd::Constant(4, 12, -1);
  steps(0, 0) = 0;
  for (int reached = 0; steps(0, 11) < 0; ++reached)
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 12; ++column)
        for (const auto& [up, right] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
          const int r = row + up, c = column + right;
          const bool isFree = r >= 0 && r < 4 && c >= 0 && c < 12 && (r > 0 || c == 0 || c == 11);
          if (steps(row, column) == reached && isFree && steps(r, c) < 0) steps(r, c) = reached + 1;
        }
  expectStated("17-rl", fmt::format("the shortest path, of {:g} steps", steps(0, 11)));
  const double random = .1, down = 1. / 4;
  expectStated("17-rl", fmt::format("about one fall for {:g} steps", 1 / (random * down)));
  expectStated("17-rl", fmt::format("still {:.0f} %", 100 * std::pow(1 - .2, 10)));
  double mistakes = 0;
  for (int t = 1; t <= 100; ++t) mistakes += 1 - std::pow(1 - .01, t);
  expectStated("17-rl", fmt::format("{:.1f} mistakes in 100 steps", mistakes));
}

TEST(LectureNotes, FewStepsFromRestToRest) {
  const auto cost = [](int T) {
    MatrixXd conditions(2, T);
    const double tau = 1. / T;
    for (int k = 1; k <= T; ++k) conditions.col(k - 1) << tau, tau * tau * (T - k + 1);
    const VectorXd a = product(
        {conditions.transpose(), inverse(conditions * conditions.transpose()), Eigen::Vector2d(0, 1)});
    return tau * a.squaredNorm();
  };
  EXPECT_NEAR(cost(7), 12 / (1 - 1. / 49), 1e-9);
  EXPECT_NEAR(integral(0, 1, [](double t) { return std::pow(6 - 12 * t, 2); }), 12, 1e-9);
  expectStated("12-trajectory",
               fmt::format("For 5 steps it is {:.1f}, for 20 steps {:.2f}", cost(5), cost(20)));
  expectStated("12-trajectory", fmt::format("{} 000 against {:.0f} million", 700 * 20 * 20 / 2 / 1000,
                                            std::pow(700, 3) / 6e6));
}

TEST(LectureNotes, PenaltiesAreNeverExact) {
  // The nearest point to 0 outside a disc of radius 1 around (.3, 0), along the axis: f = x^2, g = 1 - (x +
  // .3).
  const double lambda = 2 * .7;  // from 2 x - lambda = 0 at x = .7
  for (const double rho : {1e2, 1e4}) {
    const double x = rho * .7 / (1 + rho);  // of x^2 + rho (.7 - x)^2
    EXPECT_NEAR((.7 - x) * 2 * rho / lambda, 1, 2 / rho);
  }
  EXPECT_NEAR((.7001 * .7001 - .49) / 1e-4, lambda, 1e-3) << "the price";
}

TEST(LectureNotes, CostsThatGrowLessThanASquare) {
  const double c = 1.3;
  const auto cost = [&](const VectorXd& e) -> VectorXd {
    return VectorXd::Constant(1, e[0] * e[0] / (1 + e[0] * e[0] / (c * c)));
  };
  for (const double e : {.1, 1., 3 * c}) {
    const double weight = numericJacobian(cost, VectorXd::Constant(1, e))(0, 0) / (2 * e);
    EXPECT_NEAR(weight, std::pow(1 + e * e / (c * c), -2), 1e-6);
  }
  EXPECT_NEAR(std::pow(1 + 9., -2), .01, 1e-12) << "an error of 3 c counts a hundredth";
  const auto bend = [&](double e) {
    const double h = 1e-3;
    const auto at = [&](double x) { return cost(VectorXd::Constant(1, x))[0]; };
    return at(e - h) - 2 * at(e) + at(e + h);
  };
  EXPECT_GT(bend(.99 * c / std::sqrt(3)), 0);
  EXPECT_LT(bend(1.01 * c / std::sqrt(3)), 0);
}

}  // namespace rex::lecture_notes_test
