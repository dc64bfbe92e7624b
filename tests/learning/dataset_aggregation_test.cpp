#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "learning/behavioural_cloning.h"
#include "support/expect_error.h"

namespace rex::dataset_aggregation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSteps = 200;
constexpr double kNoise = 0.1;

// A car in its lane, y' = y + u + noise; the expert steers back, and is never pushed while it demonstrates.
struct Lane {
  mutable bool isCalm = true;

  static VectorXd steered(const VectorArg& phi) { return VectorXd::Constant(1, -0.8 * phi[0]); }
  MatrixXd episode(const ActionOf& act, Rng& rng) const {
    MatrixXd visited(kSteps, 2);
    double y = 0;
    for (int t = 0; t < kSteps; ++t) {
      visited.row(t) << y, 1;
      y += act(visited.row(t).transpose())[0] + (isCalm ? 0 : kNoise * rng.normal());
    }
    isCalm = false;
    return visited;
  }
  ImitationTask task() const {
    return {steered, [this](const ActionOf& act, Rng& rng) { return episode(act, rng); }};
  }
  // The mean square of y at the end of 400 episodes.
  double meanSquare(const LinearClone& clone) const {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
      Rng rng(seed);
      const double y =
          episode([&](const VectorArg& phi) { return VectorXd(clone.weights.transpose() * phi); }, rng)(
              kSteps - 1, 0);
      sum += y * y;
    }
    return sum / 400;
  }
};

// What calm demonstrations do not show, a clone cannot do: it drifts as a random walk, whose variance is
// known, as is that of the expert.
TEST(DatasetAggregation, LearnsToRecoverWhereCloningDrifts) {
  const Lane lane;
  Rng rng(1);
  const std::vector<LinearClone> clones = aggregatedClones(lane.task(), {.rounds = 5}, rng);
  ASSERT_EQ(clones.size(), 5u);
  EXPECT_LT(clones[0].weights.norm(), 1e-12);
  EXPECT_NEAR(clones[4].weights(0, 0), -0.8, 1e-4);
  const double walk = kNoise * kNoise * (kSteps - 1), stays = kNoise * kNoise / (1 - 0.2 * 0.2);
  EXPECT_NEAR(lane.meanSquare(clones[0]), walk, 4 * walk * std::sqrt(2. / 400));
  EXPECT_NEAR(lane.meanSquare(clones[4]), stays, 4 * stays * std::sqrt(2. / 400));
}

TEST(DatasetAggregation, IsCloningInItsFirstRound) {
  const Lane lane;
  lane.isCalm = false;
  Rng rng(2), same(2);
  const LinearClone clone = aggregatedClones(lane.task(), {.rounds = 1, .ridge = 0}, rng)[0];
  const MatrixXd visited = lane.episode(Lane::steered, same);
  EXPECT_EQ(clone.weights, cloneLinear(visited, -0.8 * visited.col(0), 0).weights);
}

// The expert acts as often as its share says.
TEST(DatasetAggregation, MixesTheExpertIn) {
  int asked = 0, acted = 0;
  Rng rng(3);
  const ImitationTask task{[&](const VectorArg&) { return ++asked, VectorXd::Ones(1); },
                           [&](const ActionOf& act, Rng&) {
                             const int before = asked;
                             for (int i = 0; i < 1000; ++i) act(VectorXd::Ones(1));
                             acted = asked - before;
                             return MatrixXd::Ones(1, 1);
                           }};
  static_cast<void>(aggregatedClones(task, {.rounds = 1}, rng));
  EXPECT_EQ(acted, 1000);
  static_cast<void>(aggregatedClones(task, {.rounds = 3}, rng));
  EXPECT_NEAR(acted, 250, 4 * std::sqrt(1000 * 0.25 * 0.75));
  static_cast<void>(aggregatedClones(task, {.rounds = 2, .expertShare = 0}, rng));
  EXPECT_EQ(acted, 0);
}

TEST(DatasetAggregation, RefusesWhatCannotBe) {
  const Lane lane;
  Rng rng(1);
  EXPECT_REX_ERROR(static_cast<void>(aggregatedClones(lane.task(), {.rounds = 0}, rng)),
                   "imitation: rounds: found 0");
  EXPECT_REX_ERROR(static_cast<void>(aggregatedClones(lane.task(), {.episodes = 0}, rng)),
                   "imitation: episodes of a round: found 0");
  EXPECT_REX_ERROR(static_cast<void>(aggregatedClones(lane.task(), {.expertShare = 2}, rng)),
                   "imitation: share of the expert: found 2, wanted a number from 0 to 1");
  int columns = 0;
  const ImitationTask empty{Lane::steered, [](const ActionOf&, Rng&) { return MatrixXd(0, 2); }};
  EXPECT_REX_ERROR(static_cast<void>(aggregatedClones(empty, {}, rng)),
                   "imitation: episode: found no state, wanted one or more");
  const ImitationTask changing{Lane::steered,
                               [&](const ActionOf&, Rng&) { return MatrixXd::Ones(3, ++columns); }};
  EXPECT_REX_ERROR(static_cast<void>(aggregatedClones(changing, {}, rng)),
                   "imitation: features: found a vector of size 2, wanted size 1");
}

}  // namespace rex::dataset_aggregation_test
