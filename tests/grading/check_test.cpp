#include "grading/check.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grading/tolerance.h"
#include "remote/channel.h"

namespace rex::grading {
[[noreturn]] void failAssertion(const char* condition);  // of throwing_assertions.h, for checks alone
}

namespace rex::grading::check_test {

TEST(FailAssertion, QuotesTheCondition) {
  try {
    failAssertion("index >= 0 && index < size()");
    ADD_FAILURE();
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "sizes or indices do not fit (index >= 0 && index < size())");
  }
}

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

CheckResult judge(const std::function<void(Check&)>& run, Group group = Group::kVisible) {
  return Check({.id = "id", .part = "a", .title = "Title", .points = 10, .group = group}, 7).judge(run);
}

std::string messageOf(const std::function<void(Check&)>& run) {
  const CheckResult result = judge(run);
  EXPECT_EQ(result.status, Outcome::kFail);
  EXPECT_EQ(result.points, 0);
  return result.message;
}

std::string faultOf(const std::function<void(Check&)>& run) {
  try {
    static_cast<void>(judge(run));
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

remote::RemoteThrow thrown(remote::Thrown::Kind kind) {
  return {"f", {.kind = kind, .type = "E", .text = "angle 0.25"}};
}

TEST(Check, PassesWhenEveryRequirementHolds) {
  const CheckResult result = judge([](Check& check) {
    check.near("a", 1.0 + 1e-7, 1, 1e-6);
    check.near("b", Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones(), 0);
    check.near("c", Eigen::VectorXd(0), Eigen::VectorXd(0), 0);
    check.atMost("d", 1, 1);
    check.atLeast("e", 1, 1);
    check.shape("f", Eigen::MatrixXd::Zero(2, 3), 2, 3);
    check.that("g", true);
  });
  EXPECT_EQ(result.status, Outcome::kPass);
  EXPECT_EQ(result.points, 10);
  EXPECT_EQ(result.maxPoints, 10);
  EXPECT_EQ(result.message, "");
}

TEST(Check, KeepsRecordAndRemarkOfVisibleChecksThatPass) {
  const auto run = [](double value, double got) {
    return [=](Check& check) {
      check.record("first", 1);
      check.record("rides", value, "s", Check::Better::kMore);
      check.remark("One of two lasts.");
      check.atMost("size", got, 1);
    };
  };
  const CheckResult passed = judge(run(2.5, 0));
  ASSERT_TRUE(passed.record);
  EXPECT_EQ(passed.record->name, "rides");
  EXPECT_EQ(passed.record->value, 2.5);
  EXPECT_EQ(passed.record->unit, "s");
  EXPECT_TRUE(passed.record->isMoreBetter);
  EXPECT_EQ(passed.remark, "One of two lasts.");
  EXPECT_EQ(passed.message, "");
  EXPECT_FALSE(judge(run(kNan, 0)).record);
  const CheckResult failed = judge(run(2.5, 3)), hidden = judge(run(2.5, 0), Group::kHidden);
  EXPECT_FALSE(failed.record);
  EXPECT_EQ(failed.remark, "");
  EXPECT_FALSE(hidden.record);
  EXPECT_EQ(hidden.remark, "");
}

TEST(Check, SaysPropertyGotWantedToleranceUnitAndSeedAndKeepsTheInputApart) {
  const CheckResult result = judge([](Check& check) {
    check.input("q = 0");
    check.near("position", Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 3.5), 1e-3, "m");
  });
  EXPECT_EQ(result.message,
            "position: got (1, 2, 3) m, wanted (1, 2, 3.5) m, off by 0.5 m (tolerance 0.001 m) (seed 7)");
  EXPECT_EQ(result.property, "position");
  EXPECT_EQ(result.got, "(1, 2, 3) m");
  EXPECT_EQ(result.expected, "(1, 2, 3.5) m");
  EXPECT_EQ(result.tolerance, "0.001 m");
  EXPECT_EQ(result.input, "q = 0");
}

TEST(Check, ShowsTheValuesOfItsInput) {
  const CheckResult result = judge([](Check& check) {
    check.input("two tasks", {{"J", (Eigen::MatrixXd(2, 2) << 1, 2, 3, 4.5).finished()},
                              {"dy", Eigen::Vector2d(-1, 0)},
                              {"n", 2},
                              {"M", Eigen::MatrixXd::Zero(20, 3)}});
    check.that("it holds", false);
  });
  EXPECT_EQ(result.input, "two tasks: J = [1, 2; 3, 4.5], dy = (-1, 0), n = 2, M = 20 x 3 numbers");
}

TEST(Check, AsksWhatAppliesOfAnyRequirement) {
  const auto message = [](bool applies) {
    return messageOf([&](Check& check) {
      { const auto over = check.ask("Is it over?"); }
      const auto first = check.ask("Is it the first?", applies);
      const auto second = check.ask("Is it the second?");
      check.that("it holds", false);
    });
  };
  EXPECT_THAT(message(true), HasSubstr("(seed 7). Is it the first?"));
  EXPECT_THAT(message(false), HasSubstr("(seed 7). Is it the second?"));
}

TEST(Check, SaysIfAnInputCameBackUnchanged) {
  const auto message = [](const Eigen::Vector2d& got) {
    return messageOf([&](Check& check) {
      check.input("a point", {{"p", Eigen::Vector2d(3, 4)}, {"n", 2}});
      check.near("the point", got, Eigen::Vector2d(4, 7), 1e-9);
    });
  };
  EXPECT_THAT(message({3, 4}), HasSubstr("(seed 7). Your value is the input p, unchanged."));
  EXPECT_THAT(message({3, 5}), Not(HasSubstr("unchanged")));
  const std::string nothing = messageOf([&](Check& check) {
    check.input("a plant", {{"A", Eigen::Matrix2d::Zero().eval()}});
    check.near("the matrix", Eigen::Matrix2d::Zero().eval(), Eigen::Matrix2d::Identity().eval(), 1e-9);
  });
  EXPECT_THAT(nothing, Not(HasSubstr("unchanged"))) << "zero is what an untouched function returns";
}

TEST(Check, ComparesAnglesModuloAWholeTurn) {
  const double pi = std::numbers::pi;
  const auto compare = [&](double got) {
    return judge([&](Check& check) { check.nearAngle("heading", got, 3.1, 0.01); });
  };
  EXPECT_EQ(compare(3.1 - 2 * pi).status, Outcome::kPass);
  EXPECT_EQ(compare(3.1 + 4 * pi).status, Outcome::kPass);
  EXPECT_EQ(compare(-3).message,
            "heading: got -3 rad, wanted 3.1 rad, off by 0.183185 rad (tolerance 0.01 rad) (seed 7)");
  EXPECT_THAT(compare(std::nan("")).message, HasSubstr("not finite"));
}

TEST(Check, PrintsAsManyDigitsAsTellGotFromWanted) {
  const auto pair = [](const std::function<void(Check&)>& run) {
    const CheckResult result = judge(run);
    return result.got + " | " + result.expected;
  };
  EXPECT_EQ(pair([](Check& c) { c.near("x", 0.5, 0.50000001, 1e-9, "m"); }), "0.5 m | 0.50000001 m");
  EXPECT_EQ(pair([](Check& c) { c.near("x", 1, 1 + 1e-10, 0); }), "1 | 1.0000000001");
  EXPECT_EQ(pair([](Check& c) { c.near("x", Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 2 + 1e-15), 0); }),
            "(1, 2) | (1, 2.0000000000000009)");
  EXPECT_EQ(pair([](Check& c) { c.nearAngle("x", 1, 1 + 1e-8, 1e-9); }), "1 rad | 1.00000001 rad");
  EXPECT_EQ(pair([](Check& c) { c.atMost("x", 0.2000001, 0.2, "m"); }), "0.2000001 m | at most 0.2 m");
  EXPECT_EQ(pair([](Check& c) { c.atMost("x", 0.1234568, 0.12345678); }), "0.1234568 | at most 0.12345678");
  EXPECT_EQ(pair([](Check& c) { c.atLeast("x", 0.1999999, 0.2, "m"); }), "0.1999999 m | at least 0.2 m");
  const Signal signal = grading::overSteps(std::vector<Eigen::VectorXd>(2, Eigen::Vector2d(0.1, 0.2)));
  EXPECT_EQ(pair([&](Check& c) { c.atMostAlong("x", signal, 0.19999999); }),
            "(0.1, 0.2) at step 1 | at most 0.19999999");
  EXPECT_EQ(pair([&](Check& c) { c.atLeastAlong("x", signal, 0.10000001); }),
            "(0.1, 0.2) at step 1 | at least 0.10000001");
  const std::vector<Eigen::VectorXd> wanted(2, Eigen::Vector2d(0.1, 0.20000001));
  EXPECT_EQ(pair([&](Check& c) { c.nearAlong("x", signal, wanted, 1e-9); }),
            "(0.1, 0.2) at step 1 | (0.1, 0.20000001)");
  const CheckResult passed = judge([](Check& c) { c.atMost("x", 0.1 + 0.2, 0.1 + 0.2); });
  EXPECT_EQ(passed.worst.value, "0.3") << "as short as ever";
}

