#pragma once

#include "grading/check.h"
#include "interface.h"
#include "random_matrices.h"

// Part 1: results are compared with those of another way to compute them.

// Of a problem with random matrices, which are far from singular, every correct way keeps at least ten
// digits.
inline double toleranceFor(const Eigen::MatrixXd& wanted) { return 1e-8 * (1 + wanted.norm()); }

inline void equationAHolds(rex::grading::Check& check, Student& student, int n) {
  const Eigen::MatrixXd A = wellConditioned(check.rng(), n, n), Id = Eigen::MatrixXd::Identity(n, n);
  check.input("X A + A^T = Id", {{"A", A}});
  const Eigen::MatrixXd wanted = (Id - A.transpose()) * rex::inverse(A);
  check.near("X of equationA", student.equationA(A), wanted, toleranceFor(wanted));
}

inline void equationBHolds(rex::grading::Check& check, Student& student, int n, int m) {
  const Eigen::MatrixXd A = randomMatrix(check.rng(), n, n), B = randomMatrix(check.rng(), n, m);
  const Eigen::MatrixXd C = wellConditioned(check.rng(), n, n) + 2 * A.transpose();
  check.input("X^T C = (2 A (X + B))^T", {{"A", A}, {"B", B}, {"C", C}});
  const Eigen::MatrixXd wanted = rex::solveMatrix(C.transpose() - 2 * A, 2 * A * B);
  check.near("X of equationB", student.equationB(A, B, C), wanted, toleranceFor(wanted));
}

inline void equationCHolds(rex::grading::Check& check, Student& student, int d, int n) {
  const Eigen::MatrixXd A = wellConditioned(check.rng(), d, n);
  const Eigen::VectorXd y = check.rng().normalVector(d);
  check.input("(A x - y)^T A = 0", {{"A", A}, {"y", y}});
  const Eigen::VectorXd wanted = rex::leastSquares(A, y);
  check.near("x of equationC", student.equationC(A, y), wanted, toleranceFor(wanted));
}

inline void equationDHolds(rex::grading::Check& check, Student& student, int d, int n) {
  const Eigen::MatrixXd A = randomMatrix(check.rng(), d, n), B = positiveDefinite(check.rng(), n);
  const Eigen::VectorXd y = check.rng().normalVector(d);
  check.input("(A x - y)^T A + x^T B = 0", {{"A", A}, {"y", y}, {"B", B}});
  const Eigen::VectorXd wanted = rex::solve(A.transpose() * A + B, A.transpose() * y);
  check.near("x of equationD", student.equationD(A, y, B), wanted, toleranceFor(wanted));
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
  const Evaluation atF = f.at(x), atG = g.at(x);
  check.input("f and g with their Jacobians at x, and C",
              {{"f", atF.y}, {"J of f", atF.J}, {"C", C}, {"g", atG.y}, {"J of g", atG.J}});
  const Eigen::MatrixXd wanted = (C * atG.y).transpose() * atF.J + atF.y.transpose() * C * atG.J;
  check.near("productDerivative, the derivative of f^T C g", student.productDerivative(atF, C, atG), wanted,
             1e-7 * (1 + C.norm() * (f.W.norm() + g.W.norm())));
}

inline void minimumIsLeast(rex::grading::Check& check, Student& student, int d, int n) {
  rex::Rng& rng = check.rng();
  const Eigen::MatrixXd A = randomMatrix(rng, d, n), C = positiveDefinite(rng, d),
                        B = positiveDefinite(rng, n);
  const Eigen::VectorXd y = rng.normalVector(d);
  check.input("(A x - y)^T C (A x - y) + x^T B x", {{"A", A}, {"y", y}, {"C", C}, {"B", B}});
  const Minimum least = student.quadraticMinimum(A, y, C, B);
  const Eigen::VectorXd wanted = rex::solve(A.transpose() * C * A + B, A.transpose() * (C * y));
  check.near("x of quadraticMinimum", least.x, wanted, toleranceFor(wanted));
  const Eigen::VectorXd e = A * wanted - y;
  const double cost = e.dot(C * e) + wanted.dot(B * wanted);
  check.near("value of quadraticMinimum", least.value, cost, 1e-8 * (1 + cost));
}
