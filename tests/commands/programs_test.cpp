// The programs behind `rex`: the one for instructors, and what all of them have in common.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "commands/all_commands.h"
#include "support/paths.h"

namespace rex::cli::programs_test {

using ::testing::HasSubstr;

// The program itself, as a user meets it.
ProcessResult rex(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), buildPath("rex"));
  return runProcess(arguments);
}

void expectUsageError(const std::vector<std::string>& arguments, const std::string& message) {
  const ProcessResult result = rex(arguments);
  EXPECT_EQ(result.exitCode, 64) << message;
  EXPECT_EQ(result.output, "") << message;
  EXPECT_THAT(result.error, HasSubstr(message));
}

TEST(Programs, HaveTheCommandsThatTheTableGivesThem) {
  for (const Program program : {Program::kStudent, Program::kRobot, Program::kInstructor}) {
    const CommandSet set = anyCommands(program);
    EXPECT_EQ(set.program, program) << programName(program);
    std::vector<std::string_view> registered, given;
    for (const auto& [name, registration] : set.commands) registered.push_back(name);
    for (const TableEntry& entry : commandTable())
      if (entry.program == program) given.push_back(entry.name);
    EXPECT_THAT(registered, ::testing::UnorderedElementsAreArray(given)) << programName(program);
  }
}

TEST(Programs, WelcomeAndHelp) {
  EXPECT_THAT(rex({}).output, HasSubstr("All commands: scripts/rex --help"));
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--help"},
                                             {"list", "--help"},
                                             {"render", "--help"},
                                             {"slam", "--help"},
                                             {"dev", "bench", "--help"},
                                             {"grade", "--help"},
                                             {"dev"},
                                             {"dev", "new", "--help"},
                                             {"dev", "check", "--help"},
                                             {"dev", "strip", "--help"}}) {
    const ProcessResult help = rex(arguments);
    EXPECT_EQ(help.exitCode, 0) << arguments[0];
    EXPECT_THAT(help.output, HasSubstr("Usage: rex"));
    EXPECT_THAT(help.output, ::testing::ContainsRegex("Example|Exit codes"));
    EXPECT_EQ(help.output.find('\033'), std::string::npos);
    const bool isNarrow =
        (arguments.size() > 1 && arguments[1] == "bench") || arguments == std::vector<std::string>{"dev"};
    for (std::size_t start = 0; isNarrow && start < help.output.size();) {
      const std::size_t end = std::min(help.output.find('\n', start), help.output.size());
      EXPECT_LE(end - start, 90u) << help.output.substr(start, end - start);
      start = end + 1;
    }
  }
}

// In a pseudo terminal, as `script` makes one.
TEST(Programs, ColourTextOnlyOnATerminalThatWantsIt) {
  const std::string rexList = buildPath("rex list");
  const auto onATerminal = [&](const std::string& settings) {
    const ProcessResult result =
        runProcess({"script", "-qec", "env " + settings + " " + rexList, "/dev/null"});
    EXPECT_EQ(result.exitCode, 0) << result.error;
    return result.output;
  };
  const std::string plain = "-u NO_COLOR TERM=xterm";
  EXPECT_THAT(onATerminal(plain), HasSubstr("\033[1m"));
  EXPECT_THAT(onATerminal(plain + " NO_COLOR="), HasSubstr("\033[1m"));
  EXPECT_EQ(onATerminal(plain + " NO_COLOR=1").find('\033'), std::string::npos);
  EXPECT_EQ(onATerminal("-u NO_COLOR TERM=dumb").find('\033'), std::string::npos);
  EXPECT_EQ(rex({"list"}).output.find('\033'), std::string::npos);
}

TEST(Programs, AnswerAlikeWhicheverIsAsked) {
  for (const char* program : {"/rex-robot", "/rex-teach"}) {
    const std::string file = ownFolder().string() + program;
    EXPECT_EQ(runProcess({file}).output, rex({}).output) << program;
    EXPECT_EQ(runProcess({file, "list"}).output, rex({"list"}).output) << program;
    EXPECT_EQ(runProcess({file, "rendr"}).error, rex({"rendr"}).error) << program;
  }
}

TEST(Programs, AnswerWrongUseOfEachOther) {
  expectUsageError({"dev", "chek"}, "rex dev: unknown command 'chek' (did you mean 'check'?)");
  expectUsageError({"import", "classroom", "x"},
                   "rex: `rex import classroom` is now: scripts/rex import git CLONES -o HANDED_IN\n");
  expectUsageError({"--json", "scene", "man"}, "rex: option '--json' must come after `rex scene FILE`");
  expectUsageError({"grade", "--seed", "-1"}, "--seed: found -1, wanted a whole number");
  expectUsageError({"dev", "check", "--runs", "0"}, "--runs: found 0, wanted 1 to 10000");
  expectUsageError({"dev", "strip"}, "EXERCISE is required");
  expectUsageError({"dev", "strip", "--release"},
                   "to make the student release, use: scripts/rex dev release DIR");
  expectUsageError({"dev", "release"}, "DIR is required");
  expectUsageError({"dev", "stats"}, "DIR is required");
}

TEST(Programs, CompleteWordsOfEachOther) {
  EXPECT_EQ(rex({"--complete", "dev", "st"}).output, "stats\nstrip\n");
  EXPECT_EQ(rex({"--complete", "dev", "check", "--g"}).output, "--gate\n");
}

}  // namespace rex::cli::programs_test
