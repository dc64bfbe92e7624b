#include "cli/student/check_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/student/test_run.h"

namespace rex::cli::check_order_test {

using grading::CheckResult;
using grading::Outcome;
using ::testing::ElementsAre;

CheckResult check(const std::string& id, const std::string& part, Outcome status = Outcome::kPass,
                  const std::string& function = "", double seconds = 0.1) {
  return {.id = id, .part = part, .title = id, .status = status, .function = function, .cpuSeconds = seconds};
}

const std::vector<CheckResult> kLast = {
    check("length", "norms"), check("search", "norms", Outcome::kFail, "searched", 20),
    check("mean", "beliefs", Outcome::kFail, "meanOf"),
    check("spread", "beliefs", Outcome::kFail, "spreadOf"), check("whole", "beliefs")};
constexpr const char* kBefore =
    "double meanOf(double x) { return x; }\ndouble spreadOf(double x) { return x; }\n"
    "double searched() { return 0; }\nint main() {}\n";

std::string with(const std::string& what, const std::string& instead) {
  std::string text = kBefore;
  return text.replace(text.find(what), what.size(), instead);
}

TEST(CheckOrder, BeginsWithWhatChangedAndEndsWithWhatIsSlow) {
  struct Row {
    std::string before, now;
    std::vector<std::string> ids;
    std::size_t changed;
  };
  const std::string spread = "spreadOf(double x) { return x; }", search = "searched() { return 0; }";
  for (const Row& row : std::vector<Row>{
           {"", kBefore, {"mean", "spread", "length", "whole", "search"}, 0},
           {kBefore, kBefore, {"mean", "spread", "length", "whole", "search"}, 0},
           {kBefore,
            with("main() {}", "main() { return 1; }"),
            {"mean", "spread", "length", "whole", "search"},
            0},
           {kBefore,
            "// a comment\n" + std::string(kBefore),
            {"mean", "spread", "length", "whole", "search"},
            0},
           {kBefore,
            with(spread, "spreadOf(double x) { return x * x; }"),
            {"spread", "mean", "whole", "length", "search"},
            3},
           {kBefore,
            with(search, "searched() { return 1; }"),
            {"search", "length", "mean", "spread", "whole"},
            2},
           {kBefore, "int main() { what is this", {"mean", "spread", "length", "whole", "search"}, 0}}) {
    const CheckOrder order = checkOrder(kLast, {.last = kLast, .before = row.before, .now = row.now});
    EXPECT_EQ(order.ids, row.ids) << row.now;
    EXPECT_EQ(order.changed, row.changed) << row.now;
  }
}

TEST(CheckOrder, TakesChecksThatTheLastTestDidNotHave) {
  const CheckOrder order = checkOrder(kLast, {.last = {kLast[0], check("gone", "norms")}, .now = kBefore});
  EXPECT_THAT(order.ids, ElementsAre("search", "mean", "spread", "whole", "length"));
}

TEST(StageText, SaysFirstWhatBecameOfTheChange) {
  grading::GradeResult soFar{.checks = kLast};
  for (CheckResult& one : soFar.checks) one.status.reset();
  const CheckOrder order{.ids = {"spread", "mean", "whole", "length", "search"}, .changed = 3};
  EXPECT_EQ(stageText(soFar, {}), "check 1 of 5, length");
  EXPECT_EQ(stageText(soFar, order), "check 1 of 5, spread");
  soFar.checks[3].status = Outcome::kPass;
  EXPECT_EQ(stageText(soFar, order), "spread ok, check 2 of 5, mean");
  soFar.checks[2].status = Outcome::kTimeLimit, soFar.checks[0].status = Outcome::kPass;
  EXPECT_EQ(stageText(soFar, order), "spread ok, mean FAIL, check 3 of 5, whole");
  for (CheckResult& one : soFar.checks) one.status = Outcome::kPass;
  EXPECT_EQ(stageText(soFar, order), "spread ok, mean ok, whole ok, looking again");
}

}  // namespace rex::cli::check_order_test
