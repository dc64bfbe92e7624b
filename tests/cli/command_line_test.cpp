#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"

namespace rex::cli::command_line_test {

using ::testing::HasSubstr;

// The program itself, as a user meets it.
ProcessResult rex(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), REX_BINARY_DIR "/rex");
  return runProcess(arguments);
}

void expectUsageError(const std::vector<std::string>& arguments, const std::string& message) {
  const ProcessResult result = rex(arguments);
  EXPECT_EQ(result.exitCode, 64) << message;
  EXPECT_EQ(result.output, "") << message;
  EXPECT_THAT(result.error, HasSubstr(message));
}

TEST(Program, WelcomesAndHelps) {
  const ProcessResult welcome = rex({});
  EXPECT_EQ(welcome.exitCode, 0);
  EXPECT_THAT(welcome.output, HasSubstr("All commands: scripts/rex --help"));
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--help"},
                                             {"list", "--help"},
                                             {"run", "--help"},
                                             {"test", "--help"},
                                             {"bench", "--help"},
                                             {"debug", "--help"},
                                             {"render", "--help"},
                                             {"simulate", "--help"},
                                             {"view", "--help"},
                                             {"doctor", "--help"},
                                             {"watch", "--help"},
                                             {"hint", "--help"},
                                             {"show", "--help"},
                                             {"reset", "--help"},
                                             {"solution", "--help"},
                                             {"submit", "--help"},
                                             {"dev"},
                                             {"dev", "new", "--help"},
                                             {"dev", "check", "--help"},
                                             {"dev", "strip", "--help"}}) {
    const ProcessResult help = rex(arguments);
    EXPECT_EQ(help.exitCode, 0) << arguments[0];
    EXPECT_THAT(help.output, HasSubstr("Usage: rex"));
    EXPECT_THAT(help.output, ::testing::ContainsRegex("Example|Exit codes"));
  }
}

TEST(Program, NamesTheValuesOfOptionsAndTheEnvironmentOnce) {
  for (const char* command : {"render", "doctor"}) {
    const std::string help = rex({command, "--help"}).output;
    EXPECT_THAT(help, HasSubstr("--gl NAME (Env:REX_GL)"));
    EXPECT_EQ(help.find("REX_GL"), help.rfind("REX_GL"));
  }
  const std::string help = rex({"render", "--help"}).output;
  for (const char* option : {"--q POSTURE", "--motion FILE", "--seconds S", "--camera VIEW", "--trace BODY",
                             "--caption TEXT", "--size WxH", "--show WHAT", "--aa KIND"})
    EXPECT_THAT(help, HasSubstr(option));
}

TEST(Program, KeepsHelpWithin90ColumnsAndFreeOfColour) {
  for (const char* command : {"list", "run", "test", "watch", "hint", "show", "reset", "solution", "submit",
                              "bench", "debug", "demo", "render", "simulate", "doctor", "dev", "view"}) {
    const std::string help = rex({command, "--help"}).output;
    EXPECT_EQ(help.find('\033'), std::string::npos);
    for (std::size_t start = 0; start < help.size();) {
      const std::size_t end = std::min(help.find('\n', start), help.size());
      EXPECT_LE(end - start, 90u) << help.substr(start, end - start);
      start = end + 1;
    }
  }
}

// In a pseudo terminal, as `script` makes one.
TEST(Program, ColoursTextOnlyOnATerminalThatWantsIt) {
  const std::string rexList = REX_BINARY_DIR "/rex list";
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

TEST(Program, AnswersUnknownWordsWithTheNearest) {
  expectUsageError({"lst"}, "rex: unknown command 'lst' (did you mean 'list'?)");
  expectUsageError({"dev", "chek"}, "rex dev: unknown command 'chek' (did you mean 'check'?)");
  expectUsageError({"test", "01", "--sed", "3"}, "rex test: unknown option '--sed' (did you mean '--seed'?)");
  expectUsageError({"list", "extra"}, "rex list: unknown argument 'extra'");
  expectUsageError({"--json", "scene", "man"}, "rex: option '--json' must come after `rex scene FILE`");
  expectUsageError({"--seed=3", "test", "01"}, "rex: option '--seed=3' must come after `rex test`");
  // Before what else is missing: it may be that.
  expectUsageError({"trajectory", "board", "--ot", "a"},
                   "rex trajectory: unknown option '--ot' (did you mean '--out'?)");
  expectUsageError({"\033[31mred"}, "unknown command '");
}

TEST(Program, AnswersAlikeWhicheverOfItsProgramsIsAsked) {
  for (const char* program : {"/rex-robot", "/rex-methods", "/rex-instructor"}) {
    const std::string file = std::string(REX_BINARY_DIR) + program;
    EXPECT_EQ(runProcess({file}).output, rex({}).output) << program;
    EXPECT_EQ(runProcess({file, "list"}).output, rex({"list"}).output) << program;
    EXPECT_EQ(runProcess({file, "rendr"}).error, rex({"rendr"}).error) << program;
  }
}

TEST(Program, ExplainsWrongUse) {
  expectUsageError({"test"}, "rex test: either EXERCISE or --all is required");
  expectUsageError({"test", "01", "--seed", "x"},
                   "rex test: --seed: found x, wanted a whole number of at most 18 digits");
  for (const char* command : {"cma", "filter", "grade", "plan", "simulate"})
    expectUsageError({command, "--seed", "-1"}, "--seed: found -1, wanted a whole number");
  expectUsageError({"test", "01", "--main", "a.cpp", "--solution"}, "--main excludes --solution");
  expectUsageError({"test", "01", "--debug", "--level", "1"}, "--debug excludes --level");
  expectUsageError({"dev", "check", "--seeds", "0"}, "rex dev check: --seeds");
  expectUsageError({"dev", "strip"}, "EXERCISE is required");
  expectUsageError({"dev", "strip", "--release"},
                   "to make the student release, use: scripts/rex dev release DIR");
  expectUsageError({"dev", "release"}, "DIR is required");
  expectUsageError({"dev", "stats"}, "DIR is required");
  expectUsageError({"test", "no-such-exercise"}, "no exercise is called 'no-such-exercise'");
}

}  // namespace rex::cli::command_line_test
