#include "course/search_cma.h"

#include <cmath>

#include <gtest/gtest.h>

#include "optim/test_functions.h"
#include "support/expect_error.h"

namespace rex::search_cma_test {

// The exercise's loop.
TEST(SearchCma, FindsTheMinimumInTheLoopOfTheCourse) {
  SearchCma cma(3);
  cma.init(5, -1, -1, -.1, .1);
  Eigen::MatrixXd samples;
  Eigen::VectorXd values;
  for (int t = 0; t < 1000; ++t) {
    cma.step(samples, values);
    ASSERT_EQ(samples.rows(), 8);
    ASSERT_EQ(samples.cols(), 5);
    for (int i = 0; i < samples.rows(); ++i)
      values[i] = testFunction("rosenbrock").value(samples.row(i).transpose());
  }
  EXPECT_LT((cma.getBestSample() - Eigen::VectorXd::Ones(5)).norm(), 1e-6);
  EXPECT_LT((cma.getMean() - Eigen::VectorXd::Ones(5)).norm(), 1e-6);
}

TEST(SearchCma, DoesWhatTheLibraryDoes) {
  SearchCma cma(7);
  const Eigen::Vector3d start(1, 2, 3), deviations(0.1, 0.2, 0.4);
  cma.init(start, 3, 9, deviations);
  CmaEs own(start, deviations, {.lambda = 9, .mu = 3});
  Rng rng(7);
  Eigen::MatrixXd samples, columns;
  Eigen::VectorXd values, ownValues;
  for (int t = 0; t < 20; ++t) {
    cma.step(samples, values);
    own.step(columns, ownValues, rng);
    ASSERT_EQ(samples, columns.transpose());
    values = ownValues = samples.rowwise().squaredNorm();
  }
  EXPECT_EQ(cma.getMean(), own.mean());
  EXPECT_EQ(cma.getBestSample(), own.result().x);
  SearchCma one(7);
  one.init(start, -1, -1, 0.5);
  Eigen::VectorXd none;
  one.step(samples, none);
  EXPECT_EQ(samples.rows(), 7);  // 4 + floor(3 ln 3)
}

// A second search with the arrays of the first learns nothing from it.
TEST(SearchCma, BeginsAnew) {
  SearchCma cma(1);
  Eigen::MatrixXd samples;
  Eigen::VectorXd values;
  cma.init(Eigen::Vector2d(5, 5), -1, 6, .1);
  for (int t = 0; t < 3; ++t) {
    cma.step(samples, values);
    values = samples.rowwise().squaredNorm();
  }
  const Eigen::Vector2d start(-7, 3);
  cma.init(start, -1, 6, .1);
  cma.step(samples, values);
  EXPECT_EQ(cma.getMean(), start);
  EXPECT_EQ(cma.getBestSample(), start);
  EXPECT_LT((samples.rowwise() - start.transpose()).norm(), 2);
  cma.init(3, -1, 9);
  cma.step(samples, values);
  EXPECT_EQ(samples.cols(), 3);
  EXPECT_EQ(values.size(), 9);
}

TEST(SearchCma, SaysWhatIsWrong) {
  SearchCma cma;
  Eigen::MatrixXd samples;
  Eigen::VectorXd values;
  EXPECT_REX_ERROR(cma.step(samples, values), "SearchCma: found no earlier init(), wanted init(D)");
  EXPECT_REX_ERROR(cma.getMean(), "SearchCma: found no earlier init()");
  EXPECT_REX_ERROR(cma.init(0), "init: D: found 0, wanted at least 1");
  EXPECT_REX_ERROR(cma.init(3, -1, -1, 1, 1), "init: lo and hi: found 1 and 1, wanted the lower one first");
  EXPECT_REX_ERROR(cma.init(3, -2), "CMA-ES: mu: found -2");
  cma.init(3, -1, 6);
  cma.step(samples, values);
  Eigen::MatrixXd few = samples.topRows(5), narrow = samples.leftCols(2);
  EXPECT_REX_ERROR(cma.step(few, values), "step: rows of samples: found a vector of size 5, wanted size 6");
  EXPECT_REX_ERROR(cma.step(narrow, values),
                   "step: columns of samples: found a vector of size 2, wanted size 3");
  Eigen::VectorXd three = Eigen::VectorXd::Zero(3);
  EXPECT_REX_ERROR(cma.step(samples, three), "step: values: found a vector of size 3, wanted size 6");
}

}  // namespace rex::search_cma_test
