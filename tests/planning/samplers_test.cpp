#include "planning/samplers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "planning/wall.h"
#include "support/expect_error.h"

namespace rex::samplers_test {

// The share of proposals for which `is` holds.
double share(const Sampler& sampler, const Space& space,
             const std::function<bool(const Eigen::VectorXd&)>& is) {
  Rng rng(1);
  Eigen::VectorXd q(space.size());
  int hits = 0, proposals = 0;
  for (int i = 0; i < 200000; ++i) {
    if (!sampler(rng, q)) continue;
    ++proposals;
    hits += is(q) ? 1 : 0;
  }
  EXPECT_GT(proposals, 50);
  return static_cast<double>(hits) / proposals;
}

TEST(Samplers, GatherWhereTheyShould) {
  const PathProblem problem = wallWithHole(2, .1);
  const auto isInHole = [](const Eigen::VectorXd& q) {
    return q[0] > .45 && q[0] < .55 && std::abs(q[1] - .5) < .05;
  };
  const auto isNearWall = [](const Eigen::VectorXd& q) { return q[0] > .35 && q[0] < .65; };
  const auto isValid = [&](const Eigen::VectorXd& q) { return problem.allValid(q); };
  const Sampler gaussian = gaussianSampler(problem.space, problem.allValid, .03);
  const Sampler bridge = bridgeSampler(problem.space, problem.allValid, .1);
  EXPECT_EQ(share(gaussian, problem.space, isValid), 1);
  EXPECT_EQ(share(bridge, problem.space, isValid), 1);
  EXPECT_NEAR(share(uniformSampler(problem.space), problem.space, isInHole), .01, .002) << "its area";
  EXPECT_GT(share(gaussian, problem.space, isNearWall), .95);
  EXPECT_GT(share(bridge, problem.space, isInHole), .5);
}

// Steps of the samplers have the deviation that is asked for in the metric of the space, also of rotations.
TEST(Samplers, StepAsFarAsTheySay) {
  const Space space(
      {{.lower = -100, .upper = 100, .weight = 2}, {.kind = SpacePart::Kind::kQuaternion, .weight = .5}});
  std::vector<Eigen::VectorXd> asked;
  const AllValid everySecond = [&](const MatrixArg& Q) {
    asked.push_back(Q.col(0));
    return asked.size() % 2 == 1;
  };
  const Sampler sampler = gaussianSampler(space, everySecond, .05);
  Rng rng(2);
  Eigen::VectorXd q(5);
  double sum = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    while (!sampler(rng, q)) {  // a step beyond the bounds, seldom
    }
    sum += std::pow(space.distance(asked[asked.size() - 2], asked.back()), 2);
  }
  EXPECT_NEAR(sum / kCount, 4 * .05 * .05, .05 * .05 * 6 * std::sqrt(8. / kCount)) << "four dimensions";
}

TEST(Samplers, RefuseASpreadThatIsNone) {
  const PathProblem problem = wallWithHole(2, .1);
  EXPECT_REX_ERROR(gaussianSampler(problem.space, problem.allValid, 0),
                   "sigma of a sampler: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(bridgeSampler(problem.space, problem.allValid, NAN), "sigma of a sampler: found nan");
}

TEST(InformedSampler, ProposesAllThroughWhichAShorterWayMayLead) {
  const Space space = Space::box(Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1));
  const Eigen::Vector2d start(-.3, 0), goal(.3, 0);
  const Sampler sampler = informedSampler(space, start, goal, 1);
  Rng rng(1);
  Eigen::VectorXd q(2);
  int inside = 0;
  constexpr int kProposals = 20000;
  for (int i = 0; i < kProposals; ++i) {
    const bool isProposed = sampler(rng, q);
    // The ellipse with half axes 0.5 and 0.4.
    EXPECT_EQ(isProposed, std::pow(q[0] / .5, 2) + std::pow(q[1] / .4, 2) < 1);
    inside += isProposed ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(inside) / kProposals, M_PI * .5 * .4 / 4, .01);
  EXPECT_REX_ERROR(static_cast<void>(informedSampler(space, start, goal, .5)),
                   "length of a path: found 0.5, wanted at least 0.6, the distance from start to goal");
}

}  // namespace rex::samplers_test