// A quantity that leaves its limit at 2 s, and is farthest beyond it at 4 s.
Signal leaving() {
  Signal signal{.axis = "time [s]"};
  for (const double value : {0.1, 0.2, 0.5, 0.4, 0.9})
    signal.add(static_cast<double>(signal.at.size()), value);
  return signal;
}

TEST(Check, NamesTheFirstAndTheWorstPlaceOfAMotion) {
  const auto atMost = [](Check& check) { check.atMostAlong("distance", leaving(), 0.3, "m"); };
  EXPECT_EQ(messageOf(atMost),
            "distance: got 0.5 m at time 2 s, wanted at most 0.3 m, at worst 0.9 m at time 4 s (seed 7)");
  const auto atLeast = [](Check& check) { check.atLeastAlong("clearance", leaving(), 0.15, "m"); };
  EXPECT_EQ(messageOf(atLeast), "clearance: got 0.1 m at time 0 s, wanted at least 0.15 m (seed 7)");
  const auto near = [](Check& check) {
    const std::vector<Eigen::VectorXd> wanted(5, Eigen::VectorXd::Constant(1, 0.2));
    check.nearAlong("height", leaving(), wanted, 0.1, "m");
  };
  EXPECT_EQ(messageOf(near),
            "height: got 0.5 m at time 2 s, wanted 0.2 m, off by 0.3 m (tolerance 0.1 m), at worst 0.7 m at "
            "time 4 s (seed 7)");
  EXPECT_EQ(judge([](Check& check) { check.atMostAlong("distance", leaving(), 0.9); }).status,
            Outcome::kPass);
  EXPECT_EQ(judge([](Check& check) { check.atLeastAlong("clearance", leaving(), 0.1); }).status,
            Outcome::kPass);
  EXPECT_EQ(messageOf([](Check& check) { check.atLeastAlong("clearance", leaving(), 0.101); }),
            "clearance: got 0.1 at time 0 s, wanted at least 0.101 (seed 7)");
  const CheckResult passed = judge([](Check& check) { check.atMostAlong("distance", leaving(), 1, "m"); });
  EXPECT_EQ(passed.worst.value, "0.9 m at time 4 s");
  EXPECT_EQ(passed.worst.limit, "at most 1 m");
}

