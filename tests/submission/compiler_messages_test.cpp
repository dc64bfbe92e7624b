#include "submission/compiler_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rex::submission::compiler_messages_test {

using grading::Group;
using grading::Outcome;

constexpr const char* kJson =
    R"([{"kind": "error", "children": [], "locations": [{"caret": {"line": 47, "file": "main.cpp", "column": 3}}], "message": "‘foo’ was not declared"},)"
    R"( {"kind": "note", "locations": [], "message": "a note"},)"
    R"( {"kind": "warning", "option": "-Wunused", "locations": [{"caret": {"line": 2, "file": "main.cpp", "column": 1}}], "message": "unused"},)"
    R"( {"kind": "fatal error", "locations": [], "message": "too\nbad"}])";

TEST(CompilerJson, MayBeOnSeveralLinesAsOfGcc14) {
  const std::string array =
      R"([{"kind": "warning",
  "message": "unused variable 'b'",
  "option": "-Wunused-variable",
  "children": [{"kind": "note", "message": "here", "locations": [{"caret": {"file": "main.cpp",
                                                                         "line": 9}}]}],
  "locations": [{"caret": {"file": "main.cpp",
                           "line": 1,
                           "column": 15}}],
  "escape-source": false}]
)";
  for (const std::string& text : {array, "driver: says\n" + array + "more\n", "[broken\n" + array}) {
    const auto messages = parseCompilerJson(text);
    ASSERT_EQ(messages.size(), 1u) << text;
    EXPECT_EQ(toString(messages.front()), "main.cpp:1:15: warning: unused variable 'b' [-Wunused-variable]");
  }
  EXPECT_TRUE(parseCompilerJson("[{\n}]\n[1,\n").empty());
}

TEST(ParseCompilerJson, KeepsErrorsAndWarnings) {
  const auto messages = parseCompilerJson(std::string(kJson) + "\ncompilation terminated.\n");
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(toString(messages[0]), "main.cpp:47:3: error: 'foo' was not declared");
  EXPECT_EQ(toString(messages[1]), "main.cpp:2:1: warning: unused [-Wunused]");
  EXPECT_EQ(toString(messages[2]), "error: too bad");
}

TEST(ParseCompilerJson, NamesTheFunctionThatCouldBeCalled) {
  const auto message = [](const std::string& notes) {
    return parseCompilerJson(
               R"([{"kind": "error", "locations": [], "message": "no matching function for call to ‘add(int)’", )"
               R"("children": [)" +
               notes + "]}]")
        .at(0)
        .message;
  };
  const std::string add = R"({"kind": "note", "message": "candidate: ‘void add(int, int)’"})",
                    expects =
                        R"(, {"kind": "note", "message": "  candidate expects 2 arguments, 1 provided"})";
  const std::string start = "no matching function for call to 'add(int)'";
  EXPECT_EQ(message(""), start);
  EXPECT_EQ(message(add), start + "; there is 'void add(int, int)'");
  EXPECT_EQ(message(add + expects), start + "; there is 'void add(int, int)', which takes 2 arguments");
  EXPECT_EQ(message(add + expects + ", " + add),
            start + "; there is 'void add(int, int)', which takes 2 arguments, and others");
  EXPECT_EQ(message(R"({"message": "candidate: )" + std::string(300, 'x') + "\"}" + expects), start);
}

TEST(ParseCompilerJson, SurvivesAnythingElse) {
  for (const char* text : {"", "[", "[3]", "[{\"kind\": 3}]", "g++: fatal error: Killed", "[\"\xff\"]"})
    EXPECT_TRUE(parseCompilerJson(text).empty()) << text;
}

TEST(NamesErrors, IsAQuickLook) {
  EXPECT_TRUE(namesErrors(kJson));
  EXPECT_TRUE(namesErrors(R"([{"kind": "fatal error", "message": "x.h: No such file or directory"}])"));
  EXPECT_TRUE(namesErrors("[]\nmain.cpp: Assembler messages:\nmain.cpp:2: Error: no such instruction\n"));
  for (const char* text : {"", "[]", R"([{"kind": "warning", "message": "error"}])",
                           "g++: fatal error: Killed signal terminated program cc1plus"})
    EXPECT_FALSE(namesErrors(text)) << text;
}

TEST(ParseCompilerText, KeepsErrors) {
  const auto messages = parseCompilerText(
      "main.cpp: In function 'f':\nmain.cpp:4:27:   required from here\nmain.cpp:5:9: error: bad: very\n"
      "main.cpp:5:9: note: here\nmain.cpp:1:10: fatal error: a.h: No such file\n: error: x\nerror: y\ng++: "
      "fatal error: z\n");
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(toString(messages[0]), "main.cpp:5:9: error: bad: very");
  EXPECT_EQ(toString(messages[1]), "main.cpp:1:10: error: a.h: No such file");
}

