// The same as lecture_notes_test.cpp for what the notes say about dynamics, control, walking, grasps and
// graphs.
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <set>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "control/controllability.h"
#include "control/predictive_controller.h"
#include "control/regulators.h"
#include "control/riccati.h"
#include "control/stability.h"
#include "course/linear_algebra.h"
#include "course/simulator.h"
#include "locomotion/compass_gait.h"
#include "locomotion/limit_cycle.h"
#include "support/lecture_note.h"
#include "support/matrix_product.h"
#include "systems/cart_pole.h"
#include "systems/racer.h"

namespace rex::lecture_notes_control_test {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::RowVector4d;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;
using Complex = std::complex<double>;

// Damping ratio of a step matrix for a mode, from its eigenvalues.
double dampingOf(const Matrix2d& step) {
  const Complex z = Eigen::EigenSolver<MatrixXd>(MatrixXd(step)).eigenvalues()[0], s = std::log(z);
  return -s.real() / std::abs(s);
}

TEST(LectureNotesOnControl, DampingOfEulerSteps) {
  for (const double xi : {0., .2, .7}) {
    const double a = 1e-3;  // tau / lambda
    Matrix2d plain, semi;
    plain << 1, a, -a, 1 - 2 * xi * a;
    semi << 1 - a * a, a * (1 - 2 * xi * a), -a, 1 - 2 * xi * a;
    EXPECT_NEAR((dampingOf(plain) - xi) / (-a / 2 * (1 - xi * xi)), 1, 5e-3);
    EXPECT_NEAR(dampingOf(semi) - xi, a / 2 * xi * xi, 1e-6);
    EXPECT_NEAR(semi.determinant(), 1 - 2 * xi * a, 1e-12);
  }
}

TEST(LectureNotesOnControl, TheLimitOfTheIntegral) {
  const double m = 2, Kp = 3, Kd = .5;
  const auto stable = [&](double Ki) {
    Eigen::Matrix3d A;
    A << 0, 1, 0, 0, 0, 1, -Ki / m, -Kp / m, -Kd / m;
    return continuousStability(A).rate < 0;
  };
  EXPECT_TRUE(stable(.999 * Kp * Kd / m));
  EXPECT_FALSE(stable(1.001 * Kp * Kd / m));
}

TEST(LectureNotesOnControl, AWrongModel) {
  Rng rng(1);
  const double delta = .2, lambda = .3, xi = .8;
  const MatrixXd root = rng.normalVector(9).reshaped(3, 3),
                 M = root * root.transpose() + MatrixXd::Identity(3, 3);
  const VectorXd F = rng.normalVector(3), wanted = rng.normalVector(3);
  const VectorXd u = (1 + delta) * (product({M, wanted}) + F), unloaded = product({inverse(M), F});
  EXPECT_LT((product({inverse(M), u - F}) - (1 + delta) * wanted - delta * unloaded).norm(), 1e-9);
  // At rest: q'' = -e / lambda^2 is what it wants, and nothing moves.
  const VectorXd e = delta / (1 + delta) * lambda * lambda * unloaded;
  EXPECT_LT(((1 + delta) * (product({M, -e / (lambda * lambda)}) + F) - F).norm(), 1e-9);
  const double Kp = 1.2 / (lambda * lambda), Kd = 1.2 * 2 * xi / lambda;
  expectStated(
      "03-dynamics",
      fmt::format("the factor $1 / \\sqrt{{1.2}} = {:.3f}$ and $\\xi$ grows by $\\sqrt{{1.2}} = {:.3f}$",
                  1 / std::sqrt(Kp) / lambda, Kd / (2 * std::sqrt(Kp)) / xi));
  // The torque near a singular posture is largest at s = sqrt(H / C).
  const double C = 50, H = .02;
  double largest = 0;
  for (double s = 1e-4; s < 1; s += 1e-4) largest = std::max(largest, s * C / (s * s * C + H));
  EXPECT_NEAR(largest, std::sqrt(C) / (2 * std::sqrt(H)), 1e-2);
}

// The cart pole of the script, and u = K x of minimal cost.
struct BalancedPole {
  LinearizedPlant plant = CartPoleDynamics{}.linearized(Vector4d::Zero(), 0);
  MatrixXd Q = Vector4d(1, 0, 1, 0).asDiagonal();
  RiccatiResult care = solveCare(plant.A, plant.B, Q, MatrixXd::Identity(1, 1));
  RowVector4d K = -care.K;
  Matrix4d closed = plant.A + plant.B * K;
  Eigen::VectorXcd poles = Eigen::EigenSolver<MatrixXd>(MatrixXd(closed)).eigenvalues();
};

TEST(LectureNotesOnControl, FirstTheOtherWay) {
  // The integral of x e^(-lambda t) vanishes for a pin that was brought from rest to rest: the cart pole's
  // theta follows (4/3 l) theta'' = g theta - p'' near upright.
  const BalancedPole balanced;
  const double lambda = std::sqrt(9.8 / (4. / 3));
  const Vector4d goal(-1, 0, 0, 0);
  // Exactly, by the resolvent: the Laplace transform of x' = A x + B K (x - goal) at lambda.
  const Vector4d forced = -balanced.plant.B * (balanced.K * goal)(0);
  const Vector4d transform = inverse(lambda * Matrix4d::Identity() - balanced.closed) * (forced / lambda);
  EXPECT_NEAR(transform[0], 0, 1e-9);
  EXPECT_LT(balanced.poles.real().maxCoeff(), 0) << "it arrives";
}

TEST(LectureNotesOnControl, TheIterationForTheRiccatiEquation) {
  const BalancedPole balanced;
  double bound = 1e9;
  for (const Complex& first : balanced.poles)
    for (const Complex& second : balanced.poles)
      bound = std::min(bound, -2 * (first + second).real() / std::norm(first + second));
  expectStated("07-cartPole", fmt::format("For the cart pole this is {:.3f}.", bound));
  expectStated("07-cartPole",
               fmt::format("(here $\\mu_{{\\max}} = {:.3f}$, so a factor of {:.5f} per step)",
                           balanced.poles.real().maxCoeff(), 1 + 2e-3 * balanced.poles.real().maxCoeff()));
  // A small symmetric error decays just below the bound, and grows just above.
  const auto grows = [&](double epsilon) {
    Rng rng(2);
    const MatrixXd root = rng.normalVector(16).reshaped(4, 4);
    MatrixXd E = root + root.transpose();
    const double before = E.norm();
    const MatrixXd closed = balanced.closed;
    for (int k = 0; k < 20000 && E.norm() < 1e6 * before; ++k) {
      MatrixXd change = closed.transpose() * E;
      change += E * closed;
      E += epsilon * change;
    }
    return E.norm() > before;
  };
  EXPECT_FALSE(grows(.98 * bound));
  EXPECT_TRUE(grows(1.02 * bound));
  double step = 1e9;
  for (const Complex& pole : balanced.poles) step = std::min(step, -2 * pole.real() / std::norm(pole));
  expectStated("07-cartPole", fmt::format("the bound is {:.3f} s", step));
  // 12.11.1 b and c: the same gains as by solveCare.
  MatrixXd P = balanced.Q, K;
  const MatrixXd A = balanced.plant.A, B = balanced.plant.B;
  for (int k = 0; k < 30000; ++k) {
    K = -product({B.transpose(), P});
    const MatrixXd half = product({P, A});
    P += 1e-3 * (half + half.transpose() - product({K.transpose(), K}) + balanced.Q);
  }
  EXPECT_LT((K - balanced.K).norm(), 1e-7);
  expectStated("07-cartPole",
               fmt::format("$K = ({:.4f}, {:.4f}, {:.4f}, {:.4f})$", K(0, 0), K(0, 1), K(0, 2), K(0, 3)));
}

// The linear cart pole under u = K x^, if the force is `factor` times what the controller wants; and whether
// it is stable.
struct ObservedPole : BalancedPole {
  MatrixXd C, L;
  explicit ObservedPole(const MatrixXd& sensor) : C(sensor) {
    const double rates = .005 * .005 * 60, errors = .002 * .002 / 60;
    const MatrixXd W = Vector4d(0, rates, 0, rates).asDiagonal(),
                   V = errors * MatrixXd::Identity(C.rows(), C.rows());
    L = steadyKalman({.A = plant.A, .B = plant.B, .C = C}, W, V).L;
  }
  bool stable(double factor) const {
    MatrixXd loop(8, 8);
    const MatrixXd BK = plant.B * K, LC = L * C, inner = closed - LC;
    loop << plant.A, factor * BK, LC, inner;
    return continuousStability(loop).rate < 0;
  }
};

// Where `stable` begins or ceases to hold between a factor for which it does and one for which it does not.
double limitBetween(double in, double out, const std::function<bool(double)>& stable) {
  while (std::abs(in - out) > 1e-9) (stable((in + out) / 2) ? in : out) = (in + out) / 2;
  return in;
}

TEST(LectureNotesOnControl, WhatASensorMustSee) {
  const BalancedPole balanced;
  const LinearSystem ofTheta{.A = balanced.plant.A, .B = balanced.plant.B, .C = RowVector4d(0, 0, 1, 0)},
      ofP{.A = balanced.plant.A, .B = balanced.plant.B, .C = RowVector4d(1, 0, 0, 0)};
  EXPECT_EQ(observability(ofTheta).rank, 2);
  EXPECT_LT(observability(ofTheta).unreachable.bottomRows(2).norm(), 1e-12);
  EXPECT_EQ(steadyKalman(ofTheta, MatrixXd::Identity(4, 4), MatrixXd::Identity(1, 1)).status,
            RiccatiStatus::kNotDetectable);
  const MatrixXd rows = observabilityMatrix(ofP);
  EXPECT_LT((rows - MatrixXd(Vector4d(1, 1, -5.88, -5.88).asDiagonal())).norm(), 1e-12);
  EXPECT_NEAR(balanced.plant.A(3, 2), 11.76, 1e-12);
  EXPECT_NEAR(balanced.plant.B(3, 0), -.6, 1e-12);
}

TEST(LectureNotesOnControl, MarginsOfTheObservedPole) {
  const ObservedPole ofP(RowVector4d(1, 0, 0, 0)),
      ofBoth((MatrixXd(2, 4) << 1, 0, 0, 0, 0, 0, 1, 0).finished());
  const auto stable = [](const ObservedPole& pole) { return [&](double m) { return pole.stable(m); }; };
  expectStated("07-cartPole",
               fmt::format("from {:.3f} and {:.3f} to {:.3f} and {:.3f}", limitBetween(1, .5, stable(ofP)),
                           limitBetween(1, 2, stable(ofP)), limitBetween(1, .5, stable(ofBoth)),
                           limitBetween(1, 9, stable(ofBoth))));
  const double least = limitBetween(1, .1, [&](double m) {
    const Matrix4d loop = ofP.plant.A + m * ofP.plant.B * ofP.K;
    return continuousStability(loop).rate < 0;
  });
  expectStated("07-cartPole", fmt::format("at $-{:.2f}$, hence $m > {:.3f}$", 1 / least, least));
  // Zeros from u to p: where the pencil (A - z I, B; C, 0) is singular.
  MatrixXd pencil = MatrixXd::Zero(5, 5);
  pencil.topLeftCorner(4, 4) = ofP.plant.A - 2.7110883 * MatrixXd::Identity(4, 4);
  pencil.topRightCorner(4, 1) = ofP.plant.B;
  pencil.bottomLeftCorner(1, 4) = ofP.C;
  EXPECT_NEAR(pencil.determinant(), 0, 1e-5);
  expectStated("07-cartPole", "the cart pole has one, at 2.711.");
  // Kalman's identity.
  for (const double w : {.3, 2., 11.}) {
    // h = (i w I - A)^-1 B in real numbers, its real part above its imaginary part.
    MatrixXd M = MatrixXd::Zero(8, 8), B = MatrixXd::Zero(8, 1);
    M.topLeftCorner(4, 4) = M.bottomRightCorner(4, 4) = -ofP.plant.A;
    M.topRightCorner(4, 4).diagonal().setConstant(-w);
    M.bottomLeftCorner(4, 4).diagonal().setConstant(w);
    B.topRows(4) = ofP.plant.B;
    const MatrixXd h = product({inverse(M), B}), real = h.topRows(4), imaginary = h.bottomRows(4);
    const Complex G(-product({ofP.K, real})(0), -product({ofP.K, imaginary})(0));
    const MatrixXd cost =
        product({real.transpose(), ofP.Q, real}) + product({imaginary.transpose(), ofP.Q, imaginary});
    EXPECT_NEAR(std::norm(1. + G), 1 + cost(0, 0), 1e-9);
  }
}

TEST(LectureNotesOnControl, DoylesExample) {
  const double q = 60, s = 30, f = 2 + std::sqrt(4 + q), d = 2 + std::sqrt(4 + s);
  Matrix2d A;
  A << 1, 1, 0, 1;
  const Vector2d B(0, 1);
  const Eigen::RowVector2d C(1, 0);
  const MatrixXd one = MatrixXd::Ones(1, 1), all = MatrixXd::Ones(2, 2);
  const Lqg lqg = rex::lqg({.A = A, .B = B, .C = C}, q * all, one, s * all, one);
  EXPECT_LT((lqg.regulator.K - f * Eigen::RowVector2d(1, 1)).norm(), 1e-9);
  EXPECT_LT((lqg.filter.L - d * Vector2d(1, 1)).norm(), 1e-9);
  const auto loop = [&](double m, double gain) {
    MatrixXd both(4, 4);
    const Matrix2d BK = f * product({B, Eigen::RowVector2d(1, 1)}), LC = gain * product({Vector2d(1, 1), C});
    both << A, -m * BK, LC, A - BK - LC;
    return both;
  };
  for (const double m : {.7, 1., 1.3}) {
    // The last coefficients of the characteristic polynomial: value and slope at zero.
    const auto at = [&](double z) { return (z * MatrixXd::Identity(4, 4) - loop(m, d)).determinant(); };
    EXPECT_NEAR(at(0), 1 + (1 - m) * d * f, 1e-6);
    EXPECT_NEAR((at(1e-4) - at(-1e-4)) / 2e-4, d + f - 4 + 2 * (m - 1) * d * f, 1e-4);
  }
  const auto stable = [&](double m) { return continuousStability(loop(m, 10)).rate < 0; };
  expectStated("07-cartPole", fmt::format("stable for ${:.3f} < m < {:.3f}$", limitBetween(1, .5, stable),
                                          limitBetween(1, 2, stable)));
  EXPECT_NEAR(1 - (10 + 10 - 4) / 200., .92, 1e-12);
}

TEST(LectureNotesOnControl, Separation) {
  Rng rng(9);
  const MatrixXd A = rng.normalVector(9).reshaped(3, 3), dA = rng.normalVector(9).reshaped(3, 3),
                 B = rng.normalVector(3), dB = rng.normalVector(3), K = rng.normalVector(3).transpose(),
                 L = rng.normalVector(3), C = rng.normalVector(3).transpose();
  MatrixXd loop(6, 6), errors(6, 6), change = MatrixXd::Identity(6, 6);
  const MatrixXd BK = B * K, dBK = dB * K, LC = L * C;
  loop << A + dA, BK + dBK, LC, A + BK - LC;
  change.bottomRightCorner(3, 3) *= -1;
  change.bottomLeftCorner(3, 3).setIdentity();  // to (x, x - x^) and back
  errors << A + dA + BK + dBK, -BK - dBK, dA + dBK, A - LC - dBK;
  EXPECT_LT((product({change, loop, change}) - errors).norm(), 1e-12);
}

TEST(LectureNotesOnControl, HamiltonianMatrices) {
  const BalancedPole balanced;
  const MatrixXd &A = balanced.plant.A, &B = balanced.plant.B;
  MatrixXd H(8, 8), turn = MatrixXd::Zero(8, 8);
  H << A, -product({B, B.transpose()}), -balanced.Q, -A.transpose();
  turn.topRightCorner(4, 4).setIdentity();
  turn.bottomLeftCorner(4, 4) = -MatrixXd::Identity(4, 4);
  const MatrixXd turned = turn * H;
  EXPECT_LT((turned - turned.transpose()).norm(), 1e-12);
  EXPECT_LT((product({turned, inverse(turn)}) + H.transpose()).norm(), 1e-9);
  // No solution: A = 0, B = (1, 0), Q = I.
  const RiccatiResult none =
      solveCare(MatrixXd::Zero(2, 2), Vector2d(1, 0), MatrixXd::Identity(2, 2), MatrixXd::Identity(1, 1));
  EXPECT_EQ(none.status, RiccatiStatus::kNotStabilizable);
  // Semidefinite, rank 3.
  const MatrixXd cost = balanced.Q + balanced.K.transpose() * balanced.K;
  EXPECT_EQ(Eigen::FullPivLU<MatrixXd>(cost).rank(), 3);
}

TEST(LectureNotesOnControl, DecreasingAndYetEscaping) {
  Vector2d x(5, 2);
  const auto V = [](const Vector2d& at) { return at[0] * at[0] / (1 + at[0] * at[0]) + at[1] * at[1]; };
  const auto rate = [](const Vector2d& at) -> Vector2d {
    const double w = 1 + at[0] * at[0];
    return {-6 * at[0] / (w * w) + 2 * at[1], -2 * (at[0] + at[1]) / (w * w)};
  };
  for (int k = 0; k < 100000; ++k) {
    const double before = V(x), w = 1 + x[0] * x[0];
    const Vector2d slope(2 * x[0] / (w * w), 2 * x[1]);
    ASSERT_NEAR(slope.dot(rate(x)), -12 * x[0] * x[0] / std::pow(w, 4) - 4 * x[1] * x[1] / (w * w), 1e-12);
    const Vector2d middle = x + 5e-4 * rate(x);
    const double old = x[0];
    x += 1e-3 * rate(middle);
    ASSERT_GT(x[0], old);
    ASSERT_LE(V(x), before);
  }
  EXPECT_GT(x[0], 100);
}

TEST(LectureNotesOnControl, ThePointMassOfTheSlides) {
  for (const double rho : {.01, 1., 1e6}) {
    const double m = 1.7, epsilon = .3, c = m * std::sqrt(rho * epsilon),
                 b = m * std::sqrt(rho) * std::sqrt(2 * c + epsilon);
    Matrix2d A, P;
    A << 0, 1, 0, 0;
    P << b * c / (rho * m * m), c, c, b;
    const RiccatiResult care =
        solveCare(A, Vector2d(0, 1 / m), epsilon * MatrixXd::Identity(2, 2), rho * MatrixXd::Identity(1, 1));
    EXPECT_LT((care.X - P).norm(), 1e-6 * P.norm());
    const double xi = .5 * std::sqrt(2 + std::sqrt(epsilon / rho) / m);
    EXPECT_NEAR(care.K(0, 1) / (2 * std::sqrt(m * care.K(0, 0))), xi, 1e-6);
    EXPECT_NEAR(b / (2 * m * std::sqrt(rho * c)), xi, 1e-9);
  }
  EXPECT_NEAR(.5 * std::sqrt(2 + std::sqrt(.3 / 1e6) / 1.7), 1 / std::sqrt(2), 1e-3);
  Matrix2d shear;
  shear << 1, 1, 0, 1;
  EXPECT_EQ(discreteStability(shear).stability, Stability::kUnstable);
}

TEST(LectureNotesOnControl, TheTableOfThePendulum) {
  expectStated("07b-swingup",
               fmt::format("$\\rho = -\\ln(0.995) / 0.05 = {:.4f}$ per second", -std::log(.995) / .05));
  expectStated("07b-swingup",
               fmt::format("{:.0f} sweeps for a factor of ten", std::ceil(std::log(.1) / std::log(.995))));
  const double nodes = std::pow(60, 4);
  expectStated("07b-swingup", fmt::format("{:.0f} million instead of {}", nodes / 1e6, 60 * 60));
  expectStated("07b-swingup", fmt::format("the table {:.0f} MB", nodes * sizeof(double) / 1e6));
  const Matrix2d upright{{0, 1}, {9.81, -.1}};
  expectStated("07b-swingup", fmt::format("$e^{{{:.1f} t}}$", continuousStability(upright).rate));
}

TEST(LectureNotesOnControl, RoundingErrorsThatGrow) {
  const BalancedPole balanced;
  const Matrix4d A = Matrix4d::Identity() + .01 * balanced.plant.A;
  const Vector4d B = .01 * balanced.plant.B;
  const auto asymmetryAfter = [&](int form) {
    Rng rng(3);
    const MatrixXd root = rng.normalVector(16).reshaped(4, 4);
    Matrix4d P = solveDare(A, B, balanced.Q, MatrixXd::Identity(1, 1)).X;
    P += 1e-9 * (root - root.transpose());
    for (int k = 0; k < 600; ++k) {
      const double weight = 1 + B.dot(P * B);
      const RowVector4d K = -(B.transpose() * P * A) / weight;
      const Matrix4d closed = A + B * K;
      if (form == 0) P = (balanced.Q + A.transpose() * P * A - K.transpose() * weight * K).eval();
      if (form == 1) P = (balanced.Q + A.transpose() * P * closed).eval();
      if (form == 2) P = (balanced.Q + K.transpose() * K + closed.transpose() * P * closed).eval();
    }
    return (P - P.transpose()).norm() / 1e-9;
  };
  EXPECT_GT(asymmetryAfter(0), 1e3);
  EXPECT_LT(asymmetryAfter(1), 1);
  EXPECT_LT(asymmetryAfter(2), 1);
}

TEST(LectureNotesOnControl, TheRacer) {
  const RacerDynamics racer;
  Rng rng(4);
  const VectorXd x = rng.normalVector(4);
  const Vector2d q = x.head<2>(), v = x.tail<2>();
  const double ml = racer.mB * racer.l;
  Matrix2d M;
  M << racer.mA + racer.IA / (racer.r * racer.r) + racer.mB, ml * std::cos(q[1]), ml * std::cos(q[1]),
      racer.IB + racer.mB * racer.l * racer.l;
  const Vector2d F(-ml * std::sin(q[1]) * v[1] * v[1], -racer.g * ml * std::sin(q[1]));
  EXPECT_LT((racer.massMatrix(q) - M).norm(), 1e-12);
  EXPECT_LT((racer.forces(q, v) - F).norm(), 1e-12);
  EXPECT_LT((racer.controlDirection() - Vector2d(1 / racer.r, -1)).norm(), 1e-12);
  // The wrong F does no work, and changes the momentum.
  const Vector2d wrong(-ml * std::sin(q[1]) * v[1] * v[1], ml * std::sin(q[1]) * v[0] * v[1]);
  EXPECT_NEAR(v.dot(wrong), 0, 1e-12);
  const Vector2d acceleration = product({inverse(M), -F - wrong});
  const double momentumRate = M.row(0).dot(acceleration) - ml * std::sin(q[1]) * v[1] * v[1];
  EXPECT_NEAR(momentumRate, ml * std::sin(q[1]) * v[1] * v[1], 1e-12);
}

TEST(LectureNotesOnControl, SensorsAloneCannotBringTheRacerToRest) {
  const RacerDynamics racer;
  const LinearizedPlant plant = racer.linearized(Vector4d::Zero(), 0);
  Rng rng(5);
  double best = -1e9;
  for (int k = 0; k < 2000; ++k) {
    const VectorXd w = 20 * rng.normalVector(3);
    const RowVector4d K(w[2] / racer.r, w[0] - w[2], 0, w[1]);
    const Matrix4d closed = plant.A + plant.B * K;
    const Eigen::VectorXcd roots = Eigen::EigenSolver<MatrixXd>(MatrixXd(closed)).eigenvalues();
    // The coefficient of s is minus the sum of the products of three roots.
    Complex triples = 0, scale = 0;
    for (int out = 0; out < 4; ++out) {
      Complex product = 1;
      for (int i = 0; i < 4; ++i)
        if (i != out) product *= roots[i];
      triples += product;
      scale += std::abs(product);
    }
    EXPECT_LT(std::abs(triples), 1e-7 * std::abs(scale));
    best = std::max(best, -roots.real().maxCoeff());
  }
  EXPECT_LT(best, 1e-6);
}

// A step of 0.1 s of the trolley of 16-mpc, from 5 m; how far it overshoots.
struct Trolley {
  LinearSystem plant{.A = (MatrixXd(2, 2) << 1, .1, 0, 1).finished(),
                     .B = (MatrixXd(2, 1) << .005, .1).finished(),
                     .step = .1};
  MatrixXd Q = Vector2d(1, 0).asDiagonal(), R = MatrixXd::Constant(1, 1, .1);

