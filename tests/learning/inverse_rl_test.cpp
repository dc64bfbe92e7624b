#include "learning/inverse_rl.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "learning/mdp.h"
#include "learning/random_mdp.h"
#include "support/expect_error.h"

namespace rex::inverse_rl_test {

struct Lesson {
  Mdp mdp{};
  Eigen::MatrixXd features{}, expert{};
  Eigen::VectorXd start{}, trueW{}, teacher{};
};

// Rooms of a slippery floor, of which some are worth something: one feature for each 2 x 2 cells.
Lesson rooms(Rng& rng) {
  Lesson lesson;
  lesson.mdp = gridWorld("......\n......\n......\n......\n......\n......", {.discount = .9, .slip = .3}).mdp;
  lesson.features = Eigen::MatrixXd::Zero(9, 36);
  for (int s = 0; s < 36; ++s) lesson.features(s / 12 * 3 + s % 6 / 2, s) = 1;
  lesson.start = Eigen::VectorXd::Constant(36, 1. / 36);
  lesson.trueW = rng.uniformVector(9, -1, 1).normalized();
  lesson.mdp.rewards.colwise() = lesson.features.transpose() * lesson.trueW;
  lesson.expert = deterministicPolicy(lesson.mdp, policyIteration(lesson.mdp).actions);
  lesson.teacher = featureExpectations(lesson.mdp, lesson.expert, lesson.features, lesson.start);
  lesson.mdp.rewards.setZero();
  return lesson;
}

TEST(InverseRl, IsAsGoodAsTheTeacher) {
  Rng rng(1);
  for (int round = 0; round < 10; ++round) {
    const Lesson lesson = rooms(rng);
    const InverseRlResult found = inverseRl(lesson.mdp, lesson.features, lesson.start, lesson.teacher);
    ASSERT_EQ(found.status, InverseRlStatus::kMatched) << found.message;
    EXPECT_LT((found.expectations - lesson.teacher).norm(), 1e-6 * lesson.teacher.norm());
    EXPECT_NEAR(found.shares.sum(), 1, 1e-12);
    EXPECT_EQ(found.shares.size(), static_cast<Eigen::Index>(found.policies.size()));
    for (std::size_t i = 1; i < found.margins.size(); ++i)
      EXPECT_LE(found.margins[i], found.margins[i - 1] + 1e-12);
    // One of the policies is as good by the rewards that nobody told.
    double best = -1e300;
    for (const Eigen::MatrixXd& policy : found.policies)
      best = std::max(
          best, lesson.trueW.dot(featureExpectations(lesson.mdp, policy, lesson.features, lesson.start)));
    EXPECT_GT(best, lesson.trueW.dot(lesson.teacher) - 1e-5);
    EXPECT_GT(found.margins.front(), .1);  // the uniform policy was not
  }
}

TEST(InverseRl, ExpectationsAreThoseOfEpisodes) {
  Rng rng(2);
  const Lesson lesson = rooms(rng);
  std::vector<std::vector<int>> demonstrations;
  for (int i = 0; i < 2000; ++i) {
    const int start = rng.index(36);
    demonstrations.push_back(mdpEpisode(lesson.mdp, lesson.expert, start, 150, rng).states);
  }
  const Eigen::VectorXd sampled = featureExpectations(demonstrations, lesson.features, .9);
  EXPECT_LT((sampled - lesson.teacher).norm(), .05 * lesson.teacher.norm());
  EXPECT_NEAR(sampled.sum(), 10, 1e-5);
  const InverseRlResult found = inverseRl(lesson.mdp, lesson.features, lesson.start, sampled);
  EXPECT_NE(found.status, InverseRlStatus::kNotConverged) << found.message;
  EXPECT_NEAR(lesson.trueW.dot(found.expectations), lesson.trueW.dot(sampled), found.margins.back() + 1e-9);
}

// Demonstrations that nothing can do: staying where nobody can stay.
TEST(InverseRl, SaysWhenNobodyCanDoThat) {
  Rng rng(3);
  const Lesson lesson = rooms(rng);
  const Eigen::VectorXd wish = 10 * Eigen::VectorXd::Unit(9, 4);
  const InverseRlResult found = inverseRl(lesson.mdp, lesson.features, lesson.start, wish);
  EXPECT_EQ(found.status, InverseRlStatus::kUnmatched);
  EXPECT_THAT(found.message, testing::HasSubstr("no policy matches the teacher: margin"));
  EXPECT_NEAR(found.w.norm(), 1, 1e-12);
  // Under w, no other policy is nearer.
  for (int i = 0; i < 200; ++i) {
    const Eigen::MatrixXd policy =
        deterministicPolicy(lesson.mdp, greedyActions(randomPolicy(lesson.mdp, rng)));
    EXPECT_GE(found.w.dot(wish - featureExpectations(lesson.mdp, policy, lesson.features, lesson.start)),
              found.margins.back() - 1e-5);
  }
  const InverseRlResult cut =
      inverseRl(lesson.mdp, lesson.features, lesson.start, lesson.teacher, {.maxIterations = 2});
  EXPECT_EQ(cut.status, InverseRlStatus::kNotConverged);
  EXPECT_THAT(cut.message, testing::HasSubstr("not converged: margin"));
}

TEST(InverseRl, RefusesWrongInput) {
  Rng rng(4);
  const Lesson lesson = rooms(rng);
  const auto refuses = [&](auto change, const char* text, const InverseRlOptions& options = {}) {
    Lesson bad = lesson;
    change(bad);
    EXPECT_REX_ERROR(inverseRl(bad.mdp, bad.features, bad.start, bad.teacher, options), text);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses([](Lesson& l) { l.mdp.discount = 1; }, "discount of inverse learning: found 1, wanted less than 1");
  refuses([](Lesson& l) { l.features.resize(0, 36); }, "features: found 0 x 36, wanted one column for each");
  refuses([&](Lesson& l) { l.features(2, 7) = nan; },
          "features of state 7: found entries that are not finite");
  refuses([](Lesson& l) { l.features.conservativeResize(9, 35); }, "columns of the features, one for each");
  refuses([](Lesson& l) { l.teacher.conservativeResize(8); }, "expectations of the teacher");
  refuses([&](Lesson& l) { l.teacher[3] = nan; }, "expectations of the teacher: number 3: found nan");
  refuses([](Lesson& l) { l.start *= 2; }, "start distribution: found probabilities that sum to 2");
  refuses([](Lesson&) {}, "tolerance of inverse learning: found 0, wanted a positive, finite number",
          {.tolerance = 0});
  refuses([](Lesson&) {}, "tolerance of inverse learning: found inf", {.tolerance = INFINITY});
  refuses([](Lesson&) {}, "maxIterations of inverse learning: found 0, wanted at least 1",
          {.maxIterations = 0});
  EXPECT_REX_ERROR(featureExpectations(std::vector<std::vector<int>>{}, lesson.features, .9),
                   "demonstrations: found none");
  EXPECT_REX_ERROR(featureExpectations({{1, 2}}, lesson.features, nan),
                   "discount: found nan, wanted a number");
  EXPECT_REX_ERROR(featureExpectations({{1, 2}, {36}}, lesson.features, .9),
                   "state of demonstration 1: found 36, wanted one of 0 to 35");
}

}  // namespace rex::inverse_rl_test