TEST(Check, StopsAtTheFirstValueOfAMotionThatIsNotFinite) {
  Signal signal = leaving();
  signal.values[1][0] = std::nan("");
  EXPECT_EQ(messageOf([&](Check& check) { check.atMostAlong("distance", signal, 0.3, "m"); }),
            "distance: not finite: got nan m at time 1 s (seed 7)");
  EXPECT_EQ(messageOf([&](Check& check) { check.atLeastAlong("distance", signal, 0, "m"); }),
            "distance: not finite: got nan m at time 1 s (seed 7)");
}

TEST(Check, ComparesVectorsAlongAMotion) {
  const std::vector<Eigen::VectorXd> wanted(3, Eigen::Vector2d(1, 2));
  std::vector<Eigen::VectorXd> got = wanted;
  got[1][1] = 5;
  EXPECT_EQ(
      messageOf([&](Check& check) { check.nearAlong("posture", grading::overSteps(got), wanted, 0, "rad"); }),
      "posture: got (1, 5) rad at step 2, wanted (1, 2) rad, off by 3 rad (tolerance 0 rad) (seed 7)");
}

TEST(Check, PlotsWhatFailedAlongAMotionBeforeWhatItShows) {
  const Figure aside{.title = "aside"};
  const auto plots = [&](Film film) {
    Check check({.id = "c", .points = 1}, 7);
    static_cast<void>(check.judge([&](Check& stated) {
      const auto shown =
          stated.show([&] { return Evidence{.figures = {aside}, .film = film, .moment = 0.1}; });
      stated.atMostAlong("distance", leaving(), 0.3, "m");
    }));
    return check.evidence().value();
  };
  const Evidence evidence = plots({{.time = 1}, {.time = 2}, {.time = 3}});
  ASSERT_EQ(evidence.figures.size(), 2u);
  EXPECT_EQ(evidence.figures[0].title, "distance");
  EXPECT_EQ(evidence.figures[0].series.at(0).y, (std::vector{0.1, 0.2, 0.5, 0.4, 0.9}));
  EXPECT_EQ(evidence.figures[0].verticalLines.at(0).at, 2);
  EXPECT_EQ(evidence.figures[0].horizontalLines.at(0).at, 0.3);
  EXPECT_EQ(evidence.figures[1].title, "aside");
  EXPECT_DOUBLE_EQ(evidence.moment, 2);  // half of the film, as 2 s is of the motion
}