  double overshoot(const std::function<double(const VectorXd& x)>& law) const {
    VectorXd x = Vector2d(5, 0);
    double least = 5;
    for (int t = 0; t < 150; ++t) {
      x = (plant.A * x + plant.B * std::clamp(law(x), -1., 1.)).eval();
      least = std::min(least, x[0]);
    }
    return -least;
  }
  double planned(int horizon) const {
    const VectorXd one = VectorXd::Ones(1);
    const PredictiveController controller(plant,
                                          {.Q = Q, .R = R, .horizon = horizon, .uMin = -one, .uMax = one});
    return overshoot([&](const VectorXd& x) { return controller.plan(x).U(0, 0); });
  }
};

TEST(LectureNotesOnControl, StepsToStopInTime) {
  const Trolley trolley;
  const RiccatiResult regulator = lqr(trolley.plant, trolley.Q, trolley.R);
  const double cutOff = trolley.overshoot([&](const VectorXd& x) { return -(regulator.K * x)(0); });
  expectStated(
      "16-mpc",
      fmt::format("overshoots by {:.2f} m; plans of 10 steps by {:.2f} m, of 20 by {:.2f} m, of 25 and more "
                  "by {:.2f} m",
                  cutOff, trolley.planned(10), trolley.planned(20), trolley.planned(25)));
  EXPECT_NEAR(trolley.planned(25), trolley.planned(40), 1e-3);
  EXPECT_GT(std::abs(trolley.planned(20) - trolley.planned(40)), 5e-3);
  // One step with the cost to go, without bounds.
  const VectorXd x = Vector2d(-.3, .7);
  const PredictiveController single(trolley.plant, {.Q = trolley.Q, .R = trolley.R, .horizon = 1});
  EXPECT_LT((single.plan(x).U + regulator.K * x).norm(), 1e-9);
}

TEST(LectureNotesOnControl, WhatABoundIsWorth) {
  Matrix2d H;
  H << 2, 1.7, 1.7, 2;
  const Vector2d g(-3.6, -1.9), lower(-1, -1), free = -H.inverse() * g;
  const QuadraticProgram program(H, Matrix2d::Identity());
  const QuadraticSolution best = program.minimize(g, lower, Vector2d(1, 1)),
                          more = program.minimize(g, lower, Vector2d(1.01, 1));
  expectStated("16-mpc",
               fmt::format("is ({:.2f}, {:.2f}), cut off (1, -1), but the best position is ({:g}, {:.1f})",
                           free[0], free[1], best.x[0], best.x[1]));
  const double slope = (H * best.x + g)[0];
  expectStated("16-mpc",
               fmt::format("The slope there is {:.2f}, so a bound of 1.01 instead of 1 is worth about {:.4f}",
                           slope, -.01 * slope));
  EXPECT_NEAR(best.value - more.value, -.01 * slope, 1e-4);
}

TEST(LectureNotesOnControl, RoundInCircles) {
  MatrixXd H(3, 3);
  H << 4, 5, -5, 5, 9, -5, -5, -5, 7;
  const Eigen::Vector3d g(2, 1, -3);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(H).eigenvalues().minCoeff(), 0);
  // Holds all numbers above zero, and lets go of all whose slope leads inside.
  const auto next = [&](const std::set<int>& held) {
    MatrixXd rows = H;
    VectorXd right = -g;
    for (const int i : held) rows.row(i).setZero(), rows(i, i) = 1, right[i] = 0;
    const VectorXd z = product({inverse(rows), right}), slope = product({H, z}) + g;
    std::set<int> wanted;
    for (int i = 0; i < 3; ++i)
      if (held.contains(i) ? slope[i] <= 0 : z[i] > 0) wanted.insert(i);
    return wanted;
  };
  const std::set<int> second{1}, all{0, 1, 2}, third{2};
  EXPECT_EQ(next({}), second);
  EXPECT_EQ(next(second), all);
  EXPECT_EQ(next(all), third);
  EXPECT_EQ(next(third), second);
}

