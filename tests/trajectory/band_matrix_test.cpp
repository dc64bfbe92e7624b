#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "trajectory/banded_system_internal.h"

namespace rex::internal::band_matrix_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Squares of random rows within the band, in both forms.
struct Sample {
  BandMatrix<double> band;
  MatrixXd dense;
};

Sample randomSample(Rng& rng, int size, int width) {
  Sample sample{{size, width}, MatrixXd::Zero(size, size)};
  for (int first = 0; first + width < size; ++first) {
    std::vector<int> places;
    std::vector<double> values;
    for (int i = first; i <= first + width; i += 1 + first % 2) {
      places.push_back(i);
      values.push_back(rng.normal());
    }
    const double weight = 0.1 + rng.uniform(0, 1);
    sample.band.addSquare(places, values, weight);
    for (std::size_t a = 0; a < places.size(); ++a)
      for (std::size_t b = 0; b < places.size(); ++b)
        sample.dense(places[a], places[b]) += weight * values[a] * values[b];
  }
  return sample;
}

TEST(BandMatrix, HoldsSquaresOfRows) {
  Rng rng(1);
  for (const int width : {0, 1, 3, 6}) {
    const Sample sample = randomSample(rng, 9, width);
    EXPECT_EQ(sample.band.stored(), 9u * (static_cast<unsigned>(width) + 1));
    for (int j = 0; j < 9; ++j)
      for (int i = j; i < std::min(9, j + width + 1); ++i)
        EXPECT_NEAR(sample.band.at(i, j), sample.dense(i, j), 1e-14);
  }
}

TEST(BandMatrix, SolvesAsDenseMatricesDo) {
  Rng rng(2);
  for (const int width : {0, 1, 3, 6, 8}) {
    const Sample sample = randomSample(rng, 9, width);
    BandMatrix<double> factor(9, width);
    ASSERT_TRUE(factor.factor(sample.band, 0.5));
    VectorXd b = VectorXd::LinSpaced(9, -1, 2);
    const MatrixXd shifted = sample.dense + 0.5 * MatrixXd::Identity(9, 9);
    const VectorXd wanted = shifted.fullPivLu().solve(b);
    factor.solveInPlace({b.data(), 9});
    EXPECT_LT((b - wanted).cwiseAbs().maxCoeff(), 1e-12) << "width " << width;
  }
}

TEST(BandMatrix, SaysWhatIsNotPositiveDefinite) {
  BandMatrix<double> A(2, 1), factor(2, 1);
  A.at(0, 0) = 1, A.at(1, 0) = 2, A.at(1, 1) = 3;  // determinant -1
  EXPECT_FALSE(factor.factor(A, 0));
  EXPECT_TRUE(factor.factor(A, 1));
  A.at(1, 1) = std::nan("");
  EXPECT_FALSE(factor.factor(A, 0));
}

}  // namespace rex::internal::band_matrix_test
