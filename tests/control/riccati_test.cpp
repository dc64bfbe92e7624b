#include "control/riccati.h"

#include <cmath>
#include <fstream>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unsupported/Eigen/KroneckerProduct>

#include "base/rng.h"
#include "control/care_doubling_internal.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::riccati_test {

using nlohmann::json;
using testing::HasSubstr;

Eigen::MatrixXd matrixOf(const json& rows) {
  Eigen::MatrixXd M(rows.size(), rows[0].size());
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    for (Eigen::Index k = 0; k < M.cols(); ++k)
      M(i, k) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)].get<double>();
  return M;
}

bool isReal(const json& one) {
  for (const char* key : {"A", "B", "Q", "R"})
    if (!one[key].is_array()) return false;
  return true;
}

Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index cols, Rng& rng) {
  Eigen::MatrixXd M(rows, cols);
  for (auto column : M.colwise()) column = rng.normalVector(static_cast<int>(rows));
  return M;
}

// References of 80 digits. Each within ten times the error of a well-known solver, at least 1e-13.
TEST(Riccati, AgreesWithTheGoldenNumbers) {
  std::ifstream stream(sourcePath("tests/golden/riccati.json"));
  const json golden = json::parse(stream);
  int count = 0;
  for (const char* kind : {"care", "dare"}) {
    for (const json& one : golden[kind]) {
      if (!isReal(one)) continue;
      ++count;
      const auto solve = std::string(kind) == "care" ? solveCare : solveDare;
      const RiccatiResult result =
          solve(matrixOf(one["A"]), matrixOf(one["B"]), matrixOf(one["Q"]), matrixOf(one["R"]));
      const bool isLimit =
          one.contains("note") && one["note"].get<std::string>().find("ON the") != std::string::npos;
      ASSERT_EQ(result.status, isLimit ? RiccatiStatus::kOnBoundary : RiccatiStatus::kSolved)
          << one["id"] << result.message;
      const Eigen::MatrixXd X = matrixOf(one["X"]), K = matrixOf(one["K"]);
      const double bar = std::max(1e-13, 10 * one["scipy_relerr"].get<double>());
      EXPECT_LE((result.X - X).norm(), bar * X.norm()) << one["id"];
      EXPECT_LE((result.K - K).norm(), std::max(1e-10, 10 * bar) * std::max(K.norm(), 1e-3)) << one["id"];
    }
  }
  EXPECT_EQ(count, 19);
}

TEST(Riccati, RandomProblemsAreSolvedAndStable) {
  Rng rng(41);
  for (int round = 0; round < 200; ++round) {
    const int n = 1 + rng.index(8), m = 1 + rng.index(3);
    const Eigen::MatrixXd A = randomMatrix(n, n, rng), B = randomMatrix(n, m, rng),
                          C = randomMatrix(n, n, rng);
    const Eigen::MatrixXd Q = C * C.transpose(),
                          R = Eigen::MatrixXd::Identity(m, m) * std::pow(10, rng.uniform(-3, 3));
    const RiccatiResult care = solveCare(A, B, Q, R), dare = solveDare(A, B, Q, R);
    ASSERT_EQ(care.status, RiccatiStatus::kSolved) << care.message;
    ASSERT_EQ(dare.status, RiccatiStatus::kSolved) << dare.message;
    EXPECT_LT(care.closedLoop.real().maxCoeff(), 0);
    EXPECT_LT(dare.closedLoop.cwiseAbs().maxCoeff(), 1);
    // A product of two named matrices compiles in no time, a chain of factors in seconds.
    const Eigen::MatrixXd &X = care.X, &Y = dare.X, At = A.transpose(), Bt = B.transpose();
    const Eigen::MatrixXd XA = X * A, XB = X * B, K = R.inverse() * XB.transpose(), fed = XB * K;
    EXPECT_LT((XA.transpose() + XA - fed + Q).norm(), 1e-9 * (X.norm() * A.norm() + fed.norm()));
    const Eigen::MatrixXd YA = Y * A, YB = Y * B, weight = R + Bt * YB, pull = Bt * YA;
    const Eigen::MatrixXd gain = weight.inverse() * pull, closed = A - B * gain, YC = Y * closed;
    EXPECT_LT((At * YC + Q - Y).norm(), 1e-9 * Y.norm() * (1 + A.squaredNorm()));
    EXPECT_LT((gain - dare.K).norm(), 1e-9 * (1 + gain.norm()));
  }
}

