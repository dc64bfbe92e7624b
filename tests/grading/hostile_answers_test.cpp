#include "grading/hostile_answers.h"

#include <array>
#include <bit>
#include <cmath>
#include <csignal>
#include <limits>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grading/answer_value.h"
#include "interface.h"
#include "remote/layout.h"
#include "remote/wire.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::grading::hostile_answers_test {

using ::testing::HasSubstr;

const GradingJob kJob = {.worker = ownFolder() / "tests" / "sample" / "good"};

RunnableCheck check(const std::string& id, std::function<void(Check&, Student&)> run) {
  return {.info = {.id = id, .part = "part", .points = 1, .group = Group::kVisible},
          .run = [run](Check& judge, remote::Caller& caller) {
            Student student(caller);
            run(judge, student);
          }};
}

const Eigen::Vector3d kTarget(.1, .2, .3);

Eigen::VectorXd step(Student& student) { return student.ikStep(Eigen::VectorXd::Zero(7), kTarget); }

double entry(const Eigen::VectorXd& x, std::size_t k) {
  return std::vector<double>(x.begin(), x.end()).at(k);
}

// What a check should not be is found: one that computes before it looks, one that is easily pleased.
TEST(HostileAnswers, FindCarelessChecks) {
  const std::vector<RunnableCheck> checks = {
      check("careful", [](Check& judge, Student& s) { judge.near("step", step(s), kTarget, 1e-9); }),
      check("careless", [](Check& judge, Student& s) { judge.that("third", entry(step(s), 2) == .3); }),
      check("easy", [](Check& judge, Student& s) { judge.atMost("step", step(s).norm(), 1); }),
      check("falls", [](Check& judge, Student& s) {
        const Eigen::VectorXd got = step(s);
        if (got.size() > 100) std::raise(SIGSEGV);
        judge.near("step", got, kTarget, 1e-9);
      })};
  const std::vector<HostileOutcome> outcomes =
      giveHostileAnswers(checks, kJob, Student::signature(), Student::layouts(), 1120);
  EXPECT_EQ(outcomes.size(), checks.size() * static_cast<std::size_t>(Hostility::kCount));
  for (const HostileOutcome& one : outcomes) {
    SCOPED_TRACE(one.check + " " + toString(one.hostility));
    EXPECT_EQ(one.crash.empty(), one.check != "falls" || one.hostility != Hostility::kHuge);
    if (one.crash.empty()) {
      EXPECT_GE(one.answers, 20);
    }
    if (one.check == "careful") {
      EXPECT_EQ(one.mostPoints, 0);
      EXPECT_EQ(one.unjudged, 0);
    }
    if (one.check == "easy" && one.hostility == Hostility::kZero) {
      EXPECT_EQ(one.mostPoints, 1);
    }
    if (one.check == "careless" && one.hostility == Hostility::kEmpty) {
      EXPECT_EQ(one.unjudged, one.runs);
      EXPECT_THAT(one.exception, HasSubstr("vector::_M_range_check"));
    }
  }
}

// The layouts say that ikStep takes a generator; a target has as many bytes, and these are the state of one.
TEST(HostileAnswers, FindGeneratorsThatGiveTheSeed) {
  constexpr std::uint64_t kSeed = 5365457349091663883u;  // the state begins as a vector of size 3 x 1 does
  const std::array<std::uint64_t, 4> state = Rng(kSeed).state();
  ASSERT_EQ(state[0], (std::uint64_t{1} << 32) + 3);
  const auto target = std::bit_cast<std::array<double, 3>>(std::array{state[1], state[2], state[3]});
  CallLayouts layouts = Student::layouts();
  for (std::vector<std::string>& ofFunction : layouts)
    for (std::string& layout : ofFunction)
      if (layout == "M3,1,d") layout = "r";
  const auto stepTo = [](const Eigen::Vector3d& to) {
    return check("step", [to](Check& judge, Student& s) {
      judge.shape("step", s.ikStep(Eigen::VectorXd::Zero(3), to), 3, 1);
    });
  };
  const auto attack = [&](const Eigen::Vector3d& to) {
    return giveHostileAnswers(std::vector{stepTo(to)}, kJob, Student::signature(), layouts, 14).size();
  };
  EXPECT_EQ(attack(kTarget), 14u);
  EXPECT_REX_ERROR(attack(Eigen::Vector3d::Map(target.data())),
                   "step: the generator handed to ikStep gives the seed of the case when run backwards");
}

TEST(Lies, FindChecksThatAreEasilyPleased) {
  const auto points = [](const RunnableCheck& one) {
    std::vector<int> all;
    for (const FalseAnswerOutcome& outcome :
         runAdversarially(std::vector{one}, kJob, Student::signature(), Student::layouts()))
      all.push_back(outcome.points);
    return all;
  };
  const auto squares = [](Check& judge, Student& s, std::vector<double> values) {
    for (const double x : values) judge.near("square", s.square(x), x * x, 1e-9);
  };
  // In the order zeros, constant, last answer, echo, memory.
  EXPECT_EQ(points(check("fair",
                         [&](Check& judge, Student& s) {
                           squares(judge, s, {2, 3});
                         })),
            (std::vector{0, 0, 0, 0, 0}));
  EXPECT_EQ(points(check("one", [&](Check& judge, Student& s) { squares(judge, s, {1}); })),
            (std::vector{0, 0, 0, 1, 0}))
      << "a constant is an answer to another question, and a memory answers its first one honestly";
  EXPECT_EQ(points(check("zero",
                         [&](Check& judge, Student& s) {
                           squares(judge, s, {0, 0});
                         })),
            (std::vector{1, 1, 1, 1, 0}));
  EXPECT_EQ(points(check("steady",
                         [&](Check& judge, Student& s) {
                           static_cast<void>(s.square(2));
                           squares(judge, s, {2, 2});
                         })),
            (std::vector{0, 0, 1, 0, 0}));
}