TEST(FaultyCheck, MeasuresMotionsThatFit) {
  const auto faulty = [](const Signal& signal, const std::vector<Eigen::VectorXd>& wanted) {
    EXPECT_THROW(judge([&](Check& check) { check.nearAlong("x", signal, wanted, 1); }), std::logic_error);
  };
  faulty({}, {});
  faulty(leaving(), {});
  faulty(leaving(), std::vector<Eigen::VectorXd>(5, Eigen::Vector2d(0, 0)));
  faulty(leaving(), std::vector<Eigen::VectorXd>(5, Eigen::VectorXd::Constant(1, std::nan(""))));
}

TEST(Check, NamesTheWorstEntryOfAMatrix) {
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(3, 4);
  wanted(2, 1) = 5;
  EXPECT_THAT(messageOf([&](Check& check) { check.near("J", Eigen::MatrixXd::Zero(3, 4), wanted, 1e-9); }),
              HasSubstr("got 0 at (2, 1), wanted 5 at (2, 1)"));
}

TEST(Check, RefusesWhatIsNotFiniteOrHasAnotherShape) {
  EXPECT_THAT(messageOf([](Check& check) { check.near("x", kNan, 0, 1e300); }),
              HasSubstr("x: not finite: got nan"));
  EXPECT_THAT(messageOf([](Check& check) { check.near("x", kInfinity, 0, 1e300); }), HasSubstr("not finite"));
  EXPECT_THAT(messageOf([](Check& check) { check.atMost("x", kNan, 1); }), HasSubstr("not finite"));
  EXPECT_THAT(messageOf([](Check& check) { check.atMost("x", -kInfinity, 1); }), HasSubstr("not finite"));
  EXPECT_THAT(messageOf([](Check& check) { check.atLeast("x", kInfinity, 1); }), HasSubstr("not finite"));
  EXPECT_THAT(messageOf([](Check& check) { check.shape("J", Eigen::MatrixXd::Constant(3, 2, kNan), 3, 2); }),
              HasSubstr("J: not finite: got nan at (0, 0)"));
  const auto wrongShape = [](Check& check) {
    check.near("J", Eigen::MatrixXd(3, 7), Eigen::MatrixXd::Zero(3, 27), 1);
  };
  EXPECT_THAT(messageOf(wrongShape), HasSubstr("J: wrong shape: got 3 x 7, wanted 3 x 27"));
}

TEST(Check, ComparesWithLimits) {
  EXPECT_THAT(messageOf([](Check& check) { check.atMost("error", 0.3, 0.1, "m"); }),
              HasSubstr("error: got 0.3 m, wanted at most 0.1 m"));
  EXPECT_THAT(messageOf([](Check& check) { check.atLeast("gain", 1, 2); }),
              HasSubstr("got 1, wanted at least 2"));
  EXPECT_EQ(messageOf([](Check& check) { check.that("the path starts at q0", false); }),
            "the path starts at q0: does not hold (seed 7)");
}

TEST(Check, HidesInputAndNumbersOfHiddenChecks) {
  const CheckResult result = judge(
      [](Check& check) {
        check.input("secret");
        check.near("position", 0.123, 4.56, 1e-3, "m");
      },
      Group::kHidden);
  EXPECT_EQ(result.message, "position: does not hold");
  EXPECT_EQ(result.got + result.expected + result.tolerance + result.input, "");
}

TEST(Check, EndsAtTheFirstFailure) {
  bool reached = false;
  static_cast<void>(judge([&](Check& check) {
    check.that("no", false);
    reached = true;
  }));
  EXPECT_FALSE(reached);
}

TEST(Cases, GiveCreditInProportionAndNameTheFirstThatFails) {
  const CheckResult result = judge([](Check& check) {
    check.forEachCase(8, [&](int k) { check.that("not 2 or 5", k != 2 && k != 5 && k != 6); });
  });
  EXPECT_EQ(result.status, Outcome::kFail);
  EXPECT_EQ(result.points, 6);  // 10 x 5 / 8, rounded down
  EXPECT_EQ(result.message, "5 of 8 cases hold; case 3: not 2 or 5: does not hold (seed 7)");
}

TEST(Cases, NameTheOneThatIsFurthestBeyondItsLimit) {
  const std::vector<double> values = {0.5, 3, 8, 2};
  const CheckResult result = judge([&](Check& check) {
    check.forEachCase(4, [&](int k) { check.atMost("error", values[static_cast<std::size_t>(k)], 1, "m"); });
  });
  EXPECT_EQ(result.message, "1 of 4 cases hold; case 3: error: got 8 m, wanted at most 1 m (seed 7)");
  EXPECT_EQ(result.worst.property, "error");
  EXPECT_EQ(result.worst.value, "8 m");
  EXPECT_EQ(result.worst.limit, "at most 1 m");
  EXPECT_EQ(result.worst.caseNumber, 3);
  EXPECT_EQ(result.cases, 4);
  EXPECT_EQ(result.casesHeld, 1);
}

