#include "authoring/killed_mutants.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "support/file_text.h"
#include "support/template_exercise.h"

namespace rex::authoring::killed_mutants_test {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

class KilledMutants : public TemplateExercise {
 protected:
  GateResult passMutants() const { return pass("mutants"); }
};

// No check turns by more than 99 rad.
TEST_F(KilledMutants, AreAllButThoseThatChangeNothing) {
  const std::string solution = fileText(exercise() / "solution.cpp"),
                    line = "const double s = std::sin(angle);";
  std::string idle = solution;
  ASSERT_NE(idle.find(line), idle.npos);
  write("solution.cpp", idle.replace(idle.find(line), line.size(),
                                     "const double s = std::sin(angle) + (angle > 99 ? 9 : 0);"));
  const GateResult open = passMutants();
  EXPECT_FALSE(open.passed);
  EXPECT_THAT(open.message, AllOf(HasSubstr("solution.cpp:14:45: comparison: const double s = "
                                            "std::sin(angle) + (angle > 99 ? 9 : 0); -> const double s = "
                                            "std::sin(angle) + (angle >= 99 ? 9 : 0);"),
                                  Not(HasSubstr("solution.cpp:13")), Not(HasSubstr("solution.cpp:15"))));
  EXPECT_THAT(open.note, Not(HasSubstr("equal")));
}

TEST_F(KilledMutants, AreAllOfTheTemplate) {
  write("equal_mutants.tsv",
        "const double c = std::cos(angle);\tconst double c = std::sin(angle);\tnot graded\n"
        "return a;\treturn -(a);\tthere is none\n");
  const GateResult listed = passMutants();
  EXPECT_EQ(listed.message, "equal_mutants.tsv:2: no mutant is 'return a;' -> 'return -(a);'");
  EXPECT_THAT(listed.note,
              AllOf(StartsWith("made "), HasSubstr(" 0 survived, "), EndsWith("; 1 equal: not graded")));
}

// Whatever the sign of an angle or of a point, its distance from the origin is the same.
TEST_F(KilledMutants, ShowWhichChecksNoneNeeds) {
  write("solution.cpp", R"(#include "exercise.h"

Eigen::Vector2d turned(const Eigen::Vector2d& p, double angle) { return Eigen::Rotation2Dd(-angle) * p; }

Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  // <solution rotated>
  return turned(p, -angle);
  // <todo>
  //| return p;
  // </solution>
}

int main() {}
)");
  const GateResult result = passMutants();
  EXPECT_TRUE(result.passed) << result.message;
  EXPECT_THAT(result.note, StartsWith("made 3 mutants of 3: 2 killed, 0 survived, 1 do not compile; "));
  EXPECT_THAT(result.note, EndsWith(" s; no mutant needs keeps-length"));
}

TEST(DrawnMutants, FollowAFixedSeed) {
  std::vector<Mutant> all(40);
  for (int k = 0; k < 40; ++k) all[k].line = k;
  const std::vector<Mutant> ten = drawnMutants(all, 10), more = drawnMutants(all, 20);
  const auto lines = [](const std::vector<Mutant>& mutants) {
    std::vector<int> numbers;
    for (const Mutant& mutant : mutants) numbers.push_back(mutant.line);
    return numbers;
  };
  std::vector<int> first = lines(more);
  EXPECT_EQ(std::set<int>(first.begin(), first.end()).size(), 20u);
  EXPECT_GT(*std::max_element(first.begin(), first.end()), 30);
  first.resize(10);
  EXPECT_EQ(lines(ten), first);
  EXPECT_THAT(drawnMutants(all, 100), SizeIs(40));
}

TEST(EqualMutants, AreReadLineByLine) {
  const std::vector<EqualMutant> all =
      readEqualMutants("# Comment.\n\na < b\ta <= b\tThey are never equal.\n", "equal_mutants.tsv");
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(all[0].before, "a < b");
  EXPECT_EQ(all[0].after, "a <= b");
  EXPECT_EQ(all[0].reason, "They are never equal.");
  EXPECT_EQ(all[0].line, 3);
  for (const char* text : {"a\tb\n", "a\tb\tc\td\n", "\n\tb\tc\n", "a\tb\t\n"}) {
    try {
      static_cast<void>(readEqualMutants(text, "equal_mutants.tsv"));
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("equal_mutants.tsv:")) << text;
    }
  }
}

}  // namespace rex::authoring::killed_mutants_test
