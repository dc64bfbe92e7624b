#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "classroom/course_file.h"
#include "classroom/import_table.h"
#include "submission/exercise_info.h"

namespace rex::classroom {

/// The id of the student of the course who is this person of a platform: by id, number, e-mail, name of the
/// folder or user name, in this order, else by a full name that only one has. Case does not count, nor how
/// umlauts are written. Empty: nobody.
[[nodiscard]] std::string courseStudent(const ImportedStudent& person, const Course& course);

/// The id of the student whom a text names: by what courseStudent() knows or what a platform does, else the
/// one of these folders that is called so. Empty: nobody. Throws UsageError if several students are called
/// so.
[[nodiscard]] std::string studentCalled(const std::string& text, const Course& course,
                                        const ImportTable& imported, const std::vector<std::string>& folders);

/// Whose submissions the folders of a class are.
class SubmissionOwners {
 public:
  SubmissionOwners(const Course& course, const ImportTable& imported);

  /// The ids of all for whom the file in this folder counts, sorted: the student of that id and the members
  /// of the group, the members of the group of that name, or those whom a platform lists. Empty: nobody.
  [[nodiscard]] std::vector<std::string> of(const std::string& folder, const std::string& exercise) const;

 private:
  std::vector<std::string> withGroups(const std::vector<std::string>& ids) const;

  const Course& course_;
  const ImportTable& imported_;
  Course everyone_{};                            ///< also those whose row of the roster was not taken
  std::map<std::string, std::string> ids_{};     ///< by caseless(id)
  std::map<std::string, std::string> people_{};  ///< of a platform: folder, id
};

/// One file that a student handed in.
struct SubmittedFile {
  std::string student{};
  std::string exercise{};             ///< full name
  std::filesystem::path from{};       ///< where it was found
  std::optional<std::string> text{};  ///< empty: it cannot be read, which grading will report, too
  std::string whyNot{};               ///< what was found instead of a text file: "a symbolic link"
  std::int64_t submitted = 0;         ///< when `from` or its archive was modified, seconds since 1970 in UTC
};

/// Something that a student handed in but that was not taken as it is.
struct RejectedSubmission {
  std::string student{};   ///< the name of the folder or archive, without its ending
  std::string exercise{};  ///< empty: it is not known which one was meant
  std::string why{};       ///< one sentence without the path
};

/// The contents of a folder of submissions.
struct SubmittedFiles {
  std::vector<SubmittedFile> files{};     ///< by student, then by exercise
  std::vector<std::string> complaints{};  ///< what was not accepted as it is: file, finding, what was wanted
  std::vector<RejectedSubmission> rejected{};  ///< those of the complaints that concern one student
  std::vector<std::string> notes{};            ///< other things that were found
};

/// Reads DIR/STUDENT/EXERCISE/main.cpp, or EXERCISE/main.cpp from the archive DIR/STUDENT.zip, which may
/// have one enclosing folder. Exercises may have their short names; `only` empty: all. Each folder and file
/// is opened once, with OpenedFolder, so that no link is followed and nothing that is swapped meanwhile is
/// read. A file that is not accepted never hides another; of two spellings of one name neither is accepted.
/// Throws Error if `folder` itself cannot be read.
[[nodiscard]] SubmittedFiles readSubmittedFiles(const std::filesystem::path& folder,
                                                const std::vector<submission::ExerciseInfo>& exercises,
                                                const std::string& only = {});

/// Writes the copy of a file that is graded, OUT/STUDENT/EXERCISE/main.cpp, and returns its path relative
/// to `out`. For a file that could not be read, the copy does not compile and says why. Throws Error if it
/// cannot be written.
[[nodiscard]] std::filesystem::path writeSnapshot(const SubmittedFile& file,
                                                  const std::filesystem::path& out);

/// Whether a name ends like the result files next to the students' folders: .csv, .log and others.
[[nodiscard]] bool isNameOfResults(const std::string& name);

/// Throws UsageError for an output file in the folder of results whose name a student may have.
void requireNameOfResults(const std::filesystem::path& file, const std::filesystem::path& out);

/// Why this cannot be the name of a student, which is also used for a folder and a table row; empty if it
/// can.
[[nodiscard]] std::string whyNoStudentName(const std::string& name);

}  // namespace rex::classroom