TEST(Check, GoesBackToTheOuterOfTwoUsualMistakes) {
  const Eigen::Vector2d wanted(1, 2);
  const auto message = messageOf([&](Check& check) {
    const auto outer = check.suspectUsualMistake(-wanted, wanted, 1e-6);
    { const auto inner = check.suspectUsualMistake(wanted, wanted, 1e-6); }
    check.that("it holds", false);
  });
  EXPECT_THAT(message, HasSubstr("opposite sign"));
}

TEST(Check, AsksAboutUsualMistakesAndThoseThatTheAuthorSuspects) {
  const Eigen::Vector2d wanted(1, 2), start(3, 5);
  const auto answer = [&](const Eigen::Vector2d& got) {
    return [&, got](Check& check) {
      const auto unmoved = check.suspect("Is S never moved?", start);
      check.near("posture", got, wanted, 1e-6, "rad");
    };
  };
  EXPECT_EQ(messageOf(answer(start)),
            "posture: got (3, 5) rad, wanted (1, 2) rad, off by 3 rad (tolerance 1e-06 rad) (seed 7). Is S "
            "never moved?");
  EXPECT_THAT(messageOf(answer(-wanted)), HasSubstr("(seed 7). Your value has the opposite sign"));
  EXPECT_THAT(messageOf(answer(Eigen::Vector2d(4, 4))), ::testing::EndsWith("(seed 7)"));
  EXPECT_THAT(judge(answer(start), Group::kHidden).message, "posture: does not hold");
  EXPECT_THAT(
      messageOf([&](Check& check) { check.near("row", wanted.transpose(), wanted, 1e-6); }),
      HasSubstr("wrong shape: got 1 x 2, wanted 2 x 1 (seed 7). Your value is the wanted one transposed."));
  EXPECT_THAT(messageOf([&](Check& check) {
                { const auto unmoved = check.suspect("Is S never moved?", start); }
                check.near("posture", start, wanted, 1e-6);
              }),
              Not(HasSubstr("never moved")))
      << "the suspicion has ended";
  EXPECT_THAT(messageOf([&](Check& check) {
                const auto rounded = check.suspect("Is it rounded?", wanted + Eigen::Vector2d(5e-6, 0));
                check.near("posture", wanted + Eigen::Vector2d(5e-6, 0), wanted, 1e-6);
              }),
              Not(HasSubstr("rounded")))
      << "it hardly differs from the wanted value";
}

TEST(Check, KnowsMistakesInAnglesModuloAWholeTurn) {
  const double turn = 2 * std::numbers::pi;
  for (const double turns : {-2., 0., 1.}) {
    const auto ask = [&](double suspected, bool isPassed) {
      return messageOf([&](Check& check) {
        const auto outside = check.suspect("Outside?", isPassed ? 0.7 : suspected);
        const std::vector<Mistake> mistakes{{"Passed?", isPassed ? suspected : 0.7}};
        check.nearAngle("heading", 3.2 + turns * turn, 3.1, 1e-3, mistakes);
      });
    };
    EXPECT_THAT(ask(3.2, true), ::testing::EndsWith(". Passed?")) << turns;
    EXPECT_THAT(ask(3.2 - turn, false), ::testing::EndsWith(". Outside?")) << turns;
    EXPECT_THAT(ask(3.3, true), ::testing::EndsWith("(seed 7)")) << turns;
  }
  EXPECT_THAT(messageOf([&](Check& check) {
                check.nearAngle("heading", 3.105, 3.1, 1e-3, {{"A turn more?", 3.105 + turn}});
              }),
              ::testing::EndsWith("(seed 7)"))
      << "it hardly differs from the wanted angle";
  EXPECT_THAT(messageOf([&](Check& check) {
                check.near("x", 0.2 + turn, 0, 1e-3, {{"Plain?", 0.2}});
              }),
              ::testing::EndsWith("(seed 7)"))
      << "numbers have no turns";
}