TEST(LectureNotesOnControl, Penalties) {
  const auto minimum = [](double square, double linear) {
    double best = 0, least = 1e9;
    for (double z = 0; z < 2; z += 1e-5) {
      const double s = std::max(0., z - 1), cost = .5 * (z - 2) * (z - 2) + square * s * s + linear * s;
      if (cost < least) least = cost, best = z;
    }
    return best;
  };
  expectStated("16-mpc", fmt::format("with $w = 10$ the minimum is at {:.3f}", minimum(10, 0)));
  EXPECT_NEAR(minimum(1000, 0) - 1, 1. / 2000, 2e-5);
  EXPECT_NEAR(minimum(0, 2), 1, 2e-5);
  EXPECT_GT(minimum(0, .5), 1.1);
}

// The line of part 5 of 16-mpc, on arm3.ors: by how many millimetres the hand leaves it, with this slowness;
// with none, by the pseudo-inverse, cut off, whose points of the line come by the clock.
double leavesLine(double slowness) {
  Simulator arm("arm3.ors");
  const Eigen::Vector3d tip(0, 0, .15), most(1.8, 1.3, 1.3), one = Eigen::Vector3d::Ones();
  Eigen::Vector3d q(-.5, -.2, -.2);
  arm.setJointAngles(q);
  const Vector2d start = arm.kinematicsPos("eff", tip).tail(2), way = Vector2d(-.4, .6) - start;
  double r = 0, farthest = 0;
  for (int t = 0; t < 70; ++t) {
    const double next = std::min(1., r + .025);
    const Vector2d away = arm.kinematicsPos("eff", tip).tail(2) - start, v = (next * way - away) / .05;
    const MatrixXd J = arm.jacobianPos("eff", tip).bottomRows(2);
    VectorXd lower(4), upper(4), z(4);
    lower << ((-most - q) / .05).cwiseMax(-one), 0;
    upper << ((most - q) / .05).cwiseMin(one), 1;
    if (slowness == 0) {
      z << leastSquares(J, v), 1;
      z = z.cwiseMax(lower).cwiseMin(upper).eval();
    } else {
      MatrixXd rows(2, 4);
      rows << J, -v;
      MatrixXd H = rows.transpose() * rows;
      H.diagonal() += Vector4d(1e-3, 1e-3, 1e-3, slowness);
      z = QuadraticProgram(H, Matrix4d::Identity()).minimize(Vector4d(0, 0, 0, -slowness), lower, upper).x;
    }
    q += .05 * z.head(3);
    r += z[3] * (next - r);
    arm.setJointAngles(q);
    const Vector2d now = arm.kinematicsPos("eff", tip).tail(2) - start;
    farthest = std::max(farthest, std::abs(now[0] * way[1] - now[1] * way[0]) / way.norm());
  }
  EXPECT_GT(r, .99);
  return 1e3 * farthest;
}

