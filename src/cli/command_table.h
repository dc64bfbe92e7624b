#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rex::cli {

/// The programs behind `rex`, one for each room of this folder. `rex` itself is the student's.
enum class Program { kStudent, kRobot, kMethods, kInstructor };

/// Its name, which is that of its file in the build folder and of its build target.
[[nodiscard]] std::string programName(Program program);

/// The groups of `rex --help`.
enum class Topic { kExercises, kRobots, kMethods, kCourses };

[[nodiscard]] const char* nameOf(Topic topic);

/// What every program knows about a command, including those that it hands over.
struct TableEntry {
  std::string_view name{};
  std::string_view purpose{};  ///< one line of `rex --help`
  Topic topic{};
  Program program{};  ///< the program that runs it
};

/// All commands of `rex`, in the order of its help.
[[nodiscard]] std::span<const TableEntry> commandTable();

}  // namespace rex::cli
