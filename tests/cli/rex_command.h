#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/process.h"
#include "cli/all_rooms.h"
#include "support/temporary_folder.h"

namespace rex::cli {

/// Commands as a user meets them, in a folder of their own; without the way through `rex`, which builds.
class RexCommand : public ::testing::Test {
 protected:
  ProcessResult rex(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), REX_BINARY_DIR "/" + programName(programOf(arguments.at(0))));
    return runProcess(arguments, {.directory = folder_.path(), .timeout = 300});
  }
  std::filesystem::path in(const std::string& name) const { return folder_.path() / name; }

  /// The text without the line breaks of the terminal.
  static std::string flat(std::string text) {
    for (std::size_t at; (at = text.find('\n')) != std::string::npos;) text.replace(at, 1, " ");
    for (std::size_t at; (at = text.find("  ")) != std::string::npos;) text.erase(at, 1);
    return text;
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