TEST(LectureNotesOnControl, SlowerAndBesideTheLine) {
  expectStated("16-mpc",
               fmt::format("it leaves it by {:.0f} mm, with a tenth of the slowness by {:.1f} mm; by the "
                           "pseudo-inverse, cut off, by {:.0f} mm",
                           leavesLine(.1), leavesLine(.01), leavesLine(0)));
}

TEST(LectureNotesOnControl, LongHorizons) {
  const LinearizedPlant upright = CartPoleDynamics{}.linearized(Vector4d::Zero(), 0);
  const LinearSystem plant = discretized({.A = upright.A, .B = upright.B}, .05);
  const MatrixXd Q = Vector4d(1, 0, 1, 0).asDiagonal(), R = MatrixXd::Constant(1, 1, .01);
  const RiccatiResult regulator = lqr(plant, Q, R);
  const MatrixXd &F = regulator.X, &K = regulator.K;
  // The cost of u = -gain x + v from rest for each v, by its values; and its condition.
  const auto hessian = [&](int steps, const MatrixXd& gain) {
    const auto cost = [&](const VectorXd& v) {
      VectorXd x = Vector4d::Zero();
      double sum = 0;
      for (int t = 0; t < steps; ++t) {
        const VectorXd u = v.segment(t, 1) - gain * x;
        sum += x.dot(Q * x) + u.dot(R * u);
        x = (plant.A * x + plant.B * u).eval();
      }
      return sum + x.dot(F * x);
    };
    const MatrixXd unit = MatrixXd::Identity(steps, steps);
    MatrixXd H(steps, steps);
    for (int i = 0; i < steps; ++i)
      for (int k = 0; k < steps; ++k)
        H(i, k) = (cost(unit.col(i) + unit.col(k)) - cost(unit.col(i) - unit.col(k))) / 2;
    return H;
  };
  const auto condition = [&](int steps) {
    const VectorXd sizes =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(hessian(steps, MatrixXd::Zero(1, 4))).eigenvalues();
    return sizes.maxCoeff() / sizes.minCoeff();
  };
  expectStated("16-mpc",
               fmt::format("it is $5 \\cdot 10^{:.0f}$ for 20 steps and $5 \\cdot 10^{:.0f}$ for 40",
                           std::log10(condition(20) / 5), std::log10(condition(40) / 5)));
  const double growth = std::sqrt(upright.A(3, 2));
  EXPECT_NEAR(std::exp(2 * growth), 950, 30);
  const MatrixXd afterwards = plant.B.transpose() * F * plant.B;
  const double single = 2 * (R(0, 0) + afterwards(0, 0));
  EXPECT_LT((hessian(20, K) - single * MatrixXd::Identity(20, 20)).norm(), 1e-6 * single);
}

