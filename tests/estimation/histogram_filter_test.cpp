#include "estimation/histogram_filter.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "estimation/kalman_filter.h"
#include "support/expect_error.h"

namespace rex::histogram_filter_test {

CellTransition randomTransition(int cells, Rng& rng) {
  Eigen::MatrixXd P(cells, cells);
  for (int j = 0; j < cells; ++j) {
    P.col(j) = rng.uniformVector(cells, 0, 1);
    P.col(j) /= P.col(j).sum();
  }
  return P.sparseView();
}

// Sums over all sequences of cells: the definition.
std::vector<Eigen::VectorXd> enumerated(const Eigen::VectorXd& prior,
                                        const std::vector<CellTransition>& moves,
                                        const std::vector<Eigen::VectorXd>& likelihoods) {
  const int cells = static_cast<int>(prior.size()), T = static_cast<int>(likelihoods.size());
  std::vector<Eigen::VectorXd> posterior(likelihoods.size(), Eigen::VectorXd::Zero(cells));
  std::vector<int> path(likelihoods.size(), 0);
  const int count = static_cast<int>(std::lround(std::pow(cells, T)));
  for (int code = 0; code < count; ++code) {
    int rest = code;
    for (int& cell : path) {
      cell = rest % cells;
      rest /= cells;
    }
    double p = prior[path[0]] * likelihoods[0][path[0]];
    for (std::size_t t = 1; t < path.size(); ++t)
      p *= moves[t - 1].coeff(path[t], path[t - 1]) * likelihoods[t][path[t]];
    for (std::size_t t = 0; t < path.size(); ++t) posterior[t][path[t]] += p;
  }
  for (Eigen::VectorXd& belief : posterior) belief /= belief.sum();
  return posterior;
}

TEST(HistogramFilter, FilterAndSmootherAreSumsOverAllPaths) {
  Rng rng(21);
  for (int round = 0; round < 20; ++round) {
    const int cells = 2 + rng.index(3), T = 5;
    Eigen::VectorXd prior = rng.uniformVector(cells, 0, 1);
    prior /= prior.sum();
    std::vector<CellTransition> moves;
    std::vector<Eigen::VectorXd> likelihoods;
    for (int t = 0; t < T; ++t) {
      if (t > 0) moves.push_back(randomTransition(cells, rng));
      likelihoods.push_back(rng.uniformVector(cells, 0, 3));
    }
    Eigen::VectorXd belief = prior;
    for (std::size_t t = 0; t < likelihoods.size(); ++t) {
      if (t > 0) belief = predictCells(belief, moves[t - 1]);
      belief = updateCells(belief, likelihoods[t]).belief;
    }
    const auto all = enumerated(prior, moves, likelihoods), later = smoothedCells(prior, moves, likelihoods);
    EXPECT_LT((belief - all.back()).norm(), 1e-13);
    for (std::size_t t = 0; t < all.size(); ++t) EXPECT_LT((later[t] - all[t]).norm(), 1e-13);
  }
}

// On a fine grid a walk with Gaussian noise is what Kalman's filter and smoother say.
TEST(HistogramFilter, AgreesWithGaussiansOnAFineGrid) {
  const int cells = 801;
  const double width = .02;
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(cells, -8, 8);
  const auto bell = [&](double mean, double variance) -> Eigen::VectorXd {
    return (-(x.array() - mean).square() / 2 / variance).exp();
  };
  Eigen::MatrixXd P(cells, cells);
  for (int j = 0; j < cells; ++j) P.col(j) = bell(.9 * x[j] + .1, .04) / bell(.9 * x[j] + .1, .04).sum();
  const CellTransition move = P.sparseView(1, 1e-14);
  CellTransition normalised = move;
  for (int j = 0; j < cells; ++j) normalised.col(j) /= move.col(j).sum();
  const Eigen::VectorXd prior = bell(0, .25) / bell(0, .25).sum();
  const auto number = [](double v) { return Eigen::MatrixXd::Constant(1, 1, v); };
  const LinearModel walk{number(.9), number(.1), number(.04)}, see{number(1), number(0), number(.09)};
  std::vector<Gaussian> filtered;
  std::vector<LinearModel> walks;
  std::vector<CellTransition> moves;
  std::vector<Eigen::VectorXd> likelihoods;
  for (const double y : {.3, -.2, .9, .4}) {
    const Gaussian start{number(0), number(.25)};
    const Gaussian predicted = filtered.empty() ? start : kalmanPredict(filtered.back(), walk);
    if (!filtered.empty()) {
      walks.push_back(walk);
      moves.push_back(normalised);
    }
    filtered.push_back(kalmanUpdate(predicted, see, number(y)).belief);
    likelihoods.push_back(bell(y, .09));
  }
  const auto cellsLater = smoothedCells(prior, moves, likelihoods);
  const auto later = smoothed(filtered, walks);
  for (std::size_t t = 0; t < later.size(); ++t) {
    const double mean = cellsLater[t].dot(x);
    EXPECT_NEAR(mean, later[t].mean[0], 1e-6);
    EXPECT_NEAR((cellsLater[t].array() * (x.array() - mean).square()).sum(), later[t].covariance(0, 0),
                width * width);
  }
}

TEST(HistogramFilter, SaysWhenItIsLost) {
  const CellUpdate lost = updateCells(Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1));
  EXPECT_TRUE(lost.lost);
  EXPECT_EQ(lost.evidence, 0);
  EXPECT_EQ(lost.belief, Eigen::Vector2d(1, 0));
  EXPECT_FALSE(updateCells(Eigen::Vector2d(1, 0), Eigen::Vector2d(.1, 1)).lost);
}

