#pragma once
// What folders of submissions, results and comparisons hold about people, and how it is removed
// (share/doc/people.md):
//   const classroom::Forgetting forgetting(course, imported, tasks, {.student = "zoe"});
//   classroom::Traces traces;
//   forgetting.addFolder("handed-in", traces);
//   classroom::removeTraces(traces);

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "classroom/course_file.h"
#include "classroom/import_table.h"
#include "classroom/submission_folder.h"
#include "classroom/task_list.h"

namespace rex::classroom {

/// Whose work is forgotten: one of the two.
struct ForgetOptions {
  std::string student{};                 ///< id, or a folder that is nobody's; empty: everybody's
  std::optional<std::int64_t> before{};  ///< handed in before this, seconds since 1970 in UTC
};

/// What would be removed, and what would not.
struct Traces {
  std::vector<std::filesystem::path> removed{};  ///< files and folders
  std::map<std::filesystem::path, std::string>
      rewritten{};                  ///< tables by file: their text without those people
  std::vector<std::string> kept{};  ///< a sentence for each thing that others need
};

/// Decides by folder, exercise and time. What a group handed in belongs to each of its members.
class Forgetting {
 public:
  /// `course` with everybody; `tasks` and `imported` say when things were handed in.
  Forgetting(const Course& course, const ImportTable& imported, const std::vector<Task>& tasks,
             ForgetOptions options);

  /// STUDENT/EXERCISE and archives of students in a folder of submissions or results, with the tables there
  /// that name people. Tables of grades are removed: they are made again.
  void addFolder(const std::filesystem::path& folder, Traces& traces) const;
  /// Pages of `rex grade --similar` with these people, and the copies of their files.
  void addSimilar(const std::filesystem::path& folder, Traces& traces) const;

 private:
  enum class Fate { kStays, kShared, kForgotten };
  [[nodiscard]] Fate fateOf(const std::string& folder, const std::string& exercise,
                            const std::filesystem::path& path) const;
  void addStudent(const std::filesystem::path& folder, Traces& traces) const;
  void addTables(const std::filesystem::path& folder, Traces& traces) const;
  [[nodiscard]] bool isPerson(const std::string& folder) const;
  [[nodiscard]] ImportTable without(const ImportTable& table) const;
  [[nodiscard]] std::string othersOf(const std::vector<std::string>& owners) const;

  const Course& course_;
  const ImportTable& imported_;
  ForgetOptions options_;
  SubmissionOwners owners_;
  std::map<std::pair<std::string, std::string>, std::int64_t> times_{};  ///< by folder and exercise
};

/// Where a text file names the student: "students.csv:27". By id, number, e-mail and name.
[[nodiscard]] std::vector<std::string> mentionsIn(const std::filesystem::path& file,
                                                  const CourseStudent& student);

/// Rewrites the tables first, so that an interruption leaves nothing that they name and that is gone. Throws
/// Error if something cannot be removed.
void removeTraces(const Traces& traces);

}  // namespace rex::classroom