TEST(LectureNotesOnControl, StandingAndTipping) {
  const auto work = [](double d) { return 30 * 9.81 * (std::sqrt(.64 + d * d) - .8); };
  expectStated("13-walking", fmt::format("{:.2f} J at 5 cm and {:.2f} J at 10 cm", work(.05), work(.1)));
  expectStated("13-walking",
               fmt::format("{:.2f} s for $h$ = 0.814 m", std::log(10) / std::sqrt(9.81 / .814)));
  expectStated("13-walking", fmt::format("with 2 cm, {:.2f} mm for each", 1e3 * .02 / 9.81));
  // The only bounded motion for a jump of p: continuous, with continuous velocity, and 1/2 at the jump.
  const double omega = 3.5, h = 1e-3;
  const auto c = [&](double t) { return t < 0 ? .5 * std::exp(omega * t) : 1 - .5 * std::exp(-omega * t); };
  EXPECT_DOUBLE_EQ(c(0), .5);
  EXPECT_NEAR((c(h) - c(0)) / h, (c(0) - c(-h)) / h, 1e-2);
  for (const double t : {-.3, .4})
    EXPECT_NEAR((c(t + h) - 2 * c(t) + c(t - h)) / (h * h), omega * omega * (c(t) - (t > 0 ? 1 : 0)), 1e-4);
}