// The quick way against the stable eigenvectors of the Hamiltonian matrix: X = V2 V1^-1. Both sizes of
// storage; what is stiff or marginal is left to the Schur form.
TEST(Riccati, DoublingFindsTheStableEigenvectors) {
  Rng rng(45);
  for (const int n : {1, 2, 5, 8, 9, 16, 30}) {
    const int m = 1 + n / 3;
    const Eigen::MatrixXd A = randomMatrix(n, n, rng), B = randomMatrix(n, m, rng),
                          Q = Eigen::MatrixXd::Identity(n, n), R = 0.5 * Eigen::MatrixXd::Identity(m, m);
    const auto quick = internal::careByDoubling(A, B, Q, R);
    ASSERT_TRUE(quick.has_value()) << n;
    Eigen::MatrixXd hamiltonian(2 * n, 2 * n);
    const Eigen::MatrixXd BBt = B * B.transpose(), BtX = B.transpose() * quick->X;
    hamiltonian << A, -2 * BBt, -Q, -A.transpose();
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(hamiltonian);
    // Real and imaginary parts of a pair of eigenvectors span what the pair does.
    Eigen::MatrixXd V1(n, n), V2(n, n);
    Eigen::Index count = 0;
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      const std::complex<double> value = solver.eigenvalues()[i];
      if (value.real() >= 0) continue;
      ASSERT_LT(count, n);
      Eigen::VectorXd v(2 * n);
      for (Eigen::Index k = 0; k < 2 * n; ++k) {
        const std::complex<double> entry = solver.eigenvectors()(k, i);
        v[k] = value.imag() < 0 ? entry.imag() : entry.real();
      }
      V1.col(count) = v.head(n);
      V2.col(count++) = v.tail(n);
    }
    ASSERT_EQ(count, n);
    const Eigen::MatrixXd inverse = V1.inverse(), X = V2 * inverse;
    EXPECT_LT((quick->X - X).norm(), 1e-9 * X.norm()) << n;
    EXPECT_LT((quick->K - 2 * BtX).norm(), 1e-12 * quick->K.norm());
    EXPECT_LT(quick->residual, 1e-12);
    const Eigen::VectorXcd closed = Eigen::EigenSolver<Eigen::MatrixXd>(A - B * quick->K).eigenvalues();
    for (const std::complex<double> value : quick->closedLoop)
      EXPECT_LT((closed.array() - value).abs().minCoeff(), 1e-6 * A.norm());
  }
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  EXPECT_FALSE(internal::careByDoubling(Eigen::Vector2d(-1, -1e8).asDiagonal().toDenseMatrix(), I, I, I));
  EXPECT_FALSE(internal::careByDoubling(0 * I, I, 0 * I, I)) << "nothing decays";
  EXPECT_FALSE(internal::careByDoubling(0 * I, 0 * I, 0 * I, I));
}

// The discrete equation iterated from the end of a long horizon, slide 8:19.
TEST(Riccati, IsTheLimitOfAFiniteHorizon) {
  Rng rng(42);
  const Eigen::MatrixXd A = randomMatrix(4, 4, rng), B = randomMatrix(4, 2, rng);
  const Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(4, 4), R = Eigen::MatrixXd::Identity(2, 2);
  const Eigen::MatrixXd At = A.transpose(), Bt = B.transpose();
  Eigen::MatrixXd X = Q;
  for (int t = 0; t < 2000; ++t) {
    const Eigen::MatrixXd XA = X * A, XB = X * B, weight = R + Bt * XB, pull = Bt * XA;
    const Eigen::MatrixXd K = weight.inverse() * pull, closed = A - B * K, XC = X * closed;
    X = At * XC + Q;
  }
  EXPECT_LT((solveDare(A, B, Q, R).X - X).norm(), 1e-10 * X.norm());
}

TEST(Riccati, LyapunovEquationsAreLinearSystems) {
  Rng rng(43);
  for (int n = 1; n <= 6; ++n) {
    const Eigen::MatrixXd A = randomMatrix(n, n, rng), C = randomMatrix(n, n, rng), Q = C + C.transpose();
    const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n), At = A.transpose();
    const Eigen::MatrixXd continuous = Eigen::kroneckerProduct(I, At) + Eigen::kroneckerProduct(At, I);
    const Eigen::MatrixXd discrete =
        Eigen::MatrixXd(Eigen::kroneckerProduct(At, At)) - Eigen::MatrixXd::Identity(n * n, n * n);
    const Eigen::VectorXd q = -Q.reshaped();
    const Eigen::VectorXd x = continuous.fullPivLu().solve(q), y = discrete.fullPivLu().solve(q);
    EXPECT_LT((solveLyapunov(A, Q).reshaped() - x).norm(), 1e-9 * (1 + x.norm()));
    EXPECT_LT((solveDiscreteLyapunov(A, Q).reshaped() - y).norm(), 1e-9 * (1 + y.norm()));
  }
}

