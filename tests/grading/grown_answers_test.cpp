#include "grading/grown_answers.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "interface.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::grading::grown_answers_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const GradingJob kJob = {.worker = ownFolder() / "tests" / "sample" / "good"};
const Eigen::Vector3d kTarget(.1, .2, .3);

RunnableCheck check(const std::string& id,
                    std::function<void(Check&, const Eigen::VectorXd&, Student&)> run) {
  return {.info = {.id = id, .part = "part", .points = 1, .group = Group::kVisible},
          .run = [run](Check& judge, remote::Caller& caller) {
            Student student(caller);
            run(judge, student.ikStep(Eigen::VectorXd::Zero(7), kTarget), student);
          }};
}

std::vector<GrownOutcome> outcomesOf(const RunnableCheck& one) {
  return giveGrownAnswers(std::vector{one}, kJob, Student::signature(), Student::layouts());
}

// Everything that grew, or gained points by its size.
std::string faultsOf(const RunnableCheck& one) {
  std::string faults;
  for (const GrownOutcome& outcome : outcomesOf(one)) {
    EXPECT_TRUE(outcome.changed || outcome.function != "ikStep") << toString(outcome.growth);
    if (!outcome.grew.empty()) faults += toString(outcome.growth) + ": " + outcome.grew + "\n";
    if (outcome.points > outcome.plainPoints) faults += toString(outcome.growth) + " gains\n";
  }
  return faults;
}

TEST(GrownAnswers, FindWhatGrowsWithThem) {
  EXPECT_THAT(faultsOf(check("fair", [](Check& judge, const Eigen::VectorXd& q,
                                        Student&) { judge.near("step", q, kTarget, 1e-9); })),
              IsEmpty());
  const std::string generous = faultsOf(check("generous", [](Check& judge, const auto& q, Student&) {
    judge.near("step", q.head(3), kTarget, 1e-9 * (1 + q.norm()));
  }));
  EXPECT_THAT(generous, HasSubstr("huge: what 'step' allows from 1.37e-09 to 0.374\n"));
  EXPECT_THAT(generous, HasSubstr("one huge: what 'step' allows"));
  EXPECT_THAT(generous, HasSubstr("steep: what 'step' allows"));
  EXPECT_THAT(faultsOf(check("limits", [](Check& judge, const auto& q,
                                          Student&) { judge.atMost("third", q[2], .3 * (1 + q.norm())); })),
              HasSubstr("huge: what 'third' allows"));
  EXPECT_THAT(faultsOf(check("asks",
                             [](Check& judge, const auto& q, Student& student) {
                               for (int k = 0; k < std::min(q.norm(), 100.); ++k)
                                 judge.near("square", student.square(k), k * k, 1e-9);
                               judge.near("step", q, kTarget, 1e-9);
                             })),
              HasSubstr("questions instead of 2"));
  EXPECT_THAT(faultsOf(check("cases",
                             [](Check& judge, const auto& q, Student&) {
                               judge.forEachCase(1 + static_cast<int>(std::min(q.norm(), 100.)),
                                                 [&](int) { judge.near("step", q, kTarget, 1e-9); });
                             })),
              HasSubstr("huge: 101 cases instead of 1"));
}

TEST(GrownAnswers, FindWhatOnlySizeGains) {
  EXPECT_EQ(faultsOf(check("admires",
                           [](Check& judge, const auto& q, Student&) {
                             judge.that("step", q.norm() > 1e6 || (q - kTarget).norm() < 1e-9);
                           })),
            "huge gains\none huge gains\none huge gains\none huge gains\none huge gains\nsteep gains\n");
  // Nothing is changed in a zero.
  EXPECT_EQ(
      faultsOf(check("admires", [](Check& judge, const auto&,
                                   Student& student) { judge.near("square", student.square(0), 0, 1e-9); })),
      "");
  // Its size does not matter: a plain wrong answer passes, too.
  EXPECT_THAT(faultsOf(check("direction",
                             [](Check& judge, const auto& q, Student&) {
                               judge.near("direction", q.normalized()[2], kTarget.normalized()[2], 1);
                             })),
              IsEmpty());
}

// Four places are tried of three numbers, so at least one number is made huge twice.
TEST(GrownAnswers, TakeWhatOneNumberGainsAtOnePlaceForChance) {
  int most = 0;
  for (const int i : {0, 1, 2}) {
    const RunnableCheck lucky = check("lucky", [i](Check& judge, const auto& q, Student&) {
      judge.that("step",
                 q.size() == 3 && ((q - kTarget).norm() < 1e-9 || (q[i] > 1e6 && q.norm() < 1.01 * q[i])));
    });
    int gains = 0;
    for (const GrownOutcome& one : outcomesOf(lucky))
      gains += one.growth == Growth::kOneHuge && one.points > one.plainPoints ? 1 : 0;
    EXPECT_NE(gains, 1);
    most = std::max(most, gains);
  }
  EXPECT_GE(most, 2);
}

TEST(GrownAnswers, NeedAReferenceThatPasses) {
  EXPECT_REX_ERROR(
      outcomesOf(check("fails", [](Check& judge, const auto&, Student&) { judge.that("never", false); })),
      "the reference solution fails in fails: found never: does not hold (seed 1)");
}

}  // namespace rex::grading::grown_answers_test
