#pragma once

#include "base/derivative_check.h"
#include "grading/check.h"
#include "interface.h"
#include "random_matrices.h"

// Part 1: each check substitutes a result into the equation it should solve.

// Residuals are relative to the terms of an equation at its solution, never at the answer: a large answer
// would make its own residual small. A correct method leaves residuals of up to 1e-11 in the equations below.
inline constexpr double kRelative = 1e-9;

inline void equationAHolds(rex::grading::Check& check, Student& student, int n) {
  const Eigen::MatrixXd A = wellConditioned(check.rng(), n, n);
  check.input(sizes("a: random A", n, n));
  const Eigen::MatrixXd X = student.equationA(A);
  check.shape("X of a", X, n, n);
  const Eigen::MatrixXd left = X * A + A.transpose(), Id = Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd wanted = (Id - A.transpose()) * rex::inverse(A);
  check.atMost("relative residual of X A + A^T = Id",
               (left - Id).norm() / (wanted.norm() * A.norm() + A.norm()), kRelative);
}

inline void equationBHolds(rex::grading::Check& check, Student& student, int n, int m) {
  const Eigen::MatrixXd A = randomMatrix(check.rng(), n, n), B = randomMatrix(check.rng(), n, m);
  const Eigen::MatrixXd C = wellConditioned(check.rng(), n, n) + 2 * A.transpose();
  check.input(sizes("b: random A, C, and B", n, m));
  const Eigen::MatrixXd X = student.equationB(A, B, C);
  check.shape("X of b", X, n, m);
  const Eigen::MatrixXd error = X.transpose() * C - (2 * A * (X + B)).transpose();
  const double size = rex::solve(C.transpose() - 2 * A, 2 * A * B).norm();  // of the wanted X
  check.atMost("relative residual of X^T C = (2 A (X + B))^T",
               error.norm() / (size * C.norm() + 2 * A.norm() * (size + B.norm())), kRelative);
}

inline void equationCHolds(rex::grading::Check& check, Student& student, int d, int n) {
  const Eigen::MatrixXd A = wellConditioned(check.rng(), d, n);
  const Eigen::VectorXd y = check.rng().normalVector(d);
  check.input(sizes("c: random A", d, n));
  const Eigen::VectorXd x = student.equationC(A, y);
  check.shape("x of c", x, n, 1);
  check.atMost("relative residual of (A x - y)^T A = 0",
               ((A * x - y).transpose() * A).norm() /
                   (A.norm() * (A.norm() * rex::leastSquares(A, y).norm() + y.norm())),
               kRelative);
}

inline void equationDHolds(rex::grading::Check& check, Student& student, int d, int n) {
  const Eigen::MatrixXd A = randomMatrix(check.rng(), d, n), B = positiveDefinite(check.rng(), n);
  const Eigen::VectorXd y = check.rng().normalVector(d);
  check.input(sizes("d: random B, and A", d, n));
  const Eigen::VectorXd x = student.equationD(A, y, B);
  check.shape("x of d", x, n, 1);
  const Eigen::MatrixXd error = (A * x - y).transpose() * A + x.transpose() * B;
  const double size = rex::solve(A.transpose() * A + B, A.transpose() * y).norm();  // of the wanted x
  const double scale = A.norm() * (A.norm() * size + y.norm()) + B.norm() * size;
  check.atMost("relative residual of (A x - y)^T A + x^T B = 0", error.norm() / scale, kRelative);
}

// sin(W x + b), a function whose derivative is known.
struct Wave {
  Eigen::MatrixXd W;
  Eigen::VectorXd b;
  Eigen::VectorXd operator()(const Eigen::VectorXd& x) const { return (W * x + b).array().sin(); }
  Evaluation at(const Eigen::VectorXd& x) const {
    return {(*this)(x), Eigen::VectorXd((W * x + b).array().cos()).asDiagonal() * W};
  }
};

inline void derivativeFits(rex::grading::Check& check, Student& student, int d, int n) {
  rex::Rng& rng = check.rng();
  const Wave f{randomMatrix(rng, d, n), rng.normalVector(d)}, g{randomMatrix(rng, d, n), rng.normalVector(d)};
  const Eigen::MatrixXd C = randomMatrix(rng, d, d);
  const Eigen::VectorXd x = rng.normalVector(n);
  check.input(sizes("two random functions with Jacobians", d, n) + ", a random C");
  const Eigen::MatrixXd derivative = student.productDerivative(f.at(x), C, g.at(x));
  check.shape("derivative of f^T C g", derivative, 1, n);
  const rex::VectorFunction number = [&](const Eigen::VectorXd& at) {
    return Eigen::VectorXd::Constant(1, f(at).dot(C * g(at)));
  };
  check.near("derivative of f^T C g against differences", derivative, rex::numericJacobian(number, x),
             1e-7 * (1 + C.norm() * (f.W.norm() + g.W.norm())));
}

inline void minimumIsLeast(rex::grading::Check& check, Student& student, int d, int n) {
  rex::Rng& rng = check.rng();
  const Eigen::MatrixXd A = randomMatrix(rng, d, n), C = positiveDefinite(rng, d),
                        B = positiveDefinite(rng, n);
  const Eigen::VectorXd y = rng.normalVector(d);
  check.input(sizes("random C, B, y, and A", d, n));
  const Minimum least = student.quadraticMinimum(A, y, C, B);
  check.shape("x of the minimum", least.x, n, 1);
  const Eigen::VectorXd e = A * least.x - y;
  const Eigen::MatrixXd H = A.transpose() * C * A + B;
  const double size = rex::solve(H, A.transpose() * C * y).norm();  // of the wanted x
  const double scale = A.norm() * C.norm() * (A.norm() * size + y.norm()) + B.norm() * size;
  check.atMost("relative derivative of the cost at x", (A.transpose() * C * e + B * least.x).norm() / scale,
               kRelative);
  const double cost = e.dot(C * e) + least.x.dot(B * least.x);
  check.near("value of the minimum against the cost at x", least.value, cost, 1e-9 * (1 + cost));
}