TEST(Riccati, NamesTheModeThatIsInTheWay) {
  const Eigen::Matrix2d A = Eigen::Vector2d(1, -1).asDiagonal(), I = Eigen::Matrix2d::Identity();
  Eigen::MatrixXd turning(2, 2);
  turning << 0, 2, -2, 0;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  const RiccatiResult unreachable = solveCare(A, Eigen::Vector2d(0, 1), I, one);
  EXPECT_EQ(unreachable.status, RiccatiStatus::kNotStabilizable);
  EXPECT_THAT(unreachable.message, HasSubstr("the control cannot reach the mode of eigenvalue 1"));
  EXPECT_EQ(unreachable.X.size(), 0);
  EXPECT_EQ(solveCare(A, Eigen::Vector2d(1, 0), I, one).status, RiccatiStatus::kSolved)
      << "the other mode decays";
  const RiccatiResult unseen = solveCare(turning, Eigen::Vector2d(0, 1), Eigen::Matrix2d::Zero(), one);
  EXPECT_EQ(unseen.status, RiccatiStatus::kNotDetectable);
  EXPECT_THAT(unseen.message, HasSubstr("the cost does not see the mode of eigenvalue 0"));
  EXPECT_THAT(unseen.message, HasSubstr("2i"));
  const RiccatiResult outside =
      solveDare(Eigen::Vector2d(2, .5).asDiagonal().toDenseMatrix(), Eigen::Vector2d(0, 1), I, one);
  EXPECT_EQ(outside.status, RiccatiStatus::kNotStabilizable);
  EXPECT_THAT(outside.message, HasSubstr("eigenvalue 2"));
  const RiccatiResult circling = solveDare(I, Eigen::Vector2d(1, 0), Eigen::Matrix2d::Zero(), one);
  EXPECT_NE(circling.status, RiccatiStatus::kSolved);
  const RiccatiResult impossible = solveCare(I, I, -100 * I, I);
  EXPECT_EQ(impossible.status, RiccatiStatus::kFailed) << impossible.message;
  EXPECT_THAT(impossible.message,
              HasSubstr("no stabilizing solution: the equation's pencil has the eigenvalue"));
  EXPECT_THAT(impossible.message, HasSubstr("on the imaginary axis"));
  ASSERT_TRUE(impossible.mode.has_value());
  EXPECT_NEAR(std::abs(impossible.mode->imag()), std::sqrt(99), 1e-6);
  EXPECT_EQ(*unreachable.mode, 1.);
  EXPECT_NEAR(std::abs(unseen.mode->imag()), 2, 1e-12);
  EXPECT_EQ(*outside.mode, 2.);
}

// An integrator that nothing pushes, or that costs nothing, in any coordinates: X must not be given.
TEST(Riccati, GivesNoXForHiddenIntegrators) {
  Rng rng(46);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  for (int round = 0; round < 30; ++round) {
    const Eigen::Matrix2d U = Eigen::Rotation2Dd(round == 0 ? 0. : rng.uniform(0, 6)).toRotationMatrix();
    Eigen::Matrix2d drift, I = Eigen::Matrix2d::Identity();
    drift << 0, 0, 1, 0;
    const RiccatiResult stuck = solveCare(U * drift * U.transpose(), U * Eigen::Vector2d(0, 1), I, one);
    EXPECT_EQ(stuck.status, RiccatiStatus::kNotStabilizable) << stuck.message;
    EXPECT_EQ(stuck.X.size(), 0);
    const RiccatiResult free =
        solveCare(U * drift * U.transpose(), U * Eigen::Vector2d(1, 0), Eigen::Matrix2d::Zero(), one);
    EXPECT_EQ(free.status, RiccatiStatus::kNotDetectable) << free.message;
    const RiccatiResult steps = solveDare(U * (drift + I) * U.transpose(), U * Eigen::Vector2d(0, 1), I, one);
    EXPECT_EQ(steps.status, RiccatiStatus::kNotStabilizable) << steps.message;
  }
}

