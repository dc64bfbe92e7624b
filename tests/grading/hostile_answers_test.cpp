#include "grading/hostile_answers.h"

#include <cmath>
#include <csignal>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "interface.h"
#include "remote/wire.h"
#include "support/expect_error.h"

namespace rex::grading::hostile_answers_test {

using ::testing::HasSubstr;

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
  const std::vector<std::byte> bytes = spoilt(writer.bytes(), remote::Layout<Sample>::text(), hostility, rng);
  remote::Reader reader(bytes);
  Sample sample = remote::Wire<Sample>::get(reader);
  reader.expectEnd();
  return sample;
}

TEST(Spoilt, IsOfTheSameType) {
  for (int k = 0; k < static_cast<int>(Hostility::count); ++k)
    EXPECT_NO_THROW(spoiltBy(static_cast<Hostility>(k))) << toString(static_cast<Hostility>(k));
  EXPECT_TRUE(spoiltBy(Hostility::empty).list.empty());
  EXPECT_EQ(spoiltBy(Hostility::empty).matrix.size(), 0);
  EXPECT_FALSE(spoiltBy(Hostility::empty).chosen);
  EXPECT_EQ(spoiltBy(Hostility::huge).list.size(), 20000u);
  EXPECT_EQ(spoiltBy(Hostility::huge).matrix.rows(), 300);
  EXPECT_TRUE(std::isnan(spoiltBy(Hostility::notANumber).place[2]));
  EXPECT_TRUE(std::isinf(spoiltBy(Hostility::infinite).matrix(1, 2)));
  EXPECT_GE(std::abs(spoiltBy(Hostility::overflowing).list[0]), 1e199);
  EXPECT_EQ(spoiltBy(Hostility::denormal).list[3], std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(spoiltBy(Hostility::zero).place, Eigen::Vector3d::Zero());
  EXPECT_FALSE(spoiltBy(Hostility::zero).yes);
  EXPECT_EQ(spoiltBy(Hostility::constant).list, std::vector<double>(4, 1.5));
  EXPECT_EQ(spoiltBy(Hostility::shifted).chosen, 5);
  EXPECT_THAT(spoiltBy(Hostility::permuted).list, ::testing::UnorderedElementsAre(1, 2, 3, 4));
  EXPECT_NE(spoiltBy(Hostility::permuted).list, kHonest.list);
  EXPECT_NE(spoiltBy(Hostility::ragged).list.size(), 0u);
}

TEST(Spoilt, RefusesBytesOfAnotherLayout) {
  Rng rng;
  const std::vector<std::byte> bytes(9);
  for (const char* layout : {"d", "[d]", "(dd)", "M-1,1,d", "i4", "x", "s", "r", "?d", "i"})
    EXPECT_REX_ERROR(spoilt(bytes, layout, Hostility::zero, rng), "an answer does not have its layout");
}

const GradeOptions kOptions = {.worker = std::filesystem::path(REX_BINARY_DIR) / "tests" / "sample" / "good",
                               .signature = Student::signature()};

RunnableCheck check(const std::string& id, std::function<void(Check&, Student&)> run) {
  return {.info = {.id = id, .part = "part", .points = 1, .group = Group::visible},
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
  const std::vector<HostileOutcome> outcomes = giveHostileAnswers(checks, kOptions, Student::layouts(), 1120);
  EXPECT_EQ(outcomes.size(), checks.size() * static_cast<std::size_t>(Hostility::count));
  for (const HostileOutcome& one : outcomes) {
    SCOPED_TRACE(one.check + " " + toString(one.hostility));
    EXPECT_EQ(one.crash.empty(), one.check != "falls" || one.hostility != Hostility::huge);
    if (one.crash.empty()) {
      EXPECT_GE(one.answers, 20);
    }
    if (one.check == "careful") {
      EXPECT_EQ(one.mostPoints, 0);
      EXPECT_EQ(one.unjudged, 0);
    }
    if (one.check == "easy" && one.hostility == Hostility::zero) {
      EXPECT_EQ(one.mostPoints, 1);
    }
    if (one.check == "careless" && one.hostility == Hostility::empty) {
      EXPECT_EQ(one.unjudged, one.runs);
      EXPECT_THAT(one.exception, HasSubstr("vector::_M_range_check"));
    }
  }
}

TEST(Lies, FindChecksThatAreEasilyPleased) {
  const auto points = [](const RunnableCheck& one) {
    std::vector<int> all;
    for (const LieOutcome& outcome : tellLies(std::vector{one}, kOptions, Student::layouts()))
      all.push_back(outcome.points);
    return all;
  };
  const auto squares = [](Check& judge, Student& s, std::vector<double> values) {
    for (const double x : values) judge.near("square", s.square(x), x * x, 1e-9);
  };
  // In the order zeros, constant, last answer, echo.
  EXPECT_EQ(points(check("fair",
                         [&](Check& judge, Student& s) {
                           squares(judge, s, {2, 3});
                         })),
            (std::vector{0, 0, 0, 0}));
  EXPECT_EQ(points(check("one", [&](Check& judge, Student& s) { squares(judge, s, {1}); })),
            (std::vector{0, 0, 0, 1}))
      << "a constant is an answer to another question";
  EXPECT_EQ(points(check("zero",
                         [&](Check& judge, Student& s) {
                           squares(judge, s, {0, 0});
                         })),
            (std::vector{1, 1, 1, 1}));
  EXPECT_EQ(points(check("steady",
                         [&](Check& judge, Student& s) {
                           static_cast<void>(s.square(2));
                           squares(judge, s, {2, 2});
                         })),
            (std::vector{0, 0, 1, 0}));
}

}  // namespace rex::grading::hostile_answers_test
