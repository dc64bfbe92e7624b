// What `rex` does with commands of its other programs.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/command_line.h"
#include "commands/all_commands.h"
#include "support/file_text.h"
#include "support/temporary_folder.h"

namespace rex::cli::hand_over_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// `rex` in a build folder that holds no other program yet.
class HandOver : public ::testing::Test {
 protected:
  // As a process of its own, which becomes another one.
  int rex(std::vector<const char*> words) const {
    words.insert(words.begin(), "rex");
    const pid_t child = ::fork();
    if (child == 0) {
      if (std::freopen(in("output").c_str(), "w", stdout) == nullptr ||
          std::freopen(in("error").c_str(), "w", stderr) == nullptr)
        ::_exit(98);
      const int code = runCommandLine(static_cast<int>(words.size()), words.data(), {folder(), folder()},
                                      studentCommands());
      std::fflush(nullptr);
      ::_exit(code);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void addProgram(const std::string& name) const {
    std::ofstream(in(name)) << "#!/bin/sh\nprintf '<%s>' \"$@\"\nexit 7\n";
    fs::permissions(in(name), fs::perms::owner_all);
  }
  fs::path folder() const { return folder_.path(); }
  fs::path in(const std::string& name) const { return folder() / name; }

 private:
  TemporaryFolder folder_;
};

TEST_F(HandOver, PassesAllWordsOnAndTheExitCodeBack) {
  addProgram("rex-robot");
  EXPECT_EQ(rex({"scene", "man", "render", "-o", "a b.png", "--json"}), 7);
  EXPECT_EQ(fileText(in("output")), "<scene><man><render><-o><a b.png><--json>");
}

TEST_F(HandOver, LeavesMistakesAndHelpToTheProgramThatKnows) {
  addProgram("rex-teach");
  for (const std::vector<const char*>& words :
       std::vector<std::vector<const char*>>{{"grade", "--help"}, {"--json", "grade", "x"}, {"dev", "chek"}})
    EXPECT_EQ(rex(words), 7) << words[0];
  EXPECT_EQ(fileText(in("error")), "");
}

TEST_F(HandOver, SaysWhatIsMissing) {
  EXPECT_EQ(rex({"grade", "--seed", "-1"}), 3);
  EXPECT_THAT(fileText(in("error")), HasSubstr("rex-teach: cannot start a part of rex"));
  EXPECT_THAT(fileText(in("error")), HasSubstr("found No such"));
}

TEST_F(HandOver, BuildsTheProgramFirst) {
  addProgram("new");
  std::ofstream(in("build.ninja")) << "rule copy\n  command = cp new $out\nbuild rex-teach: copy\n"
                                   << "rule fail\n  command = echo 'a.cpp:1:1: error: x'; exit 1\n"
                                   << "build rex-robot: fail\n";
  EXPECT_EQ(rex({"grade"}), 7);
  EXPECT_EQ(fileText(in("error")), "building rex-teach ...\n");
  EXPECT_EQ(rex({"scene", "man"}), 3);
  EXPECT_THAT(fileText(in("error")), HasSubstr("rex-robot does not build"));
  EXPECT_THAT(fileText(in("error")), HasSubstr("a.cpp:1:1: error: x"));
}

TEST_F(HandOver, AnswersMisspeltCommandsOfAllProgramsItself) {
  for (const auto& [typed, meant] :
       {std::pair{"rendr", "render"}, {"linaer", "linear"}, {"exprt", "export"}}) {
    EXPECT_EQ(rex({typed}), 64);
    EXPECT_THAT(fileText(in("error")), HasSubstr(std::string("did you mean '") + meant + "'?"));
  }
}

TEST_F(HandOver, HelpsAlikeInAllPrograms) {
  EXPECT_EQ(rex({"--help"}), 0);
  const std::string help = fileText(in("output"));
  std::size_t at = 0;
  for (const TableEntry& entry : commandTable()) {
    at = help.find("\n  " + std::string(entry.name) + " ", at);
    ASSERT_NE(at, help.npos) << entry.name << " in the order of the table";
    EXPECT_THAT(help.substr(at), HasSubstr(std::string(entry.purpose.substr(0, 20)))) << entry.name;
  }
  for (const Program program : {Program::kRobot, Program::kInstructor}) {
    const char* const words[] = {"rex", "--help"};
    ::testing::internal::CaptureStdout();
    EXPECT_EQ(runCommandLine(2, words, {folder(), folder()}, anyCommands(program)), 0);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), help) << programName(program);
  }
}

}  // namespace rex::cli::hand_over_test