// Of a check with cases, lies get what the cases are worth that held by lies.
TEST(Lies, GetThePointsOfTheirCases) {
  RunnableCheck one = check("cases", [](Check& judge, Student& s) {
    judge.forEachCase(4, [&](int k) {
      // Zeros please case 0, and 1 to 3 are asked for nothing.
      if (k == 0) judge.near("square", s.square(0), 0, 1e-9);
      if (k > 0) judge.that("yes", true);
    });
  });
  one.info.points = 4;
  const auto outcomes = runAdversarially(std::vector{one}, kJob, Student::signature(), Student::layouts());
  EXPECT_EQ(outcomes.front().points, 4) << "who lies once, lies in all cases after it";
}

// What a check asks a fresh worker, no memory knows.
TEST(Lies, KnowNoMoreThanTheirWorker) {
  const auto pointsOfMemory = [](bool isFresh) {
    const RunnableCheck one = check("differences", [&](Check& judge, Student& s) {
      const double slope = s.square(3) - s.square(2);
      judge.near("difference", s.square(3) - s.square(2), slope, 1e-9);
      if (!isFresh) return;
      judge.askFreshWorker([&](remote::Caller& caller) {
        Student stranger(caller);
        judge.near("another square", stranger.square(5), 25, 1e-9);
        judge.near("the same square", stranger.square(3), s.square(3), 1e-9);
      });
    });
    return runAdversarially(std::vector{one}, kJob, Student::signature(), Student::layouts()).back().points;
  };
  EXPECT_EQ(pointsOfMemory(false), 1);
  EXPECT_EQ(pointsOfMemory(true), 0);
}

struct Sample {
  std::vector<double> list;
  Eigen::MatrixXd matrix;
  Eigen::Vector3d place;
  std::optional<int> chosen;
  bool yes = true;
  std::string text;
};

const Sample kHonest = {.list = {1, 2, 3, 4},
                        .matrix = Eigen::MatrixXd::Constant(2, 3, 5),
                        .place = {1, 2, 3},
                        .chosen = 4,
                        .text = "t"};

Sample spoiltBy(Hostility hostility) {
  remote::Writer writer;
  remote::Wire<Sample>::put(writer, kHonest);
  Rng rng(3);
  const std::vector<std::byte> bytes =
      corruptedAnswer(writer.bytes(), remote::Layout<Sample>::text(), hostility, rng);
  remote::Reader reader(bytes);
  Sample sample = remote::Wire<Sample>::get(reader);
  reader.expectEnd();
  return sample;
}

TEST(Spoilt, IsOfTheSameType) {
  for (int k = 0; k < static_cast<int>(Hostility::kCount); ++k)
    EXPECT_NO_THROW(spoiltBy(static_cast<Hostility>(k))) << toString(static_cast<Hostility>(k));
  EXPECT_TRUE(spoiltBy(Hostility::kEmpty).list.empty());
  EXPECT_EQ(spoiltBy(Hostility::kEmpty).matrix.size(), 0);
  EXPECT_FALSE(spoiltBy(Hostility::kEmpty).chosen);
  EXPECT_EQ(spoiltBy(Hostility::kHuge).list.size(), 20000u);
  EXPECT_EQ(spoiltBy(Hostility::kHuge).matrix.rows(), 300);
  EXPECT_TRUE(std::isnan(spoiltBy(Hostility::kNotANumber).place[2]));
  EXPECT_TRUE(std::isinf(spoiltBy(Hostility::kInfinite).matrix(1, 2)));
  EXPECT_GE(std::abs(spoiltBy(Hostility::kOverflowing).list[0]), 1e199);
  EXPECT_EQ(spoiltBy(Hostility::kDenormal).list[3], std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(spoiltBy(Hostility::kZero).place, Eigen::Vector3d::Zero());
  EXPECT_FALSE(spoiltBy(Hostility::kZero).yes);
  EXPECT_EQ(spoiltBy(Hostility::kConstant).list, std::vector<double>(4, 1.5));
  EXPECT_EQ(spoiltBy(Hostility::kShifted).chosen, 5);
  EXPECT_THAT(spoiltBy(Hostility::kPermuted).list, ::testing::UnorderedElementsAre(1, 2, 3, 4));
  EXPECT_NE(spoiltBy(Hostility::kPermuted).list, kHonest.list);
  EXPECT_NE(spoiltBy(Hostility::kRagged).list.size(), 0u);
}

TEST(Spoilt, RefusesBytesOfAnotherLayout) {
  Rng rng;
  const std::vector<std::byte> bytes(9);
  for (const char* layout : {"d", "[d]", "(dd)", "M-1,1,d", "i4", "x", "s", "r", "?d", "i"})
    EXPECT_REX_ERROR(corruptedAnswer(bytes, layout, Hostility::kZero, rng),
                     "an answer does not match its layout");
}

TEST(SizeOfValue, EndsWhereTheNextBegins) {
  remote::Writer writer;
  remote::Wire<Sample>::put(writer, kHonest);
  const std::size_t size = writer.bytes().size();
  remote::Wire<double>::put(writer, 1);
  EXPECT_EQ(sizeOfValue(writer.bytes(), remote::Layout<Sample>::text()), size);
  EXPECT_REX_ERROR(sizeOfValue(writer.bytes().first(3), "d"), "an answer does not match its layout");
}

}  // namespace rex::grading::hostile_answers_test