TEST(LectureNotesOnControl, TheCompassWalker) {
  const CompassGait walker;
  Rng rng(6);
  const VectorXd x = rng.normalVector(4);
  const double a = walker.a, b = walker.b, l = a + b, m = walker.legMass, mH = walker.hipMass,
               turn = x[0] - x[1];
  Matrix2d M;
  M << mH * l * l + m * a * a + m * l * l, -m * l * b * std::cos(turn), -m * l * b * std::cos(turn),
      m * b * b;
  const Vector2d rest =
      m * l * b * std::sin(turn) * Vector2d(-x[3] * x[3], x[2] * x[2]) +
      walker.g * Vector2d(-(mH * l + m * a + m * l) * std::sin(x[0]), m * b * std::sin(x[1]));
  const Vector2d accelerations = walker.derivative(x).tail<2>();
  EXPECT_LT((product({M, accelerations}) + rest).norm(), 1e-9);
  // After an impact both feet are on the slope, and one multiplier is zero.
  const Vector4d guess(.218668803, -.323388558, -1.091826677, -.377181558);
  const LimitCycle gait = findLimitCycle(walker, guess);
  ASSERT_EQ(gait.status, LimitCycle::Status::kFound);
  EXPECT_NEAR(gait.x[0] + gait.x[1], -2 * walker.slope, 1e-9);
  EXPECT_LT(std::abs(gait.multipliers[3]), 1e-9);
}