TEST(Check, AsksAboutTheFirstMistakeThatExplainsAValue) {
  const auto questionOf = [](double got, double tolerance = 1e-6) {
    const std::vector<Mistake> mistakes{
        {"Twice?", 2}, {"Nearly right?", 1 + 5e-6}, {"Two?", 2.}, {"Half?", .5}};
    const auto endOf = [](const std::string& text) { return text.substr(text.find("(seed 7)") + 8); };
    const std::string question =
        endOf(messageOf([&](Check& check) { check.near("x", got, 1, tolerance, mistakes); }));
    EXPECT_EQ(endOf(messageOf([&](Check& check) { check.nearAngle("x", got, 1, tolerance, mistakes); })),
              question);
    return question;
  };
  EXPECT_EQ(questionOf(2), ". Twice?");
  EXPECT_EQ(questionOf(.5 + 1e-7), ". Half?");
  EXPECT_EQ(questionOf(3.3), "");
  EXPECT_EQ(questionOf(1 + 5e-6), "") << "it hardly differs from the wanted value";
  EXPECT_EQ(questionOf(1 + 5e-6, 1e-8), ". Nearly right?");
  EXPECT_THAT(messageOf([&](Check& check) {
                const auto none = check.ask("");
                const auto number = check.suspect("Five?", 5);
                check.near("x", 5, 1, 1e-6);
              }),
              ::testing::EndsWith(". Five?"));
  EXPECT_THAT(messageOf([&](Check& check) {
                const auto none = check.ask("");
                const auto why = check.ask("Why?");
                check.that("it ends", false);
              }),
              ::testing::EndsWith(". Why?"));
}

// 0.09 of 0.1 is nearer to its limit than 0.5 of 1, and than 1.5 that should be at least 1.
TEST(Check, TellsHowNearToItsLimitTheWorstValueCame) {
  const auto judged = [](Group group) {
    return judge(
               [](Check& check) {
                 check.near("position", Eigen::Vector2d(1, 2.09), Eigen::Vector2d(1, 2), 0.1, "m");
                 check.atMost("time", 0.5, 1, "s");
                 check.atLeast("gain", 1.5, 1);
                 check.near("exact", 3, 3, 0);
                 check.that("it ends", true);
               },
               group)
        .worst;
  };
  EXPECT_EQ(judged(Group::kVisible).property, "position");
  EXPECT_EQ(judged(Group::kVisible).value, "off by 0.09 m");
  EXPECT_EQ(judged(Group::kVisible).limit, "at most 0.1 m");
  EXPECT_EQ(judged(Group::kVisible).caseNumber, 0);
  EXPECT_EQ(judged(Group::kHidden).property, "") << "hidden checks show no numbers";
  EXPECT_EQ(judge([](Check& check) { check.that("it ends", true); }).worst.property, "");
}

TEST(Check, CountsAnyExcessOverALimitOfZeroAsTheWorst) {
  const CheckResult result = judge([](Check& check) {
    check.forEachCase(3, [&](int k) {
      if (k == 0) check.atMost("large", 100, 1);
      if (k == 1) check.near("exact", 1e-9, 0, 0);
      if (k == 2) check.atMost("negative", 0.5, 0);
    });
  });
  EXPECT_THAT(result.message, HasSubstr("case 2: exact: got 1e-09, wanted 0"));
}

TEST(Cases, PutAThrowBeforeEveryMeasuredFailure) {
  const CheckResult result = judge([](Check& check) {
    check.forEachCase(2, [&](int k) {
      if (k == 1) throw thrown(remote::Thrown::Kind::kException);
      check.atMost("error", 1e9, 1);
    });
  });
  EXPECT_EQ(result.status, Outcome::kRuntimeError);
  EXPECT_EQ(result.function, "f");
  EXPECT_THAT(result.message, HasSubstr("case 2: threw E in f"));
}

TEST(Cases, DoNotShowTheInputOfTheCaseBefore) {
  const auto inputOf = [](int failing) {
    return judge([&](Check& check) {
             check.input("general");
             check.forEachCase(2, [&](int k) {
               if (k == 0) check.input("of case 1");
               check.that("holds", k != failing);
             });
           })
        .input;
  };
  EXPECT_EQ(inputOf(0), "of case 1");
  EXPECT_EQ(inputOf(1), "general");
}

TEST(Cases, LoseAllCreditWhenARequirementOutsideFails) {
  const CheckResult result = judge([](Check& check) {
    check.forEachCase(2, [&](int) { check.that("yes", true); });
    check.that("no", false);
  });
  EXPECT_EQ(result.points, 0);
}

TEST(Cases, FailAloneWhenTheStudentsFunctionThrows) {
  const auto throwOnce = [](Check& check) {
    check.forEachCase(2, [&](int k) {
      if (k == 1) throw thrown(remote::Thrown::Kind::kException);
      check.that("yes", true);
    });
  };
  const CheckResult result = judge(throwOnce);
  EXPECT_EQ(result.status, Outcome::kRuntimeError);
  EXPECT_EQ(result.points, 5);
  EXPECT_EQ(result.message, "1 of 2 cases hold; case 2: threw E in f: angle 0.25 (seed 7)");
  EXPECT_THAT(judge(throwOnce, Group::kHidden).message, Not(HasSubstr("0.25")));
  EXPECT_THROW(static_cast<void>(judge([](Check& check) {
                 check.forEachCase(2, [&](int) { throw thrown(remote::Thrown::Kind::kBadAlloc); });
               })),
               remote::RemoteThrow);
}

