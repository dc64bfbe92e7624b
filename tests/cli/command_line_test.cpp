// What all commands have in common: help, completion in shells, and answers to wrong use.
#include "cli/command_line.h"

#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/rex_command.h"
#include "cli/template_project.h"

namespace rex::cli::command_line_test {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class CommandLine : public RexCommand {
 protected:
  void expectUsageError(const std::vector<std::string>& arguments, const std::string& message) const {
    const ProcessResult result = rex(arguments);
    EXPECT_EQ(result.exitCode, 64) << message;
    EXPECT_EQ(result.output, "") << message;
    EXPECT_THAT(result.error, HasSubstr(message));
  }
  // Of students: the one for instructors is asked in tests/commands.
  static std::vector<std::string> commands() {
    std::vector<std::string> names;
    for (const TableEntry& entry : commandTable())
      if (entry.program != Program::kInstructor) names.emplace_back(entry.name);
    return names;
  }
};

TEST_F(CommandLine, WelcomesAndHelps) {
  const ProcessResult welcome = rex({});
  EXPECT_EQ(welcome.exitCode, 0);
  EXPECT_THAT(welcome.output, HasSubstr("All commands: scripts/rex --help"));
  for (const std::string& command : commands()) {
    const ProcessResult help = rex({command, "--help"});
    EXPECT_EQ(help.exitCode, 0) << command;
    EXPECT_THAT(help.output, HasSubstr("Usage: rex"));
    EXPECT_THAT(help.output, ContainsRegex("Example|Exit codes")) << command;
  }
}

TEST_F(CommandLine, NamesTheValuesOfOptionsAndTheEnvironmentOnce) {
  for (const char* command : {"render", "doctor"}) {
    const std::string help = rex({command, "--help"}).output;
    EXPECT_THAT(help, HasSubstr("--gl NAME (Env:REX_GL)"));
    EXPECT_EQ(help.find("REX_GL"), help.rfind("REX_GL"));
  }
  const std::string help = rex({"render", "--help"}).output;
  for (const char* option : {"--q POSTURE", "--motion FILE", "--duration S", "--camera VIEW", "--trace BODY",
                             "--caption TEXT", "--size WxH", "--show WHAT", "--aa KIND"})
    EXPECT_THAT(help, HasSubstr(option));
}

TEST_F(CommandLine, KeepsHelpWithin90ColumnsAndFreeOfColour) {
  for (const char* command : {"list", "run", "test", "watch", "hint", "show", "reset", "submit", "debug",
                              "demo", "plan", "slam", "linear", "render", "simulate", "doctor", "view"}) {
    const std::string help = rex({command, "--help"}).output;
    EXPECT_EQ(help.find('\033'), std::string::npos);
    for (std::size_t start = 0; start < help.size();) {
      const std::size_t end = std::min(help.find('\n', start), help.size());
      EXPECT_LE(end - start, 90u) << help.substr(start, end - start);
      start = end + 1;
    }
  }
}

TEST_F(CommandLine, AnswersUnknownWordsWithTheNearest) {
  expectUsageError({"lst"}, "rex: unknown command 'lst' (did you mean 'list'?)");
  expectUsageError({"test", "01", "--sed", "3"}, "rex test: unknown option '--sed' (did you mean '--seed'?)");
  expectUsageError({"list", "extra"}, "rex list: unknown argument 'extra'");
  expectUsageError({"help", "plann"}, "rex: unknown command 'plann' (did you mean 'plan'?)");
  expectUsageError({"--seed=3", "test", "01"}, "rex: option '--seed=3' must come after `rex test`");
  // Before what else is missing: it may be that.
  expectUsageError({"plan", "board", "--ot", "a"}, "rex plan: unknown option '--ot' (did you mean '--out'?)");
  expectUsageError({"\033[31mred"}, "unknown command '");
}

TEST_F(CommandLine, ExplainsWrongUse) {
  expectUsageError({"test"}, "rex test: either EXERCISE or --all is required");
  for (const char* seed : {"-1", "x", "1.5", "99999999999999999999"})
    expectUsageError({"test", "01", "--seed", seed}, std::string("rex test: --seed: found ") + seed +
                                                         ", wanted a whole number of at most 18 digits");
  for (const char* command : {"demo", "plan", "simulate"})
    expectUsageError({command, "--seed", "-1"}, "--seed: found -1, wanted a whole number");
  expectUsageError({"test", "01", "--main", "a.cpp", "--solution"}, "--main excludes --solution");
  expectUsageError({"test", "01", "--debug", "--level", "1"}, "--debug excludes --level");
  expectUsageError({"test", "no-such-exercise"}, "no exercise is called 'no-such-exercise'");
}

TEST_F(CommandLine, TellsTheNewNamesOfOldCommands) {
  for (const OldCommand& old : oldCommands()) {
    if (old.name.starts_with("import ")) continue;  // of instructors
    expectUsageError({std::string(old.name), "--seed", "3"},
                     fmt::format("rex: `rex {}` is now: {}\n", old.name, old.now));
    for (const TableEntry& entry : commandTable()) EXPECT_NE(entry.name, old.name);
    // The new line begins with a command that there is.
    const std::string first = std::string(old.now.substr(std::string_view("scripts/rex ").size()));
    EXPECT_TRUE(std::ranges::any_of(commandTable(), [&](const TableEntry& entry) {
      return first.starts_with(std::string(entry.name) + " ");
    })) << old.now;
  }
}

TEST_F(CommandLine, HelpsInGroupsAndTellsItsVersion) {
  const std::string help = rex({"--help"}).output;
  std::size_t at = 0;
  for (const char* group : {"\nExercises:\n", "\nRobots:\n", "\nMethods:\n", "\nCourses:\n"}) {
    at = help.find(group, at);
    ASSERT_NE(at, help.npos) << group;
  }
  EXPECT_EQ(rex({"help"}).output, help);
  EXPECT_EQ(rex({"help", "list"}).output, rex({"list", "--help"}).output);
  EXPECT_EQ(rex({"--version"}).output, "rex " REX_VERSION "\n");
}

TEST(CommandTable, NamesEachCommandOnceAndSaysWhatItIsFor) {
  std::set<std::string_view> names;
  for (const TableEntry& entry : commandTable()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_FALSE(entry.purpose.empty()) << entry.name;
    EXPECT_FALSE(entry.purpose.ends_with('.')) << entry.name;
  }
}

class Completion : public TemplateProject {
 protected:
  std::string after(std::vector<std::string> words) const {
    words.insert(words.begin(), "--complete");
    return rex(std::move(words)).output;
  }
};

TEST_F(Completion, KnowsTheCommandsOfAllPrograms) {
  EXPECT_EQ(after({"s"}), "scene\nshow\nsimulate\nslam\nsubmit\n");
}

TEST_F(Completion, KnowsTheExercises) {
  EXPECT_EQ(after({"test", ""}), "98-template\n");
  EXPECT_EQ(after({"test", "98-template", "9"}), "98-template\n");
  EXPECT_EQ(after({"test", "01"}), "");
}

TEST_F(Completion, KnowsTheVerbsAndOptionsOfEachCommand) {
  EXPECT_EQ(after({"scene", "man", "c"}), "check\ncontacts\nconvert\n");
  EXPECT_EQ(after({"submit", "01", "--o"}), "--out\n");
}

TEST_F(Completion, KnowsThePosturesOfAScene) {
  const std::string swing = (root() / "swing.xml").string();
  write(swing,
        "<mujoco><worldbody><body><joint/><geom size='.2'/></body></worldbody>"
        "<keyframe><key name='home' qpos='.7'/></keyframe></mujoco>");
  EXPECT_EQ(after({"scene", swing, "fk", "--q", ""}), "0\nfile\nkey:home\n");
  EXPECT_EQ(after({"plan", swing, "--goal", "key:"}), "key:home\n");
  EXPECT_EQ(after({"view", "none.xml", "--q", "k"}), "");
}

TEST_F(Completion, LeavesFilesToTheShell) { EXPECT_EQ(after({"render", "ma"}), ""); }

TEST(ManualPage, ListsAllCommands) {
  ::testing::internal::CaptureStdout();
  const char* const words[] = {"rex", "--man"};
  EXPECT_EQ(runCommandLine(2, words, {"/", "/"}, studentCommands()), 0);
  const std::string page = ::testing::internal::GetCapturedStdout();
  for (const TableEntry& entry : commandTable())  // hyphens are written in another way
    EXPECT_THAT(page, HasSubstr("\n.B " + std::string(entry.name.substr(0, entry.name.find('-')))));
  EXPECT_THAT(page, HasSubstr(".SH EXIT STATUS"));
}

}  // namespace rex::cli::command_line_test
