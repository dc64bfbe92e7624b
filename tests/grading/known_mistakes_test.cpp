#include "grading/known_mistakes.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::grading::known_mistakes_test {

using ::testing::HasSubstr;
using ::testing::Not;

/// An answer of one number.
Sketch answer(double x) {
  return {
      .isWhole = x == std::round(x), .form = 7, .size = std::abs(x), .sums = {0.5 * x, -0.25 * x, 0.75 * x}};
}

/// The answers of f, or another function, to questions 0, 1, ...
std::vector<SketchedCall> calls(const std::vector<double>& answers, const std::string& function = "f") {
  std::vector<SketchedCall> all;
  for (std::size_t k = 0; k < answers.size(); ++k)
    all.push_back({.function = function, .key = 100 * function.size() + k, .answer = answer(answers[k])});
  return all;
}

/// Two mistakes that check "one" cannot tell apart, and others.
const SketchedChecks kRight{{"one", calls({0.5, 1.5, 2.5})}, {"two", calls({3.5, 4.5})}};
const std::vector<SketchedMistake> kMistakes{
    {"Sign?", {{"one", calls({-0.5, -1.5, -2.5})}, {"two", calls({-3.5, -4.5})}}},
    {"Sign in one?", {{"one", calls({-0.5, -1.5, -2.5})}, {"two", calls({3.5, 4.5})}}},
    {"Half?", {{"one", calls({0.25, 1.5, 2.5})}, {"two", calls({3.5, 4.5})}}},
    {"", {{"one", calls({0.5, 1.5, 9.5})}, {"two", calls({3.5, 4.5})}}},
    {"Ends?", {{"one", calls({0.75})}, {"two", {}}}},
    {"Always one?", {{"one", calls({1, 1, 1})}, {"two", calls({1, 1})}}}};

std::string recognised(const SketchedChecks& seen, const std::string& check = "one") {
  return recognisedMistake(knownMistakes(kRight, kMistakes), seen, check, "f");
}

TEST(Recognition, NamesTheOneMistakeThatExplainsAllAnswers) {
  EXPECT_EQ(recognised({{"one", calls({0.25, 1.5, 2.5})}}), "Half?");
  EXPECT_EQ(recognised({{"one", calls({0.25 + 1e-8, 1.5, 2.5})}}), "Half?") << "rounded in another way";
  EXPECT_EQ(recognised({{"one", calls({0.25})}}), "Half?") << "the check ended early";
  EXPECT_EQ(recognised({{"one", calls({0.75, 8.5, 9.5})}}), "Ends?") << "the mistake does not get that far";
}

TEST(Recognition, LooksAtOtherChecksIfSeveralMistakesFit) {
  EXPECT_EQ(recognised({{"one", calls({-0.5, -1.5, -2.5})}, {"two", calls({-3.5, -4.5})}}), "Sign?");
  EXPECT_EQ(recognised({{"one", calls({-0.5, -1.5, -2.5})}, {"two", calls({3.5, 4.5})}}), "Sign in one?");
  EXPECT_EQ(recognised({{"one", calls({-0.5, -1.5, -2.5})}}), "") << "nobody knows";
  EXPECT_EQ(recognised({{"one", calls({-0.5, -1.5, -2.5})}, {"two", calls({7.5})}}), "") << "none of them";
}

TEST(Recognition, BlamesNoFunctionThatAnswersLikeTheSolution) {
  EXPECT_EQ(recognised(kRight), "");
  EXPECT_EQ(recognised({{"one", calls({0.5})}}), "") << "a mistake that would answer the same";
  EXPECT_EQ(recognised({}), "");
  EXPECT_EQ(recognised({{"other", calls({-0.5})}}, "other"), "");
}

TEST(Recognition, IsSilentAboutMistakesThatNobodyKnows) {
  EXPECT_EQ(recognised({{"one", calls({0.25, 1.5, 7.5})}}), "") << "half of a known one";
  EXPECT_EQ(recognised({{"one", calls({7.5, 1.5, 2.5})}}), "");
  EXPECT_EQ(recognised({{"one", calls({0.5, 1.5, 9.5})}}), "") << "known, but without a question";
}

