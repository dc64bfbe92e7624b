#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "classroom/download.h"
#include "submission/work_time.h"

namespace rex::classroom {

/// The name of the table that `rex import` writes beside the students' folders.
inline constexpr const char* kImportTable = "import.json";
/// The same table while the files that it names are being written: what an interrupted import leaves.
inline constexpr const char* kBegunTable = "import.begun.json";

enum class SubmissionStatus {
  kHandedIn,
  kNothing,  ///< the student is on the platform's list, without a file
  kRejected  ///< there is a file, but none that can be graded
};

/// What a platform says about one student and one exercise. Empty texts: it says nothing.
struct ImportedExercise {
  std::string platform{};      ///< moodle, classroom, gradescope or folders
  std::string identifier{};    ///< by which that platform takes this grade back: "Participant 501"
  std::string maximumGrade{};  ///< of Moodle's grading worksheet, as written there
  SubmissionStatus status = SubmissionStatus::kNothing;
  std::string why{};                        ///< of a file that was not taken
  std::string handedInBy{};                 ///< the student whose folder holds the file: one for each group
  std::string group{};                      ///< its name on the platform
  std::optional<std::int64_t> submitted{};  ///< seconds since 1970 in UTC
  std::string timeFrom{};                   ///< platform, git (the student's clock) or file
  std::string commit{};                     ///< of a repository
  std::string source{};                     ///< path inside the download
  std::string sha256{};                     ///< of main.cpp as it was imported
  int attempts = 0;                         ///< how often it was handed in; 0: unknown
  std::string attemptsFrom{};  ///< platform, git (commits that changed it) or imports (at least so often)
  std::optional<submission::WorkTime> work{};  ///< handed in with `rex submit --progress`

  bool operator==(const ImportedExercise&) const = default;
};

struct ImportedStudent {
  std::string student{};  ///< the name of the folder, and of the student in all tables
  std::string id{};       ///< such as a matriculation number
  std::string name{};     ///< in Unicode's composed form (NFC)
  std::string email{};
  std::string githubUsername{};  ///< also the user of a GitLab clone
  std::map<std::string, ImportedExercise> exercises{};

  bool operator==(const ImportedStudent&) const = default;
};

/// Who handed in what, when and through which platform: share/grading/import.schema.json.
struct ImportTable {
  std::vector<ImportedStudent> students{};  ///< sorted by student

  /// The entry of that student; none: nullptr.
  [[nodiscard]] const ImportedStudent* find(const std::string& student) const;
  [[nodiscard]] const ImportedExercise* find(const std::string& student, const std::string& exercise) const;
};

/// Reads what importTableText() wrote. Throws Error, with the place inside the file, for anything else.
[[nodiscard]] ImportTable readImportTable(const std::filesystem::path& file);

/// The table in a folder of submissions or results; empty if it has none. Throws Error, too, after an import
/// that was interrupted.
[[nodiscard]] ImportTable importTableIn(const std::filesystem::path& folder);

/// The text of import.json. The same table gives the same bytes.
[[nodiscard]] std::string importTableText(const ImportTable& table);

/// Gives each person of a download an entry in the table, and a name for their folder that stays.
class ImportNames {
 public:
  /// `submissions` are asked for how often a name occurs.
  ImportNames(ImportTable& table, const DownloadedSubmissions& submissions);

  /// The name of the person's folder; adds or completes their entry. `exercises`: of this import, in which
  /// the platform's identifier means the same person.
  std::string personFolder(const Person& person, const std::vector<std::string>& exercises);

  /// How many people are known by their name alone, so that another of that name would be taken for them.
  [[nodiscard]] int knownByNameAlone() const { return byNameAlone_; }

 private:
  ImportedStudent* known(const Person& person, const std::vector<std::string>& exercises);
  std::string newName(const Person& person) const;

  ImportTable& table_;
  std::string platform_;
  std::map<std::string, int> nameCounts_;
  int byNameAlone_ = 0;
};

}  // namespace rex::classroom