TEST(BlameMainFile, FindsTheLineThatInstantiated) {
  std::vector<grading::CompileDiagnostic> messages = {
      {"/usr/include/eigen3/Eigen/src/Core/Product.h", 115, 7, "error", "", "SIZES"}};
  blameMainFile(messages, "main.cpp",
                "main.cpp:9:1: error: other\n"
                "/usr/include/eigen3/Eigen/src/Core/Product.h: In instantiation of 'f':\n"
                "main.cpp:4:27:   required from here\n"
                "/usr/include/eigen3/Eigen/src/Core/Product.h:115:7: error: SIZES\n");
  EXPECT_EQ(toString(messages[0]), "main.cpp:4:27: error: SIZES (in Eigen/src/Core/Product.h:115)");
}

TEST(BlameMainFile, FindsTheLineThatIncluded) {
  std::vector<grading::CompileDiagnostic> messages = {{"own/exercise.h", 3, 1, "error", "", "bad"},
                                                      {"elsewhere.h", 3, 1, "error", "", "bad"}};
  blameMainFile(messages, "main.cpp",
                "In file included from own/a.h:3,\n"
                "                 from main.cpp:2:\n"
                "own/exercise.h:3:1: error: bad\n");
  EXPECT_EQ(toString(messages[0]), "main.cpp:2: error: bad (in exercise.h:3)");
  EXPECT_EQ(toString(messages[1]), "main.cpp: error: bad (in elsewhere.h:3)");
}

// The natural (K * x)(0) makes g++ 12 warn of a pointer in Eigen's memory; no line of the file changes that.
TEST(BlameMainFile, LeavesOutWarningsThatNoLineCaused) {
  std::vector<grading::CompileDiagnostic> messages = {
      {"eigen3/Memory.h", 203, 7, "warning", "-Wuse-after-free", "used"},
      {"main.cpp", 4, 1, "warning", "-Wunused", "x"},
      {"eigen3/Memory.h", 203, 7, "error", "", "bad"}};
  blameMainFile(messages, "main.cpp", "eigen3/Memory.h:203:7: warning: used\n");
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(toString(messages[0]), "main.cpp:4:1: warning: x [-Wunused]");
  EXPECT_EQ(messages[1].severity, "error");
}

TEST(ParseLinkerText, NamesEachFunctionOnce) {
  const auto messages = parseLinkerText(
      "/usr/bin/ld: main.o: in function `main':\n"
      "main.cpp:(.text+0xa): undefined reference to `reach(Eigen::Matrix<double, 3, 1, 0, 3, 1> const&)'\n"
      "main.cpp:(.text+0xf): undefined reference to `reach(Eigen::Matrix<double, 3, 1, 0, 3, 1> const&)'\n"
      "b.o: multiple definition of `serve()'; a.o: first defined here\n",
      "main.cpp");
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(toString(messages[0]), "main.cpp: error: 'reach' is declared but not defined here");
  EXPECT_EQ(toString(messages[1]),
            "main.cpp: error: 'serve' is defined, but the exercise already defines it");
}

// As g++ 12 and as 2.40 write it: of asm() in a function, of what the compiler wrote itself, of a full disk.
TEST(CompilerMessages, ReadsTheAssemblersText) {
  const auto messages = parseAssemblerText(
      "[]\nmain.cpp: Assembler messages:\nmain.cpp:2: Error: no such instruction: `foo bar'\n"
      "/tmp/ccMa6Nhw.s:17: Error: junk at end of line, first unrecognized character is `\"'\n"
      "/tmp/ccMa6Nhw.s: Fatal error: can't write 8 bytes to section .group of student.o: 'No space left on "
      "device'\n");
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(toString(messages[0]), "main.cpp:2: error: no such instruction: `foo bar'");
  EXPECT_EQ(toString(messages[1]), "error: junk at end of line, first unrecognized character is `\"'");
}

TEST(AdmitMessages, CutsAndShows) {
  std::vector<grading::CompileDiagnostic> messages(
      60, {"a\nb", 1, 1, "error", "x\u202Ey", std::string(100'000, 'm')});
  messages[0].message = "a\u2028b\x1b[2J\nmain.cpp:1:1: error: forged";
  messages[1].message = "\xff";
  EXPECT_TRUE(admitMessages(messages));
  ASSERT_EQ(messages.size(), 50u);
  EXPECT_EQ(toString(messages[0]),
            "a b:1:1: error: a\uFFFDb\uFFFD[2J main.cpp:1:1: error: forged [x\uFFFDy]");
  EXPECT_EQ(messages[1].message, "\uFFFD");
  EXPECT_EQ(messages[2].message.size(), 2000u);
  EXPECT_FALSE(admitMessages(messages));
}

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

}  // namespace rex::submission::compiler_messages_test