// Systems with very fast and slow modes, or very large numbers, are neither refused nor called marginal.
TEST(Riccati, TakesStiffAndLargeProblems) {
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  const Eigen::Matrix2d fast = Eigen::Vector2d(-1, -1e8).asDiagonal();
  EXPECT_EQ(solveCare(fast, I, I, I).status, RiccatiStatus::kSolved);
  for (const double speed : {1e6, 1e8, 1e9}) {
    Eigen::MatrixXd actuator(2, 2);
    actuator << 0, 1, 0, -speed;
    const RiccatiResult result = solveCare(actuator, Eigen::Vector2d(0, speed), I, one);
    EXPECT_EQ(result.status, RiccatiStatus::kSolved) << result.message;
  }
  const double h = 1e-6;
  EXPECT_EQ(solveDare(one, h * one, .01 * h * one, h * one).status, RiccatiStatus::kSolved);
  for (const double q : {1e80, 1e155, 1e200}) {
    const RiccatiResult result = solveCare(one, one, q * one, one);
    ASSERT_EQ(result.status, RiccatiStatus::kSolved) << result.message;
    EXPECT_NEAR(result.K(0, 0) / (1 + std::sqrt(1 + q)), 1, 1e-12);
  }
}

// Slow modes that decay by themselves need no control and no cost, however fast the others are.
TEST(Riccati, LeavesSlowModesAlone) {
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  for (const auto& [slow, fast] : {std::pair{1., 1e8}, {1e-8, 1.}}) {
    const Eigen::Matrix2d A = -Eigen::Vector2d(slow, fast).asDiagonal().toDenseMatrix();
    const RiccatiResult unmoved = solveCare(A, Eigen::Vector2d(0, 1), I, one);
    ASSERT_EQ(unmoved.status, RiccatiStatus::kSolved) << unmoved.message;
    EXPECT_NEAR(unmoved.X(0, 0) * 2 * slow, 1, 1e-12) << "what the mode costs while it decays";
    EXPECT_EQ(solveCare(A, I, Eigen::Vector2d(0, 1).asDiagonal().toDenseMatrix(), I).status,
              RiccatiStatus::kSolved);
  }
  const Eigen::Matrix2d steps = Eigen::Vector2d(1 - 1e-8, 0.5).asDiagonal();
  EXPECT_EQ(solveDare(steps, Eigen::Vector2d(0, 1), I, one).status, RiccatiStatus::kSolved);
}

// One state: X^2 - 2 a X - q = 0 has the root a + sqrt(a^2 + q).
TEST(Riccati, TellsTheLimitFromASolution) {
  const auto solve = [](double a, double q) {
    return solveCare(Eigen::MatrixXd::Constant(1, 1, a), Eigen::MatrixXd::Ones(1, 1),
                     Eigen::MatrixXd::Constant(1, 1, q), Eigen::MatrixXd::Ones(1, 1));
  };
  const RiccatiResult idle = solve(0, 0);
  EXPECT_EQ(idle.status, RiccatiStatus::kNotDetectable) << idle.message;
  EXPECT_EQ(idle.mode, std::complex<double>(0));
  const RiccatiResult limit = solve(1, -1);
  EXPECT_EQ(limit.status, RiccatiStatus::kOnBoundary) << limit.message;
  EXPECT_NEAR(limit.X(0, 0), 1, 1e-6);
  EXPECT_EQ(solve(1, -1.01).status, RiccatiStatus::kFailed);
  const RiccatiResult inside = solve(1, -0.99);
  EXPECT_EQ(inside.status, RiccatiStatus::kSolved) << inside.message;
  EXPECT_NEAR(inside.X(0, 0), 1.1, 1e-13);
}

// A mode that grows unseen is stopped, and named: doing nothing would cost less.
TEST(Riccati, NamesWhatGrowsUnseen) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  const RiccatiResult care = solveCare(one, one, 0 * one, one), dare = solveDare(2 * one, one, 0 * one, one);
  EXPECT_EQ(care.status, RiccatiStatus::kSolved);
  EXPECT_NEAR(care.X(0, 0), 2, 1e-14);
  EXPECT_THAT(care.message,
              HasSubstr("not detectable: the cost does not see the growing mode of eigenvalue 1"));
  EXPECT_EQ(care.mode, std::complex<double>(1));
  EXPECT_EQ(dare.status, RiccatiStatus::kSolved);
  EXPECT_NEAR(dare.X(0, 0), 3, 1e-14);
  EXPECT_EQ(dare.mode, std::complex<double>(2));
  EXPECT_FALSE(solveCare(-one, one, 0 * one, one).mode.has_value()) << "it decays";
}