// Cells that cannot be reached do not matter, whatever they would say, and however long it goes on.
TEST(HistogramFilter, LastsLong) {
  const CellTransition stay = Eigen::Matrix2d::Identity().sparseView();
  const std::vector<CellTransition> moves(1999, stay);
  const std::vector<Eigen::VectorXd> likelihoods(2000, Eigen::Vector2d(.1, 1));
  for (const Eigen::VectorXd& belief : smoothedCells(Eigen::Vector2d(1, 0), moves, likelihoods))
    EXPECT_EQ(belief, Eigen::Vector2d(1, 0));
  const CellUpdate faint = updateCells(Eigen::Vector2d(1, 1e-200), Eigen::Vector2d(0, 1e-200));
  EXPECT_FALSE(faint.lost);
  EXPECT_EQ(faint.belief, Eigen::Vector2d(0, 1));
}

TEST(HistogramFilter, SaysWhatIsWrong) {
  const Eigen::Vector2d half(.5, .5);
  CellTransition move = Eigen::Matrix2d::Identity().sparseView();
  EXPECT_REX_ERROR(predictCells(Eigen::Vector2d(.5, .4), move),
                   "belief: found probabilities that sum to 0.9");
  EXPECT_REX_ERROR(predictCells(Eigen::Vector2d(1.5, -.5), move),
                   "probabilities of cells: number 1: found -0.5, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(predictCells(Eigen::Vector3d(1, 0, 0), move), "columns of the transition");
  move.coeffRef(1, 1) = .5;
  EXPECT_REX_ERROR(predictCells(half, move), "transition from cell 1: found probabilities that sum to 0.5");
  move.coeffRef(1, 1) = 1.5;
  move.coeffRef(0, 1) = -.5;
  EXPECT_REX_ERROR(predictCells(half, move), "transition from cell 1: found a negative probability");
  move.coeffRef(0, 1) = std::nan("");
  EXPECT_REX_ERROR(predictCells(half, move),
                   "transition from cell 1: found a probability that is not finite");
  EXPECT_REX_ERROR(updateCells(half, Eigen::Vector3d(1, 1, 1)), "likelihoods: found a vector of size 3");
  EXPECT_REX_ERROR(predictCells(half, CellTransition(3, 2)),
                   "rows of the transition: found a vector of size 3");
  EXPECT_REX_ERROR(updateCells(half, Eigen::Vector2d(1, INFINITY)),
                   "likelihoods of cells: number 1: found inf, wanted a finite number, 0 or more");
  const std::vector<Eigen::VectorXd> never{half, Eigen::Vector2d(0, 0)};
  const std::vector<CellTransition> stay{Eigen::Matrix2d::Identity().sparseView()};
  EXPECT_REX_ERROR(smoothedCells(half, stay, never), "observation at time 1: found no cell that explains it");
  EXPECT_REX_ERROR(smoothedCells(half, {}, never), "transitions between the observations");
}

}  // namespace rex::histogram_filter_test
