#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "cli/command_line.h"
#include "cli/commands_for_students.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::cli {

/// Commands as a user meets them, in a folder of their own; run by this process, as by the program that knows
/// them.
class RexCommand : public ::testing::Test {
 protected:
  virtual ProcessResult rex(const std::vector<std::string>& arguments) const {
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder());
    std::vector<const char*> argv = {"rex"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    const CommandSet set = commandsForStudents(programOf(arguments.empty() ? "" : arguments[0]));
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    ProcessResult result;
    result.started = true;
    result.exitCode = runProgram(static_cast<int>(argv.size()), argv.data(),
                                 {.root = homeFolder(), .build = ownFolder()}, set);
    result.output = ::testing::internal::GetCapturedStdout();
    result.error = ::testing::internal::GetCapturedStderr();
    std::filesystem::current_path(before);
    return result;
  }
  const std::filesystem::path& folder() const { return folder_.path(); }
  std::filesystem::path in(const std::string& name) const { return folder_.path() / name; }

  /// The text without the line breaks of the terminal.
  static std::string flat(std::string text) {
    for (std::size_t at; (at = text.find('\n')) != std::string::npos;) text.replace(at, 1, " ");
    for (std::size_t at; (at = text.find("  ")) != std::string::npos;) text.erase(at, 1);
    return text;
  }

  /// For wrong use: the exit code, the message, and no folder "out".
  void expectRefused(const ProcessResult& result, const std::string& message) const {
    EXPECT_EQ(result.exitCode, 64) << message;
    EXPECT_THAT(flat(result.error), ::testing::HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(in("out"))) << message;
  }

  /// The examples that `rex COMMAND --help` shows, as words after "rex".
  std::vector<std::vector<std::string>> examplesOf(const std::string& command) const {
    const std::string help = rex({command, "--help"}).output, start = "\n  scripts/rex ";
    std::vector<std::vector<std::string>> examples;
    for (std::size_t at = help.find(start); at != std::string::npos; at = help.find(start, at + 1)) {
      const std::size_t from = at + start.size();
      examples.push_back(wordsOf(help.substr(from, help.find('\n', from) - from)));
    }
    return examples;
  }

 private:
  // As a shell reads blanks and single quotes.
  static std::vector<std::string> wordsOf(const std::string& line) {
    std::vector<std::string> words(1);
    bool isQuoted = false;
    for (const char c : line) {
      if (c == '\'')
        isQuoted = !isQuoted;
      else if (c == ' ' && !isQuoted)
        words.emplace_back();
      else
        words.back() += c;
    }
    return words;
  }

  TemporaryFolder folder_;
};

}  // namespace rex::cli