TEST(LectureNotesOnControl, SteeperIsNotProportionallyFaster) {
  // Step length over period of the simplest walker at two small slopes.
  const auto speed = [](double slope) {
    // Garcia et al. 1998: theta is about .970956 slope^(1/3) at the long gait.
    const double theta = .970956 * std::cbrt(slope), rate = -1.045203 * std::cbrt(slope);
    const CompassGait walker = simplestWalker(slope);
    const double swing = theta - slope - 2 * theta;  // the angle between the legs is 2 theta
    const LimitCycle gait =
        findLimitCycle(walker, Vector4d(theta - slope, swing, rate, rate * (1 - (1 - std::cos(2 * theta)))));
    EXPECT_EQ(gait.status, LimitCycle::Status::kFound) << gait.message;
    return 2 * std::sin((gait.x[0] - gait.x[1]) / 2) / gait.period;
  };
  expectStated("13-walking", fmt::format("$2^{{1/3}} = {:.2f}$ times as fast", std::cbrt(2)));
  EXPECT_NEAR(speed(2e-4) / speed(1e-4), std::cbrt(2), .01);
}

TEST(LectureNotesOnControl, GraspsInOtherUnits) {
  // Weights that prove closure prove it in other units, too, while epsilon is another.
  Rng rng(7);
  const MatrixXd G = Eigen::Vector3d(1, 1, .25).asDiagonal();
  MatrixXd wrenches(3, 4);
  wrenches << 1, -1, 0, 0, 1, 1, -1, -1, 0, 0, 1, -1;  // columns add up to zero
  EXPECT_LT(wrenches.rowwise().sum().norm(), 1e-12);
  EXPECT_LT((G * wrenches).rowwise().sum().norm(), 1e-12);
  const auto epsilon = [](const MatrixXd& W) {
    double least = 1e9;  // over the faces, each without one of the four
    for (int out = 0; out < 4; ++out) {
      MatrixXd face(3, 3);
      for (int k = 0, i = 0; k < 4; ++k)
        if (k != out) face.row(i++) = W.col(k).transpose();
      const VectorXd normal = product({inverse(face), VectorXd::Ones(3)});
      least = std::min(least, 1 / normal.norm());
    }
    return least;
  };
  EXPECT_LT(epsilon(G * wrenches), .9 * epsilon(wrenches));
  expectStated("14-grasping", fmt::format("for 3 mm and a length of 5 cm that is {:.2f}", .003 / .05));
  expectStated("14-grasping", fmt::format("press with {:.0f} N in all", 1 / .001));
}

TEST(LectureNotesOnControl, MapsThatMayMoveAsAWhole) {
  // The relative pose of two poses does not change in the three directions of the null space.
  Rng rng(8);
  const VectorXd both = rng.normalVector(6);
  const auto relative = [](const VectorXd& x) -> VectorXd {
    Eigen::Vector3d seen;
    seen << Eigen::Rotation2Dd(-x[2]) * Vector2d(x.segment<2>(3) - x.head<2>()), x[5] - x[2];
    return seen;
  };
  MatrixXd null(6, 3);
  null << 1, 0, -both[1], 0, 1, both[0], 0, 0, 1, 1, 0, -both[4], 0, 1, both[3], 0, 0, 1;
  EXPECT_LT((numericJacobian(relative, both) * null).norm(), 1e-7);
}

}  // namespace rex::lecture_notes_control_test