TEST(Recognition, WantsMoreOfWholeNumbersAndOfThrows) {
  EXPECT_EQ(recognised({{"one", calls({1, 1, 1})}, {"two", calls({1, 1})}}), "Always one?");
  EXPECT_EQ(recognised({{"one", calls({1, 1, 1})}, {"two", calls({3.5, 4.5})}}), "");
  std::vector<SketchedCall> thrown = calls({0});
  thrown[0].answer = {.threw = true};
  const KnownMistakes known = knownMistakes(kRight, {{"Index?", {{"one", thrown}}}});
  EXPECT_EQ(recognisedMistake(known, {{"one", thrown}}, "one", "f"), "");
}

TEST(Recognition, BeginsWithTheFunctionThatTheReportNames) {
  std::vector<SketchedCall> right = calls({0.5}), wrong = calls({0.25});
  for (const SketchedCall& call : calls({1.5}, "gg")) right.push_back(call);
  for (const SketchedCall& call : calls({7.5}, "gg")) wrong.push_back(call);
  const std::vector<SketchedCall> onlyF{wrong[0], right[1]}, onlyG{right[0], wrong[1]};
  const KnownMistakes known =
      knownMistakes({{"one", right}}, {{"F?", {{"one", onlyF}}}, {"G?", {{"one", onlyG}}}});
  EXPECT_EQ(recognisedMistake(known, {{"one", wrong}}, "one", "gg"), "G?");
  EXPECT_EQ(recognisedMistake(known, {{"one", wrong}}, "one", "f"), "F?");
  EXPECT_EQ(recognisedMistake(known, {{"one", onlyF}}, "one", "gg"), "F?") << "gg is right";
  EXPECT_EQ(recognisedMistake(known, {{"one", wrong}}, "one", ""), "F?");
}

TEST(Recognition, AcceptsMistakesWithTheSameQuestion) {
  const SketchedMistake one{"Half?", {{"one", calls({0.25, 1.5, 2.5})}}};
  EXPECT_EQ(recognisedMistake(knownMistakes(kRight, {one, one}), one.checks, "one", "f"), "Half?");
}

TEST(KnownMistakes, KeepFewCallsAndOnlyThoseThatTellSomething) {
  std::vector<double> right, wrong;
  for (int k = 0; k < 50; ++k) {
    right.push_back(k + 0.5);
    wrong.push_back(k < 10 ? k + 0.5 : 2 * k);
  }
  const KnownMistakes known = knownMistakes({{"one", calls(right)}, {"two", calls({1.5})}},
                                            {{"Twice?", {{"one", calls(wrong)}, {"two", calls({1.5})}}}});
  ASSERT_EQ(known.checks.size(), 1) << "no mistake changes anything in check two";
  const std::vector<KnownCall>& kept = known.checks.at("one");
  EXPECT_EQ(kept.size(), 6);
  EXPECT_EQ(kept.front().right.key, 110) << "the first wrong answer";
}

TEST(KnownMistakes, AreReadAsTheyWereWritten) {
  const KnownMistakes known = knownMistakes(kRight, kMistakes);
  const std::string text = toText(known);
  const KnownMistakes back = readKnownMistakes("# a comment\n\n" + text, "k.tsv");
  EXPECT_EQ(toText(back), text);
  EXPECT_EQ(differenceBetween(known, back), "");
  EXPECT_THAT(text, HasSubstr("mistake\tHalf?\n"));
  EXPECT_THAT(text, HasSubstr("wrong\t0,1\treal 00000007 0.5 -0.25 0.125 -0.375\nwrong\t2\t"));
  EXPECT_THAT(text, HasSubstr("wrong\t4\tnone\n"));
  SketchedChecks seen{{"one", calls({0.5, -3})}};
  seen["one"][1].answer = {.threw = true};
  EXPECT_EQ(toText(readSketchedChecks(toText(seen), "s.tsv")), toText(seen));
}

