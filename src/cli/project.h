#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/build_tools.h"
#include "submission/exercise_info.h"

namespace rex::cli {

using submission::ExerciseInfo;

/// The absolute folders that commands work with: the source tree and its build, or a course folder and the
/// installed rex.
struct Project {
  std::filesystem::path root;         ///< where exercises/ and out/ are
  std::filesystem::path build;        ///< where programs, libraries and graders are
  std::filesystem::path installed{};  ///< the installed files, see homeFolder(); empty in a source tree

  /// The folder of data/, share/ and the exercises as handed out.
  [[nodiscard]] const std::filesystem::path& files() const { return installed.empty() ? root : installed; }
  /// The names of all exercises in the root, in order.
  [[nodiscard]] std::vector<std::string> exerciseNames() const;
  /// These exercises. What they demand is read from files(), so that a student cannot change it. Throws Error
  /// for a bad exercise.toml.
  [[nodiscard]] std::vector<ExerciseInfo> exercises() const;
  /// The full name of the exercise with that name, number, topic or, of three letters at least, part of the
  /// name that no other has, in small or large letters. Throws UsageError naming the nearest, and outside of
  /// a course folder.
  [[nodiscard]] std::string exerciseName(std::string_view name) const;
  /// That exercise; the others are not read. Throws like exerciseName(), and Error for a bad exercise.toml.
  [[nodiscard]] ExerciseInfo exercise(std::string_view name) const;
  /// The build's folder of an exercise: grader, worker object, build.json.
  [[nodiscard]] std::filesystem::path buildFolder(const ExerciseInfo& exercise) const;
  /// Whether it can be graded and run; in a source tree, which builds on demand, always.
  [[nodiscard]] bool isBuilt(const std::string& exercise) const;
  /// Where private folders are made to work in: the build's folder of that name, or the one for temporary
  /// files if rex is installed. Throws Error if there is none.
  [[nodiscard]] std::filesystem::path workPlace(const std::string& name) const;
  /// The default folder for results of an exercise; those of the reference solution have their own.
  [[nodiscard]] std::filesystem::path outFolder(const ExerciseInfo& exercise, bool solution) const;

 private:
  [[nodiscard]] ExerciseInfo read(const std::string& name) const;
};

/// The project of this program: the source tree that it was built in or, if it was installed, the course
/// folder that contains the current folder. Outside of any, the current folder.
[[nodiscard]] Project findProject();

/// The same, but outside of any course folder all installed exercises as they were handed out: for commands
/// that grade what was handed in.
[[nodiscard]] Project findProjectOfInstructor();

/// What commands without a course folder answer.
inline constexpr const char* kNoCourseHere =
    "There are no exercises here. `rex init course` makes a folder with all of them, to work in.\n"
    "Other commands: rex --help";

/// The file of a course folder that says what was handed out, which marks the folder.
inline constexpr const char* kCourseFile = ".rex/course.json";

/// What programs are compiled from with an installed rex, see submission::prefixFlags(): a file of 170 MB in
/// the user's XDG_CACHE_HOME, or ~/.cache, for all folders; without a home, in the project's. Empty in a
/// source tree, whose build has its own.
[[nodiscard]] std::filesystem::path prefixFile(const Project& project);

/// The path as a user in the current folder would type it.
[[nodiscard]] std::string shown(const std::filesystem::path& path);

/// How to build and grade student code of an exercise; first builds what that needs. Throws like
/// bringUpToDate() and readToolchain().
[[nodiscard]] submission::Toolchain prepare(const Project& project, const ExerciseInfo& exercise);

}  // namespace rex::cli
