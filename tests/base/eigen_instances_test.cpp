#include "base/eigen_instances.h"

#include <gtest/gtest.h>

#include "base/rng.h"

namespace rex::eigen_instances_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

MatrixXd randomMatrix(Rng& rng, Index rows, Index columns) {
  return MatrixXd::NullaryExpr(rows, columns, [&] { return rng.uniform(-1, 1); });
}

// What was compiled for the library agrees with what this file compiles of the same templates for another
// scalar.
TEST(EigenInstances, MultiplyAndDecomposeAsOtherScalarsDo) {
  Rng rng(1);
  for (const Index n : {1, 3, 4, 17, 70}) {
    const MatrixXd A = randomMatrix(rng, n, n), B = randomMatrix(rng, n, 3),
                   S = A * A.transpose() + MatrixXd::Identity(n, n);
    const Wide wideA = A.cast<long double>(), wideB = B.cast<long double>(), wideS = S.cast<long double>();
    const auto apart = [&](const MatrixXd& got, const Wide& wanted) {
      return static_cast<double>((got.cast<long double>() - wanted).norm() / (1 + wanted.norm()));
    };
    EXPECT_LT(apart(A * B, wideA.lazyProduct(wideB)), 1e-14) << n;
    EXPECT_LT(apart(A.transpose() * B, wideA.transpose().lazyProduct(wideB)), 1e-14) << n;
    EXPECT_LT(apart(A * B.col(0), wideA.lazyProduct(wideB.col(0))), 1e-14) << n;
    EXPECT_LT(apart(S.llt().solve(B), wideS.llt().solve(wideB)), 1e-12) << n;
    EXPECT_LT(apart(S.ldlt().solve(B), wideS.llt().solve(wideB)), 1e-12) << n;
    EXPECT_LT(apart(S.partialPivLu().solve(B), wideS.llt().solve(wideB)), 1e-12) << n;
    EXPECT_LT(apart(S.colPivHouseholderQr().solve(B), wideS.llt().solve(wideB)), 1e-12) << n;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(S);
    EXPECT_LT((S * eigen.eigenvectors() - eigen.eigenvectors() * eigen.eigenvalues().asDiagonal()).norm(),
              1e-12 * S.norm())
        << n;
    const Eigen::JacobiSVD<MatrixXd> svd(S);
    EXPECT_LT((svd.singularValues() - eigen.eigenvalues().reverse()).norm(), 1e-12 * S.norm()) << n;
    EXPECT_NEAR(Eigen::EigenSolver<MatrixXd>(A).eigenvalues().sum().real(), A.trace(), 1e-12 * (1 + A.norm()))
        << n;
  }
}

// Products that are specialised give the bits that Eigen's own give, which a Map still takes.
TEST(EigenInstances, MultiplyAsEigenDoes) {
  Rng rng(2);
  for (const Index n : {0, 1, 2, 5, 6, 9, 40})
    for (const Index inner : {1, 3, 8, 33})
      for (const Index columns : {1, 4, 7, 50}) {
        MatrixXd A = randomMatrix(rng, n, inner), At = A.transpose(), D = randomMatrix(rng, columns, inner);
        const MatrixXd B = randomMatrix(rng, inner, columns), S = randomMatrix(rng, inner, inner),
                       C = randomMatrix(rng, n, columns);
        const auto check = [&](const auto& product, const MatrixXd& plainly) {
          MatrixXd got = product, more = C, less = C, wanted(n, columns), added = C, taken = C;
          more.noalias() += product;
          less.noalias() -= product;
          const auto same = [](MatrixXd& M) { return Eigen::Map<MatrixXd>(M.data(), M.rows(), M.cols()); };
          same(wanted).noalias() = product;
          same(added).noalias() += product;
          same(taken).noalias() -= product;
          EXPECT_EQ(got, wanted) << n << " " << inner << " " << columns;
          EXPECT_EQ(more, added) << n << " " << inner << " " << columns;
          EXPECT_EQ(less, taken) << n << " " << inner << " " << columns;
          EXPECT_LE((got - plainly).norm(),
                    1e-13 * (1 + plainly.norm()) * static_cast<double>(inner * inner));
        };
        const MatrixXd AB = A.lazyProduct(B), AS = A.lazyProduct(S), ASB = AS.lazyProduct(B);
        const MatrixXd& fixedAt = At;
        const MatrixXd& fixedD = D;
        check(A * B, AB);
        check(At.transpose() * B, AB);
        check(fixedAt.transpose() * B, AB);
        check(A * fixedD.transpose(), A.lazyProduct(D.transpose()));
        check(A * S * B, ASB);
        check(A * S * fixedD.transpose(), AS.lazyProduct(D.transpose()));
        check(fixedAt.transpose() * S * B, ASB);
        const MatrixXd SSt = S.lazyProduct(S.transpose());
        check(A * S * S.transpose() * B, MatrixXd(A.lazyProduct(SSt)).lazyProduct(B));
      }
}

}  // namespace rex::eigen_instances_test
