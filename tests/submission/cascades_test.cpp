#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "submission/compiler_messages.h"

namespace rex::submission::cascades_test {

using grading::Group;
using grading::Outcome;

constexpr const char* kSource = R"(
double step(double x) { return -x; }  // like circle
static double twice(double x) { return step(step(x)); }
double circle(double x) { return twice(x); }
double other(double x) { return x; /* step */ }
int main() { step(1); }
)";

grading::CheckResult check(const std::string& id, const std::string& function,
                           Outcome status = Outcome::kFail, Group group = Group::kVisible) {
  return {.id = id, .group = group, .status = status, .message = "wrong.", .function = function};
}

std::vector<std::string> messagesAfter(std::vector<grading::CheckResult> checks) {
  explainCascades(checks, kSource);
  std::vector<std::string> messages;
  for (const grading::CheckResult& one : checks) messages.push_back(one.message);
  return messages;
}

TEST(Cascades, NameTheFunctionThatFailedBefore) {
  EXPECT_THAT(
      messagesAfter({check("a", "step"), check("b", "circle"), check("c", "other"), check("d", "circle")}),
      ::testing::ElementsAre("wrong.", "wrong. circle uses step, which fails above [a].", "wrong.",
                             "wrong. circle uses step, which fails above [a]."));
}

// The cause is known, so that no question guesses at it; the sentences end once.
TEST(Cascades, JoinSentences) {
  grading::CheckResult number = check("b", "circle"), question = number, bracket = number, word = number;
  number.message = "angle: got 0.2, wanted 3";
  question.message = "angle: got 0.2, wanted 3. Is 2. a factor? Or one of pi?";
  bracket.message = "stopped. (A check failed.)";
  word.message = "used more than 1024 MB of memory in circle";
  const std::string uses = " circle uses step, which fails above [a].";
  EXPECT_THAT(messagesAfter({check("a", "step"), number, question, bracket, word}),
              ::testing::ElementsAre("wrong.", number.message + "." + uses, number.message + "." + uses,
                                     bracket.message + uses, word.message + "." + uses));
}

TEST(Cascades, NeedAFailureBeforeThatStudentsCanSee) {
  EXPECT_EQ(messagesAfter({check("a", "step", Outcome::kPass), check("b", "circle")}).back(), "wrong.");
  EXPECT_EQ(messagesAfter({check("b", "circle"), check("a", "step")}).back(), "wrong.");
  EXPECT_EQ(messagesAfter({check("a", "step", Outcome::kFail, Group::kHidden), check("b", "circle")}).back(),
            "wrong.");
  EXPECT_EQ(messagesAfter({check("a", "step"), check("b", "circle", Outcome::kFail, Group::kHidden)}).back(),
            "wrong.");
  EXPECT_EQ(messagesAfter({check("a", ""), check("b", "circle")}).back(), "wrong.");
}

}  // namespace rex::submission::cascades_test
