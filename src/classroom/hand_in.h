#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "submission/exercise_info.h"

namespace rex::grading {

/// One file that a student handed in.
struct HandIn {
  std::string student{};
  std::string exercise{};             ///< whole name
  std::filesystem::path from{};       ///< where it lay
  std::optional<std::string> text{};  ///< nothing: cannot be read, which grading will say, too
  std::string whyNot{};               ///< what was found instead of a text: "a symbolic link"
  std::int64_t submitted = 0;         ///< when `from` or its archive was modified, seconds since 1970 in UTC
};

/// What a folder of submissions holds.
struct HandIns {
  std::vector<HandIn> files{};            ///< by student, then by exercise
  std::vector<std::string> complaints{};  ///< what was not taken as it is: file, finding, what was wanted
  std::vector<std::string> notes{};       ///< what lay beside and was not asked for
};

/// Reads DIR/STUDENT/EXERCISE/main.cpp, or EXERCISE/main.cpp of the archive DIR/STUDENT.zip, where one folder
/// may lie around all. Names of exercises may be short ones; `only` empty: all. Each folder and file is
/// opened once, by OpenedFolder, so that no link is followed and nothing that is swapped meanwhile is read.
/// One that cannot be taken never hides another; of two spellings of one name neither is taken. Throws Error
/// where `folder` itself cannot be read.
[[nodiscard]] HandIns readHandIns(const std::filesystem::path& folder,
                                  const std::vector<ExerciseInfo>& exercises, const std::string& only = {});

/// Where this file is graded: a copy of its text, written to OUT/STUDENT/EXERCISE/main.cpp, told relative to
/// `out`. What could not be read has a copy that does not compile, and says why. Throws Error if that cannot
/// be written.
[[nodiscard]] std::filesystem::path snapshotOf(const HandIn& file, const std::filesystem::path& out);

/// Whether a name ends as files of results do, which lie beside the students' folders: .csv, .log and others.
[[nodiscard]] bool isNameOfResults(const std::string& name);

/// Throws UsageError for a file to be written in the folder of results under a name that a student may have.
void requireNameOfResults(const std::filesystem::path& file, const std::filesystem::path& out);

/// Why this cannot be the name of a student, whose folder and row in tables it becomes; empty if it can.
[[nodiscard]] std::string whyNoStudentName(const std::string& name);

}  // namespace rex::grading
