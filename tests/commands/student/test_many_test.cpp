// `rex test` of several exercises at once.
#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interruption.h"
#include "commands/built_project.h"
#include "support/wait_until.h"

namespace rex::cli::test_many_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kBroken = "int main() { return nothing; }\n";

class TestMany : public BuiltProject {
 protected:
  void SetUp() override {
    BuiltProject::SetUp();
    addExercise("97-other");
  }
  void solve(const std::string& name, const std::string& source) const {
    write(folderOf(name) / "main.cpp", source);
  }
  // Right, but `statement` comes first; with some headers of the system.
  static std::string doing(const std::string& statement) {
    std::string source = kGood;
    source.insert(source.find("  return"), "  " + statement + "\n");
    return "#include <csignal>\n#include <filesystem>\n#include <fstream>\n#include <unistd.h>\n" + source;
  }
};

// Each waits for the other: one after the other, both would run out of time. The one asked for second ends
// first.
TEST_F(TestMany, GradesAtTheSameTimeAndTellsInTheOrderAskedFor) {
  const std::string here = (root() / "mark-").string();
  const auto meeting = [&](const std::string& mine, const std::string& other, const std::string& then) {
    return doing("static_cast<void>(std::ofstream(\"" + here + mine +
                 "\").put('x'));\n  while (!std::filesystem::exists(\"" + here + other +
                 "\")) usleep(20000);\n  " + then);
  };
  solve("98-template", meeting("a", "b",
                               "while (!std::filesystem::exists(\"" +
                                   (outOf("97-other") / "results.json").string() + "\")) usleep(20000);"));
  solve("97-other", meeting("b", "a", ""));
  const Ended ended = rex({"test", "98", "other", "98-template", "-j2"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  const std::size_t first = ended.output.find("98-template: "), second = ended.output.find("97-other: ");
  ASSERT_NE(second, ended.output.npos) << ended.output;
  EXPECT_EQ(first, 0u);
  EXPECT_EQ(ended.output.find("98-template: ", second), ended.output.npos) << "each once";
  EXPECT_THAT(ended.output, EndsWith("\n\n2 of 2 exercises in full, 6 of 6 points\n"));
  EXPECT_THAT(rex({}).output, HasSubstr("2 of 2 exercises solved"));
}

TEST_F(TestMany, EndsWithTheLargestCode) {
  addExercise("96-untouched");
  solve("98-template", kGood);
  const Ended below = rex({"test", "98", "97"});
  EXPECT_EQ(below.code, 1);
  EXPECT_THAT(below.output, EndsWith("\n1 of 2 exercises in full, 3 of 6 points\n"));
  solve("97-other", kBroken);
  const Ended refused = rex({"test", "97", "98", "96"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(flat(refused.error), HasSubstr("error: 'nothing' was not declared"));
  EXPECT_THAT(refused.output, HasSubstr("97-other: Rotating points (template)\nNot graded"));
  EXPECT_THAT(refused.output, EndsWith("\n1 of 3 exercises in full, 3 of 9 points; 1 cannot be graded\n"));
}

// A program that ends the one that judges it is to blame; at level 0, another can end the whole grader.
TEST_F(TestMany, KeepsAFaultToItsExercise) {
  solve("98-template", doing("kill(getppid(), SIGKILL);"));
  solve("97-other", doing("const auto parentOf = [](int process) {\n"
                          "    std::ifstream stat(\"/proc/\" + std::to_string(process) + \"/stat\");\n"
                          "    std::string skipped;\n    int parent = 0;\n"
                          "    stat >> skipped >> skipped >> skipped >> parent;\n    return parent;\n  };\n"
                          "  kill(parentOf(parentOf(getppid())), SIGKILL);\n  for (;;) sleep(1);"));
  addExercise("96-fine");
  solve("96-fine", kGood);
  const Ended ended = rex({"test", "98", "97", "96"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.output), HasSubstr("[quarter-turn] ended the grader, or cost"));
  EXPECT_THAT(flat(ended.output), HasSubstr("grading this exercise ended early"));
  EXPECT_THAT(ended.output, HasSubstr("96-fine: "));
  EXPECT_THAT(ended.output, EndsWith("\n1 of 3 exercises in full, 3 of 9 points; 1 hit a grader fault\n"));
  EXPECT_EQ(workFolders(), 0);
}

TEST_F(TestMany, LeavesNothingBehindWhenItIsStopped) {
  const auto mark = [&](const std::string& name) { return root() / ("process-" + name); };
  const std::vector<std::string> names = {"98-template", "97-other"};
  for (const std::string& name : names)
    solve(name, doing("std::ofstream(\"" + mark(name).string() +
                      "\") << getpid() << std::endl;\n  for (;;) sleep(1000);"));
  const pid_t rex = ::fork();
  if (rex == 0) {
    try {
      const HeldSignals held;
      const char* const words[] = {"rex", "test", "98", "97", "-j2"};
      ::_exit(runRex(5, words, {root(), build()}));
    } catch (const Interrupted&) {
      ::_exit(99);
    }
  }
  for (const std::string& name : names)
    ASSERT_TRUE(waitUntil([&] { return fileText(mark(name)).ends_with('\n'); }));
  ::kill(rex, SIGINT);
  int status = 0;
  ::waitpid(rex, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 99);
  EXPECT_EQ(workFolders(), 0);
  // What works has a working folder, what has ended none.
  for (const std::string& name : names)
    EXPECT_TRUE(waitUntil([&] {
      std::error_code gone;
      static_cast<void>(
          fs::read_symlink("/proc/" + std::to_string(std::stoi(fileText(mark(name)))) + "/cwd", gone));
      return static_cast<bool>(gone);
    })) << name;
}

TEST_F(TestMany, PrintsJson) {
  solve("98-template", kGood);
  const Ended ended = rex({"test", "--all", "--json", "-j1"});
  EXPECT_EQ(ended.code, 1) << ended.error;
  const auto json = nlohmann::json::parse(ended.output);
  EXPECT_EQ(json.at("schema"), "rex-results/1");
  ASSERT_EQ(json.at("results").size(), 2u);
  for (const auto& [place, name] : {std::pair{0, "97-other"}, {1, "98-template"}})
    EXPECT_EQ(json.at("results").at(place), nlohmann::json::parse(fileText(outOf(name) / "results.json")));
  const auto single = nlohmann::json::parse(rex({"test", "98", "--json"}).output);
  EXPECT_EQ(single.at("exercise").at("id"), "98-template");
}

TEST_F(TestMany, PutsEachIntoItsFolder) {
  rex({"test", "98", "97", "--solution", "-o", root() / "elsewhere"});
  for (const char* name : {"97-other", "98-template"})
    EXPECT_TRUE(fs::exists(root() / "elsewhere" / name / "results.json")) << name;
  EXPECT_FALSE(fs::exists(root() / "out"));
  EXPECT_THAT(rex({}).output, HasSubstr("0 of 2 exercises solved")) << "solutions do not count";
}

TEST_F(TestMany, RefusesWhatBelongsToOneExercise) {
  const Ended check = rex({"test", "98", "97", "--check", "keeps-length"});
  EXPECT_EQ(check.code, 64);
  EXPECT_THAT(flat(check.error), HasSubstr("--check: found several exercises, wanted only one exercise"));
  EXPECT_THAT(rex({"test", "--all", "--main", "x.cpp"}).error, HasSubstr("--main: found several"));
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"test"}, {"test", "98", "97", "--all"}}) {
    const Ended ended = rex(words);
    EXPECT_EQ(ended.code, 64);
    EXPECT_THAT(ended.error, HasSubstr("either EXERCISE or --all is required"));
  }
  EXPECT_EQ(rex({"test", "98", "97-othr"}).code, 64);
  for (const char* seed : {"-1", "x", "1.5", "99999999999999999999"}) {
    const Ended ended = rex({"test", "98", "--seed", seed});
    EXPECT_EQ(ended.code, 64) << seed;
    EXPECT_THAT(ended.error,
                HasSubstr(std::string("found ") + seed + ", wanted a whole number of at most 18 digits"));
  }
  EXPECT_FALSE(fs::exists(root() / "out")) << "nothing is graded before all is understood";
}

TEST_F(TestMany, GradesTheOthersWhereOneGraderDoesNotBuild) {
  solve("98-template", kGood);
  write(build() / "build.ninja",
        "rule compile\n  command = echo 'check.cpp:7:1: error: nonsense'; exit 1\n"
        "build 97-other_ready: compile\nbuild 98-template_ready: phony\n");
  const Ended ended = rex({"test", "--all", "-j1"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.error, HasSubstr("the grader of 97-other does not build"));
  EXPECT_THAT(ended.error, HasSubstr("check.cpp:7:1: error: nonsense"));
  EXPECT_THAT(ended.output, StartsWith("98-template: "));
  EXPECT_THAT(ended.output, EndsWith("1 of 2 exercises in full, 3 of 6 points; 1 hit a grader fault\n"));
  const auto json = nlohmann::json::parse(rex({"test", "--all", "--json"}).output);
  ASSERT_EQ(json.at("results").size(), 2u);
  EXPECT_EQ(json.at("results").at(1).at("exercise").at("id"), "97-other");
  EXPECT_EQ(json.at("results").at(1).at("outcome"), "grader_error");
  const Ended check = rex({"dev", "check", "--gate", "points", "--gate", "names"});
  EXPECT_EQ(check.code, 3);
  EXPECT_THAT(check.output,
              HasSubstr("97-other  names\n  ok   98-template  names\n  ok   98-template  points"))
      << "texts are compared before anything is built";
  EXPECT_THAT(check.error, HasSubstr("check.cpp:7:1: error: nonsense"));
  EXPECT_THAT(check.error, HasSubstr("1 exercise not checked."));
}

}  // namespace rex::cli::test_many_test