TEST(Cases, DrawTheSameNumbersWhateverTheCaseBeforeDrew) {
  const auto lastDraw = [](int drawnBefore) {
    double value = 0;
    static_cast<void>(judge([&](Check& check) {
      check.forEachCase(2, [&](int k) {
        check.that("yes", true);
        if (k == 0) check.rng().normalVector(drawnBefore);
        if (k == 1) value = check.rng().uniform();
      });
    }));
    return value;
  };
  EXPECT_EQ(lastDraw(0), lastDraw(5));
  Check one({.id = "one"}, 7), two({.id = "two"}, 7), other({.id = "one"}, 8);
  const double first = one.rng().uniform();
  EXPECT_NE(first, two.rng().uniform());
  EXPECT_NE(first, other.rng().uniform());
}

// A faulty check must never cost the student points.
TEST(FaultyCheck, Throws) {
  EXPECT_EQ(faultOf([](Check&) {}), "check 'id' states no requirement");
  EXPECT_EQ(faultOf([](Check& check) { check.forEachCase(0, [](int) {}); }), "check 'id' has no cases");
  EXPECT_EQ(faultOf([](Check& check) { check.forEachCase(1, [](int) {}); }),
            "check 'id' states no requirement in a case");
  for (const auto& run :
       std::vector<std::function<void(Check&)>>{[](Check& check) { check.near("x", 1, kNan, 1); },
                                                [](Check& check) { check.near("x", 1, 1, kNan); },
                                                [](Check& check) { check.atMost("x", 1, kInfinity); },
                                                [](Check& check) { check.atLeast("x", 1, kNan); }})
    EXPECT_EQ(faultOf(run), "check 'id' wants a value that is not finite");
}

// Evidence by a title, so that one can tell whose it is.
Evidence titled(const std::string& title) { return {.figures = {{.title = title}}}; }

std::string shownBy(const std::function<void(Check&)>& run, Group group = Group::kVisible) {
  Check check({.id = "id", .part = "a", .title = "Title", .points = 10, .group = group}, 7);
  static_cast<void>(check.judge(run));
  return check.evidence() ? check.evidence()->figures.front().title : "nothing";
}

// An answer that is wrong by a factor stays wrong however large it is, and never becomes a fault of the
// grader: also where squares of it overflow.
TEST(Check, FailsAnswersThatGrow) {
  for (const double factor : {1e3, 1e9, 1e15, 1e100, 1.4e154, 1e200, 1e300, -1e300}) {
    const Eigen::Vector3d wanted(1, -2, 3);
    const Eigen::VectorXd got = factor * wanted;
    const Eigen::MatrixXd many = factor * Eigen::MatrixXd::Ones(2, 9);
    EXPECT_EQ(judge([&](Check& check) { check.near("a", factor, 1, 1e-9); }).points, 0) << factor;
    EXPECT_EQ(judge([&](Check& check) { check.near("b", got, wanted, 1e-9 * wanted.norm()); }).points, 0);
    EXPECT_EQ(judge([&](Check& check) { check.near("c", many, Eigen::MatrixXd::Ones(2, 9), 1e-3); }).points,
              0);
    EXPECT_EQ(judge([&](Check& check) { check.atMost("d", std::abs(factor), 1); }).points, 0);
    EXPECT_EQ(judge([&](Check& check) { check.atMost("e", got.norm(), 1); }).points, 0);
    EXPECT_EQ(judge([&](Check& check) { check.atLeast("f", -std::abs(factor), -1); }).points, 0);
    EXPECT_EQ(judge([&](Check& check) { check.near("g", got.squaredNorm(), 14, 1e-9); }).points, 0);
  }
}

// A tolerance that an answer made so large would let everything pass.
TEST(FaultyCheck, HasATolerance) {
  EXPECT_THAT(faultOf([](Check& check) { check.near("a", 5, 1, kInfinity); }), HasSubstr("not finite"));
  EXPECT_THAT(faultOf([](Check& check) { check.near("a", 1, 1, kNan); }), HasSubstr("not finite"));
}

TEST(Check, KeepsWhatItShowsOfARequirementThatDoesNotHold) {
  int made = 0;
  const auto counted = [&] { return ++made, titled("hand"); };
  EXPECT_EQ(shownBy([&](Check& check) {
              const auto showing = check.show(counted);
              check.that("a", true);
            }),
            "nothing");
  EXPECT_EQ(made, 0);
  EXPECT_EQ(shownBy([&](Check& check) {
              const auto showing = check.show(counted);
              check.that("a", false);
            }),
            "hand");
  EXPECT_EQ(made, 1);
}

