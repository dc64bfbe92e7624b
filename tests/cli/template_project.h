#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command_line.h"
#include "cli/commands_for_students.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::cli {

namespace fs = std::filesystem;

inline constexpr const char* kGood = R"(#include "exercise.h"
#include <cmath>
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  return {std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y()};
}
int main() {}
)";

struct Ended {
  int code = 0;
  std::string output, error;
};

// The words of a message, however its lines are broken.
inline std::string flat(const std::string& text) {
  std::istringstream words(text);
  std::string joined;
  for (std::string word; words >> word;) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

// A project of one exercise, made from the template in a folder of its own; nothing of it is built.
class TemplateProject : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"exercises", "share", "src"}) fs::create_directories(root() / folder);
    fs::copy(buildPath("tests/template/source"), exercise(), fs::copy_options::recursive);
    fs::copy(sourcePath("src/geometry"), root() / "src" / "geometry");
    fs::copy(sourcePath("share/template"), root() / "share" / "template", fs::copy_options::recursive);
    EXPECT_EQ(rex({"reset", "98"}).code, 0);
  }

  fs::path root() const { return temporary_.path(); }
  fs::path exercise() const { return root() / "exercises" / "98-template"; }
  fs::path out() const { return root() / "out" / "98-template"; }
  fs::path build() const { return root() / "build"; }
  virtual CommandSet commandSet(Program program) const { return commandsForStudents(program); }

  Ended rexWith(const Project& project, const std::vector<std::string>& arguments) const {
    std::vector<const char*> argv = {"rex"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    // What is to be completed has another command in front.
    const std::size_t command = arguments.size() > 1 && arguments[0] == "--complete" ? 1 : 0;
    const CommandSet set = commandSet(programOf(arguments.empty() ? "" : arguments[command]));
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const int code = runCommandLine(static_cast<int>(argv.size()), argv.data(), project, set);
    std::string output = ::testing::internal::GetCapturedStdout();
    return {code, std::move(output), ::testing::internal::GetCapturedStderr()};
  }
  Ended rexIn(const fs::path& folder, const std::vector<std::string>& arguments) const {
    return rexWith({root(), folder}, arguments);
  }
  Ended rex(const std::vector<std::string>& arguments) const { return rexIn(build(), arguments); }

  static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
  static void replace(const fs::path& file, const std::string& from, const std::string& to) {
    std::string text = fileText(file);
    ASSERT_NE(text.find(from), std::string::npos) << from;
    write(file, text.replace(text.find(from), from.size(), to));
  }

  TemporaryFolder temporary_;
};

}  // namespace rex::cli
