// What students see after the first time, of one part, and of programs that do not end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "commands/built_project.h"
#include "support/paths.h"

namespace rex::cli::feedback_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class FeedbackTest : public BuiltProject {
 protected:
  void writeMain(const std::string& body) const {
    write(exercise() / "main.cpp",
          "#include \"exercise.h\"\n#include <cmath>\n#include <iostream>\n"
          "Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {\n" +
              body + "}\nint main() {\n  while (rotated({1, 0}, 1).x() < 9) continue;\n}\n");
  }
  static constexpr const char* kRight =
      "  return {std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y()};\n";
};

TEST_F(FeedbackTest, ShowsTheFirstMessageAndWhatChanged) {
  writeMain("  return 2 * p;\n");
  const std::string first = flat(rex({"test", "98"}).output);
  EXPECT_THAT(first, AllOf(HasSubstr("point after a quarter turn: got"),
                           HasSubstr("distance from the origin: got"), Not(HasSubstr("last test"))));
  fs::create_directories(out() / "arm");
  write(out() / "arm" / "0000.png", "a film of `rex run`");
  const std::string second = flat(rex({"test", "98"}).output);
  EXPECT_THAT(second, AllOf(HasSubstr("98-template/checks/quarter-turn.png"), Not(HasSubstr("0000.png"))));
  EXPECT_THAT(second, AllOf(HasSubstr("point after a quarter turn: got"),
                            Not(HasSubstr("distance from the origin: got")),
                            HasSubstr("No verdict has changed since the last test."),
                            HasSubstr("All messages: scripts/rex test 98-template --all")));
  EXPECT_THAT(flat(rex({"test", "98", "--all"}).output), HasSubstr("distance from the origin: got"));
  writeMain("  return p;\n");
  EXPECT_THAT(flat(rex({"test", "98"}).output),
              HasSubstr("These pass now: keeps-length, angles-add. The last test gave 0 points."));
  writeMain("  return p.x() == 1 && p.y() == 0 ? Eigen::Vector2d(0, 1) : Eigen::Vector2d(2 * p);\n");
  EXPECT_THAT(flat(rex({"test", "98"}).output),
              HasSubstr("These pass now: quarter-turn. These no longer pass: keeps-length, angles-add. "
                        "The last test gave 2 points."));
  writeMain(kRight);
  EXPECT_THAT(flat(rex({"test", "98"}).output), HasSubstr(" The last test gave 1 point. "));
}

TEST_F(FeedbackTest, TestsOnePartAndShowsWhatItsFunctionsPrint) {
  writeMain("  std::cout << \"a is \" << a << \"\\n\";\n" + std::string(kRight));
  const Ended part = rex({"test", "98", "--check", "rotate"});
  EXPECT_EQ(part.code, 0);
  EXPECT_THAT(part.output, AllOf(HasSubstr("[quarter-turn]"), HasSubstr("[angles-add, hidden]"),
                                 HasSubstr("Your functions printed:\n  a is 1.5708\n")));
  EXPECT_THAT(rex({"test", "98"}).output, Not(HasSubstr("a is")));
  EXPECT_THAT(
      flat(rex({"test", "98", "--check", "sideways"}).error),
      HasSubstr("no check is called 'sideways': wanted one of quarter-turn, keeps-length, angles-add"));
}

TEST_F(FeedbackTest, TestsTheChecksThatBlamedAFunction) {
  writeMain("  return p;\n");
  EXPECT_THAT(flat(rex({"test", "98", "--check", "rotated"}).error),
              HasSubstr("no check is called 'rotated'"));
  EXPECT_EQ(rex({"test", "98"}).code, 1);
  const Ended ended = rex({"test", "98", "--check", "rotated"});
  EXPECT_EQ(ended.code, 1) << ended.error;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("[quarter-turn]"), Not(HasSubstr("[keeps-length"))));
}

TEST_F(FeedbackTest, ListsNoPictureOfAnEarlierTest) {
  writeMain(kRight);
  const fs::path checks = out() / "checks";
  fs::create_directories(checks);
  write(checks / "old.png", "");
  EXPECT_THAT(rex({"test", "98"}).output, Not(HasSubstr("old.png")));
}

TEST_F(FeedbackTest, StopsAProgramThatDoesNotEndAndNamesTheLine) {
  writeMain(kRight);
  const Ended ended = rex({"run", "98", "--time-limit", "1"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.error,
              HasSubstr("The program was stopped after 1 s of CPU time; --time-limit S allows more."));
  EXPECT_THAT(ended.error,
              ::testing::ContainsRegex("After 1 s it is in line [4-8] of main.cpp, in (rotated|main)"));
}

TEST_F(FeedbackTest, ShowsMatricesInTheDebugger) {
  const fs::path folder = root() / "debugger";
  fs::create_directory(folder);
  write(folder / "main.cpp", R"(#include <Eigen/Core>
int look(const Eigen::MatrixXd& A, const Eigen::Vector3d& v) { return A.rows() + v.size(); }
int main() { return look((Eigen::MatrixXd(2, 2) << 1, 2, 3, 4.5).finished(), {0, -1, 0.5}); }
)");
  const std::string program = (folder / "program").string();
  ASSERT_TRUE(
      runProcess({"c++", "-g", "-O0", "-I/usr/include/eigen3", (folder / "main.cpp").string(), "-o", program})
          .ok());
  const ProcessResult run =
      runProcess({"gdb", "-q", "-batch", "-ex", "source " + sourcePath("share/gdb/eigen.py").string(), "-ex",
                  "break look", "-ex", "run", "-ex", "print A", "-ex", "print v", program});
  EXPECT_THAT(run.output,
              AllOf(HasSubstr("Eigen 2 x 2: \n  1 2\n  3 4.5"), HasSubstr("Eigen 3 x 1: 0 -1 0.5")))
      << run.error;
}

}  // namespace rex::cli::feedback_test