// Other units of time, controls and cost give the same solution in those units.
TEST(Riccati, DoesNotDependOnUnits) {
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero(), I = Eigen::Matrix2d::Identity();
  A(0, 1) = 1;
  const Eigen::Vector2d b(0, 1);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  const double root = std::sqrt(3.);
  Eigen::Matrix2d X;
  X << root, 1, 1, root;
  for (const double unit : {1e-300, 1e-150, 1e-20, 1., 1e20, 1e150, 1e300}) {
    const RiccatiResult time = solveCare(unit * A, unit * b, unit * I, unit * one);
    ASSERT_EQ(time.status, RiccatiStatus::kSolved) << unit << time.message;
    EXPECT_LT((time.X - X).norm(), 1e-13) << unit;
    EXPECT_NEAR(time.closedLoop[0].real() / unit, -root / 2, 1e-13);
    const RiccatiResult cost = solveCare(A, b, unit * I, unit * one);
    ASSERT_EQ(cost.status, RiccatiStatus::kSolved) << unit << cost.message;
    EXPECT_LT((cost.X / unit - X).norm(), 1e-13) << unit;
    EXPECT_LT((cost.K - Eigen::RowVector2d(1, root)).norm(), 1e-13) << unit;
    const RiccatiResult steps = solveDare(I + A, b, unit * I, unit * one), same = solveDare(I + A, b, I, one);
    ASSERT_EQ(steps.status, RiccatiStatus::kSolved) << unit << steps.message;
    EXPECT_LT((steps.X / unit - same.X).norm(), 1e-12) << unit;
    EXPECT_LT((steps.K - same.K).norm(), 1e-12) << unit;
  }
  const RiccatiResult control = solveCare(A, 1e-100 * b, I, 1e-200 * one);
  ASSERT_EQ(control.status, RiccatiStatus::kSolved) << control.message;
  EXPECT_LT((control.K / 1e100 - Eigen::RowVector2d(1, root)).norm(), 1e-13);
  // What cannot be told apart from no control is not called solved.
  EXPECT_NE(solveCare(A, 1e-150 * b, I, one).status, RiccatiStatus::kSolved);
}

TEST(Riccati, HasNoXBeyondTheLargestDouble) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  const RiccatiResult huge = solveCare(one, 1e-200 * one, one, one);  // X = 2e400
  EXPECT_EQ(huge.status, RiccatiStatus::kFailed);
  EXPECT_EQ(huge.X.size(), 0);
}

// Nothing costs and all ends by itself: X is zero.
TEST(Riccati, HasNoCostWithoutQ) {
  const Eigen::Matrix2d A = (Eigen::Matrix2d() << 1, -1, 1, -1).finished(), I = Eigen::Matrix2d::Identity();
  const RiccatiResult steps = solveDare(A, I, 0 * I, I), decay = solveCare(A - I, I, 0 * I, I);
  EXPECT_EQ(steps.status, RiccatiStatus::kSolved) << steps.message;
  EXPECT_EQ(decay.status, RiccatiStatus::kSolved) << decay.message;
  EXPECT_EQ(steps.X.norm() + decay.X.norm(), 0);
}

// DARE needs R + B^T X B, not R.
TEST(Riccati, TakesASingularWeightInSteps) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1), half = 0.5 * one,
                        pair = Eigen::MatrixXd::Ones(1, 2);
  const RiccatiResult free = solveDare(half, one, one, 0 * one);
  ASSERT_EQ(free.status, RiccatiStatus::kSolved) << free.message;
  EXPECT_NEAR(free.X(0, 0), 1, 1e-15);
  EXPECT_NEAR(free.K(0, 0), 0.5, 1e-15) << "to zero at once";
  const char* idle = "R + B^T X B is singular for every X: some control neither moves nor costs anything";
  EXPECT_THAT(solveDare(half, 0 * one, one, 0 * one).message, HasSubstr(idle));
  EXPECT_THAT(solveDare(half, pair, one, Eigen::Matrix2d::Zero()).message, HasSubstr(idle));
  EXPECT_THAT(solveDare(half, pair, one, Eigen::Matrix2d::Ones()).message, HasSubstr(idle));
  // Q has rank one, so that X has, and of two controls one is not needed.
  const Eigen::Matrix3d A = (Eigen::Matrix3d() << -1, 0, 0, -1, 0, -1, -1, 1, 1).finished();
  const Eigen::MatrixXd B = (Eigen::MatrixXd(3, 2) << 1, 1, 1, -1, -1, 1).finished();
  const RiccatiResult twofold = solveDare(A, B, Eigen::Matrix3d::Ones(), Eigen::Matrix2d::Zero());
  EXPECT_EQ(twofold.status, RiccatiStatus::kFailed);
  EXPECT_THAT(twofold.message, HasSubstr("no solution: R + B^T X B is singular"));
  const RiccatiResult nothing = solveDare(half, one, 0 * one, 0 * one);
  EXPECT_EQ(nothing.status, RiccatiStatus::kFailed);
  EXPECT_THAT(nothing.message, HasSubstr("no solution: R + B^T X B is singular"));
}

