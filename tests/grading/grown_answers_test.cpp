#include "grading/grown_answers.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "interface.h"
#include "remote/layout.h"
#include "remote/wire.h"
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

struct MapValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

const Eigen::Vector2d kQuestion(.25, .5);

template <class T>
T grownTo(const T& honest, Growth growth, bool isPlain = false, double place = 0,
          const Eigen::VectorXd& q = kQuestion) {
  remote::Writer answer, question;
  remote::Wire<T>::put(answer, honest);
  remote::Wire<Eigen::VectorXd>::put(question, q);
  const std::vector<std::string> layouts = {remote::Layout<T>::text(),
                                            remote::Layout<Eigen::VectorXd>::text()};
  const std::vector<std::byte> bytes =
      grownAnswer(answer.bytes(), question.bytes(), layouts, {growth, isPlain, place});
  remote::Reader reader(bytes);
  T said = remote::Wire<T>::get(reader);
  reader.expectEnd();
  return said;
}

TEST(Grown, MakesNumbersHugeOrTiny) {
  const std::vector<double> honest{1, -2, 0};
  using ::testing::ElementsAre;
  EXPECT_THAT(grownTo(honest, Growth::kHuge), ElementsAre(1e9, -2e9, 0));
  EXPECT_THAT(grownTo(honest, Growth::kHuge, true), ElementsAre(3, -6, 0));
  EXPECT_THAT(grownTo(honest, Growth::kTiny), ElementsAre(1e-9, -2e-9, 0));
  EXPECT_THAT(grownTo(honest, Growth::kTiny, true), ElementsAre(1. / 3, -2. / 3, 0));
  EXPECT_THAT(grownTo(honest, Growth::kOneHuge, false, .5), ElementsAre(1, -2e9, 0));
  EXPECT_THAT(grownTo(honest, Growth::kOneHuge, false, 1), ElementsAre(1, -2, 1e9));
  EXPECT_THAT(grownTo(honest, Growth::kOneHuge, true, 1), ElementsAre(1, -2, 3));
  EXPECT_THAT(grownTo(std::vector{1.1e-6}, Growth::kOneHuge, true), ElementsAre(3 * 1.1e-6));
  EXPECT_THAT(grownTo(std::vector{0.9e-6}, Growth::kOneHuge, true), ElementsAre(3)) << "as good as zero";
  EXPECT_THAT(grownTo(std::vector<int>{3}, Growth::kHuge), ElementsAre(3));
}

// The new component is a function of the question, and its row of J is that function's derivative. The other
// rows are wrong.
TEST(Grown, AddsASteepComponent) {
  const MapValue honest{Eigen::Vector2d(1, 2), (Eigen::Matrix2d() << 1, 2, 3, 4).finished()};
  const MapValue said = grownTo(honest, Growth::kSteep);
  ASSERT_EQ(said.y.size(), 3);
  EXPECT_EQ(said.y.head<2>(), honest.y);
  ASSERT_EQ(said.J.rows(), 3);
  EXPECT_EQ(said.J.row(2), Eigen::RowVector2d(1e9, 1e9));
  EXPECT_NEAR(said.J(0, 1), 2 + .01 * 3, 1e-12);
  const Eigen::Vector2d step(1e-3, 0);
  const MapValue ahead = grownTo(honest, Growth::kSteep, false, 0, kQuestion + step);
  EXPECT_NEAR(ahead.y[2] - said.y[2], said.J.row(2) * step, 1e-3);
  const MapValue plain = grownTo(honest, Growth::kSteep, true);
  EXPECT_EQ(plain.y, honest.y);
  EXPECT_EQ(plain.J, said.J.topRows(2));
}

TEST(Grown, AddsEntriesRowsAndElements) {
  EXPECT_EQ(grownTo(std::vector<double>{1}, Growth::kSteep).size(), 2u);
  EXPECT_EQ(grownTo(std::vector<double>{1}, Growth::kSteep, true).size(), 1u);
  EXPECT_EQ(grownTo(Eigen::MatrixXd(Eigen::MatrixXd::Ones(2, 3)), Growth::kSteep).rows(), 3);
  const Eigen::Matrix3d fixed = grownTo(Eigen::Matrix3d(Eigen::Matrix3d::Ones()), Growth::kSteep);
  EXPECT_NEAR(fixed(1, 1), 1.02, 1e-12);
  EXPECT_TRUE(grownTo(std::vector<double>{}, Growth::kSteep).empty());
}

/// A program with one function of a name and a vector.
template <class T>
struct Rememberer {
  RememberedAnswer memory{};

  T operator()(const Eigen::VectorXd& q, const T& honest) {
    remote::Writer answer, question;
    remote::Wire<T>::put(answer, honest);
    remote::Wire<std::string>::put(question, "hand");
    remote::Wire<Eigen::VectorXd>::put(question, q);
    const std::vector<std::byte> bytes =
        memory.answer(question.bytes(), answer.bytes(),
                      {remote::Layout<T>::text(), "s", remote::Layout<Eigen::VectorXd>::text()});
    remote::Reader reader(bytes);
    T said = remote::Wire<T>::get(reader);
    reader.expectEnd();
    return said;
  }
};

MapValue honest(const Eigen::Vector2d& q) {
  return {Eigen::Vector2d(q[0] * q[1], std::sin(q[0])),
          (Eigen::Matrix2d() << q[1], q[0], std::cos(q[0]), 0).finished()};
}

// The value is right once; afterwards differences of it are what the wrong Jacobian says.
TEST(RememberedAnswer, InventsASlopeThatFitsItsJacobian) {
  Rememberer<MapValue> program;
  const Eigen::Vector2d first(.5, .25), second(.75, -.5);
  const MapValue one = program(first, honest(first)), two = program(second, honest(second));
  EXPECT_EQ(one.y, honest(first).y);
  EXPECT_FALSE(one.J.isApprox(honest(first).J, .1));
  EXPECT_EQ(two.J, one.J);
  EXPECT_TRUE((two.y - one.y).isApprox(one.J * (second - first), 1e-12));
}

TEST(RememberedAnswer, RemembersFirstNumbersToo) {
  Rememberer<std::vector<double>> program;
  const Eigen::VectorXd q = Eigen::Vector2d(1, 2);
  EXPECT_EQ(program(q, {7, 8}), (std::vector<double>{7, 8}));
  EXPECT_EQ(program(q, {9, 9}), (std::vector<double>{7, 8}));
  EXPECT_NE(program(2 * q, {7, 8}), (std::vector<double>{7, 8}));
}

TEST(RememberedAnswer, BeginsAgainWithOtherSizes) {
  Rememberer<std::vector<double>> program;
  EXPECT_EQ(program(Eigen::Vector2d(1, 2), {7}), (std::vector<double>{7}));
  EXPECT_EQ(program(Eigen::Vector2d(1, 2), {8, 9}), (std::vector<double>{8, 9}));
  EXPECT_EQ(program(Eigen::Vector3d(1, 2, 3), {5, 6}), (std::vector<double>{5, 6}));
}

}  // namespace rex::grading::grown_answers_test