TEST(KnownMistakes, SayWhereTheirFileIsMalformed) {
  constexpr const char* kSketch = "real 0000000a 1 2 3 4";
  const std::string wantedSketch =
      ", wanted 'threw', or 'real' or 'whole', a hexadecimal number and four numbers";
  const std::string wantedLine =
      ", wanted 'mistake', 'check', 'call' or 'wrong' and what belongs to it, separated by tabs";
  const std::string call = fmt::format("mistake\tWhy?\ncheck\ta\ncall\tf\t1f\t{}\n", kSketch);
  const std::vector<std::pair<std::string, std::string>> kTexts = {
      {"# head\nmistakes\tWhy?\n", "k.tsv:2: a line of sketches: found 'mistakes'" + wantedLine},
      {"mistake\tWhy?\t1\n", "k.tsv:1: a line of sketches: found 'mistake'" + wantedLine},
      {"call\tf\t1\tthrew\n", "k.tsv:1: a line of sketches: found 'call', wanted 'check' before it"},
      {"check\ta\nwrong\t0\tnone\n", "k.tsv:2: a line of sketches: found 'wrong', wanted 'call' before it"},
      {"check\ta\ncall\tf\t1g\tthrew\n",
       "k.tsv:2: a line of sketches: found '1g', wanted a hexadecimal number"},
      {"check\ta\ncall\tf\t1\tthrows\n", "k.tsv:2: a line of sketches: found 'throws'" + wantedSketch},
      {"check\ta\ncall\tf\t1\treal 1 2 3 4\n",
       "k.tsv:2: a line of sketches: found 'real 1 2 3 4'" + wantedSketch},
      {"check\ta\ncall\tf\t1\treal x 1 2 3 4\n",
       "k.tsv:2: a line of sketches: found 'real x 1 2 3 4'" + wantedSketch},
      {"check\ta\ncall\tf\t1\treal 1 nan 2 3 4\n",
       "k.tsv:2: a line of sketches: found 'real 1 nan 2 3 4'" + wantedSketch},
      {call + "wrong\t0,1\tnone\n",
       "k.tsv:4: a line of sketches: found '1', wanted the number of a mistake above"},
      {call + "wrong\t\tnone\n",
       "k.tsv:4: a line of sketches: found '', wanted the number of a mistake above"},
  };
  for (const auto& [text, message] : kTexts)
    EXPECT_REX_ERROR(static_cast<void>(readKnownMistakes(text, "k.tsv")), message);
}

TEST(KnownMistakes, AreComparedUpToRounding) {
  const KnownMistakes known = knownMistakes(kRight, kMistakes);
  const auto differenceOf = [&](const auto& change) {
    KnownMistakes other = known;
    change(other);
    return differenceBetween(known, other);
  };
  EXPECT_EQ(differenceOf([](KnownMistakes& k) { k.checks["one"][0].right.answer.size += 1e-9; }), "");
  EXPECT_EQ(differenceOf([](KnownMistakes& k) { k.checks["one"][0].right.answer.size += 1e-3; }),
            "check 'one': other answers of f");
  EXPECT_EQ(differenceOf([](KnownMistakes& k) { k.checks["one"][0].wrong.pop_back(); }),
            "check 'one': other answers of f");
  EXPECT_EQ(differenceOf([](KnownMistakes& k) { k.checks["two"].pop_back(); }),
            "check 'two': another number of calls");
  EXPECT_EQ(differenceOf([](KnownMistakes& k) { k.checks.erase("two"); }), "check 'two'");
  EXPECT_EQ(differenceOf([](KnownMistakes& k) { k.checks["new"]; }), "check 'new'");
  EXPECT_EQ(differenceOf([](KnownMistakes& k) { k.questions.pop_back(); }), "other questions");
}

}  // namespace rex::grading::known_mistakes_test