// Also where rounding has left a positive pivot; units do not make it singular.
TEST(Riccati, RefusesAWeightThatIsSingularToRounding) {
  Rng rng(47);
  for (int round = 0; round < 50; ++round) {
    const int m = 2 + rng.index(3);
    const Eigen::VectorXd v = rng.normalVector(m);
    const Eigen::MatrixXd A = randomMatrix(3, 3, rng), B = randomMatrix(3, m, rng), R = v * v.transpose();
    EXPECT_REX_ERROR(solveCare(A, B, Eigen::Matrix3d::Identity(), R), "wanted a positive definite matrix");
  }
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity(), units = Eigen::Vector2d(1, 1e-20).asDiagonal();
  EXPECT_EQ(solveCare(-I, units, I, units * units).status, RiccatiStatus::kSolved);
}

TEST(Riccati, SaysWhatIsWrong) {
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  const Eigen::Vector2d b(0, 1);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  EXPECT_REX_ERROR(solveCare(Eigen::MatrixXd::Zero(2, 3), b, I, one),
                   "columns of A: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(solveCare(I, Eigen::Vector3d(0, 0, 1), I, one), "rows of B: found a vector of size 3");
  EXPECT_REX_ERROR(solveCare(I, b, one, one), "rows of Q: found a vector of size 1");
  EXPECT_REX_ERROR(solveCare(I, b, I, I), "rows of R: found a vector of size 2");
  EXPECT_REX_ERROR(solveCare(I * NAN, b, I, one), "matrix A: found entries that are not finite");
  EXPECT_REX_ERROR(solveCare(I, b, I, 0 * one),
                   "matrix R: found the eigenvalue 0, wanted a positive definite matrix");
  EXPECT_REX_ERROR(solveCare(I, b, I, -one),
                   "matrix R: found the eigenvalue -1, wanted a positive definite matrix");
  EXPECT_REX_ERROR(solveDare(I, b, I, -one),
                   "matrix R: found the eigenvalue -1, wanted no negative eigenvalue");
  Eigen::MatrixXd skewed(2, 2);
  skewed << 1, 1, 0, 1;
  EXPECT_REX_ERROR(solveCare(I, b, skewed, one), "matrix Q: found a matrix that is not symmetric");
  EXPECT_REX_ERROR(solveCare(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 1), Eigen::MatrixXd(0, 0), one),
                   "no state or no control");
  EXPECT_REX_ERROR(solveLyapunov(Eigen::Vector2d(1, -1).asDiagonal().toDenseMatrix(), I),
                   "Lyapunov equation: found the eigenvalue -1+0i of A and another with a sum of zero");
  EXPECT_REX_ERROR(solveDiscreteLyapunov(I, I), "of A and another with a product of one");
  EXPECT_REX_ERROR(solveLyapunov(I, one), "rows of Q: found a vector of size 1, wanted size 2");
  EXPECT_REX_ERROR(solveLyapunov(-I, skewed), "matrix Q: found a matrix that is not symmetric");
  EXPECT_NO_THROW((void)solveLyapunov(Eigen::Vector2d(-1, -1e16).asDiagonal().toDenseMatrix(), I));
  EXPECT_REX_ERROR(solveLyapunov(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 0)), "matrix A: found no rows");
  EXPECT_REX_ERROR(solveLyapunov(I * INFINITY, I), "matrix A: found entries that are not finite");
  EXPECT_REX_ERROR(solveLyapunov(I, I * INFINITY), "matrix Q: found entries that are not finite");
}

}  // namespace rex::riccati_test