TEST(Check, ShowsNothingOfHiddenChecks) {
  const auto run = [](Check& check) {
    const auto showing = check.show([] { return titled("hand"); });
    check.near("a", Eigen::VectorXd::Zero(9), Eigen::VectorXd::Ones(9), .1);
  };
  EXPECT_EQ(shownBy(run), "hand");
  EXPECT_EQ(shownBy(run, Group::kHidden), "nothing");
}

TEST(Check, ShowsWhatIsInScope) {
  EXPECT_EQ(shownBy([](Check& check) {
              {
                const auto showing = check.show([] { return titled("before"); });
              }
              check.that("a", false);
            }),
            "nothing");
  EXPECT_EQ(shownBy([](Check& check) {
              const auto outer = check.show([] { return titled("outer"); });
              {
                const auto inner = check.show([] { return titled("inner"); });
              }
              check.that("a", false);
            }),
            "outer");
}

TEST(Check, ShowsTheWorstCase) {
  EXPECT_EQ(shownBy([](Check& check) {
              check.forEachCase(3, [&](int k) {
                const auto showing = check.show([&] { return titled(std::to_string(k)); });
                check.atMost("a", k == 1 ? 9 : 2, 1);
              });
            }),
            "1");
}

TEST(Check, ComparesManyNumbersByItself) {
  EXPECT_EQ(shownBy([](Check& check) {
              check.near("states", Eigen::MatrixXd::Zero(2, 9), Eigen::MatrixXd::Ones(2, 9), .1);
            }),
            "states");
  EXPECT_EQ(
      shownBy([](Check& check) { check.near("few", Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones(), .1); }),
      "nothing");
}

TEST(Check, IsNotAtFaultForWhatCannotBeShown) {
  const CheckResult result = judge([](Check& check) {
    const auto showing = check.show([]() -> Evidence { throw std::runtime_error("no film"); });
    check.that("a", false);
  });
  EXPECT_EQ(result.status, Outcome::kFail);
}

// An answer makes a tolerance larger up to a constant only.
TEST(SizeUpTo, EndsAtItsLimit) {
  EXPECT_EQ(sizeUpTo(100, 0), 1);
  EXPECT_EQ(sizeUpTo(100, -3), 4);
  EXPECT_EQ(sizeUpTo(100, 1e9), 100);
  EXPECT_EQ(sizeUpTo(100, Eigen::Vector3d(1, -5, 2)), 6);
  EXPECT_EQ(sizeUpTo(100, Eigen::Vector3d(1, -5e9, 2)), 100);
  EXPECT_EQ(sizeUpTo(100, Eigen::VectorXd()), 1);
}

// For the gates: what each requirement allows.
TEST(Check, TellsWhatItAllows) {
  std::vector<std::string> told;
  Check check({.id = "id", .points = 1}, 7);
  check.watchAllowances(
      [&](const Check::Allowance& one) { told.push_back(one.property + (one.limit == .5 ? " 0.5" : " ?")); });
  static_cast<void>(check.judge([](Check& requirements) {
    requirements.near("a", 1, 1, .5);
    requirements.near("b", Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 2), .5);
    requirements.nearAngle("c", 1, 1, .5);
    requirements.atMost("d", 0, .5);
    requirements.atLeast("at least", 1, .5);
    requirements.that("that", true);
    Signal signal{.axis = "step"};
    signal.add(1, 0);
    requirements.atMostAlong("e", signal, .5);
    requirements.nearAlong("f", signal, {Eigen::VectorXd::Zero(1)}, .5);
    requirements.near("g, which does not hold", 9, 1, .5);
  }));
  EXPECT_THAT(told, ::testing::ElementsAre("a 0.5", "b 0.5", "c 0.5", "d 0.5", "e 0.5", "f 0.5",
                                           "g, which does not hold 0.5"));
}

TEST(Check, AsksAFreshWorkerOnlyWhereOneCanBeStarted) {
  Check check({.id = "id", .points = 1}, 7);
  const auto ask = [](Check& requirements) { requirements.askFreshWorker([](remote::Caller&) {}); };
  EXPECT_THROW(static_cast<void>(check.judge(ask)), std::logic_error);
  int started = 0;
  check.startWorkersBy([&](const Check::Conversation&) { ++started; });
  static_cast<void>(check.judge([&](Check& requirements) {
    ask(requirements);
    requirements.that("asked", started == 1);
  }));
  EXPECT_EQ(started, 1);
}

}  // namespace rex::grading::check_test
