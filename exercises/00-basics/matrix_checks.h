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
  const auto left = check.suspect("Is the inverse of A on the wrong side? A is to the right of X.",
                                  rex::inverse(A) * (Id - A.transpose()));
  const auto plain = check.suspect("Is A not transposed?", (Id - A) * rex::inverse(A));
  const auto sign =
      check.suspect("Does A^T keep its sign on the other side?", (Id + A.transpose()) * rex::inverse(A));
  check.near("X of equationA", student.equationA(A), wanted, toleranceFor(wanted));
}

inline void equationBHolds(rex::grading::Check& check, Student& student, int n, int m) {
  const Eigen::MatrixXd A = randomMatrix(check.rng(), n, n), B = randomMatrix(check.rng(), n, m);
  const Eigen::MatrixXd C = wellConditioned(check.rng(), n, n) + 2 * A.transpose();
  check.input("X^T C = (2 A (X + B))^T", {{"A", A}, {"B", B}, {"C", C}});
  const auto with = [&](const Eigen::MatrixXd& left) { return rex::solveMatrix(left, 2 * A * B); };
  const Eigen::MatrixXd wanted = with(C.transpose() - 2 * A);
  const auto all = check.suspect("Is C - 2 A^T not transposed?", with(C - 2 * A.transpose()));
  const auto plain = check.suspect("Is C not transposed?", with(C - 2 * A));
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
  const auto without = check.suspect("Is B left out?", rex::leastSquares(A, y));
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
  const auto ofF = [&](const Eigen::MatrixXd& M) -> Eigen::MatrixXd {
    return (M * atG.y).transpose() * atF.J;
  };
  const auto ofG = [&](const Eigen::MatrixXd& M) -> Eigen::MatrixXd { return atF.y.transpose() * M * atG.J; };
  const auto constantF = check.suspect("Is f taken for a constant? It depends on x, too.", ofG(C));
  const auto constantG = check.suspect("Is g taken for a constant? It depends on x, too.", ofF(C));
  const auto first =
      check.suspect("Is C not transposed in the term with the Jacobian of f?", ofF(C.transpose()) + ofG(C));
  const auto second =
      check.suspect("Is C transposed in the term with the Jacobian of g?", ofF(C) + ofG(C.transpose()));
  check.near("productDerivative, the derivative of f^T C g", student.productDerivative(atF, C, atG),
             ofF(C) + ofG(C), 1e-7 * (1 + C.norm() * (f.W.norm() + g.W.norm())));
}

inline void minimumIsLeast(rex::grading::Check& check, Student& student, int d, int n) {
  rex::Rng& rng = check.rng();
  const Eigen::MatrixXd A = randomMatrix(rng, d, n), C = positiveDefinite(rng, d),
                        B = positiveDefinite(rng, n);
  const Eigen::VectorXd y = rng.normalVector(d);
  check.input("(A x - y)^T C (A x - y) + x^T B x", {{"A", A}, {"y", y}, {"C", C}, {"B", B}});
  const Minimum least = student.quadraticMinimum(A, y, C, B);
  const Eigen::MatrixXd Id = Eigen::MatrixXd::Identity(d, d);
  const auto with = [&](const Eigen::MatrixXd& inH, const Eigen::MatrixXd& inSide) -> Eigen::VectorXd {
    return rex::solve(A.transpose() * inH * A + B, A.transpose() * (inSide * y));
  };
  const Eigen::VectorXd wanted = with(C, C);
  const auto none = check.suspect("Is C left out?", with(Id, Id));
  const auto onTheRight = check.suspect("Is C left out in the term with y?", with(C, Id));
  const auto onTheLeft = check.suspect("Is C left out in the term with x?", with(Id, C));
  check.near("x of quadraticMinimum", least.x, wanted, toleranceFor(wanted));
  const Eigen::VectorXd e = A * wanted - y;
  const double cost = e.dot(C * e) + wanted.dot(B * wanted);
  const auto number = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  const auto noB = check.suspect("Is the term x^T B x left out?", number(e.dot(C * e)));
  const auto noC = check.suspect("Is C left out?", number(e.dot(e) + wanted.dot(B * wanted)));
  check.near("value of quadraticMinimum", least.value, cost, 1e-8 * (1 + cost));
}
