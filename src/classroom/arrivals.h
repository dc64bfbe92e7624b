#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "classroom/download.h"
#include "classroom/download_layout.h"
#include "submission/exercise_info.h"

namespace rex::grading {

/// A person as a platform knows them. Empty texts: it does not say.
struct Person {
  std::string id{};
  std::string name{};
  std::string email{};
  std::string githubUsername{};
  std::string identifier{};    ///< by which the platform takes the grade back
  std::string number{};        ///< of the platform, which tells two people of one name apart
  std::string maximumGrade{};  ///< of Moodle's worksheet
};

/// What one student or one group handed in, or a student who handed in nothing.
struct Arrival {
  std::vector<Person> people{};  ///< the members of a group; at least one
  std::string group{};
  std::string place{};                  ///< in the download, for messages
  std::vector<DownloadedFile> files{};  ///< named from the student's own folder on
  std::string whyNone{};                ///< why no file could be taken from what was handed in
  std::optional<std::int64_t> submitted{};
  std::string timeFrom{};  ///< platform or git; empty: the files tell it
  std::string commit{};
};

/// What a download contains.
struct Arrivals {
  Platform platform{};
  std::vector<Arrival> all{};
  std::vector<std::string> complaints{};  ///< what belongs to nobody or contradicts itself
  std::vector<std::string> notes{};
};

struct MoodleOptions {
  std::filesystem::path worksheet{};  ///< the CSV file of "Download grading worksheet"; empty: none
  std::string timeZone{};             ///< in which it writes times; empty: unknown
};
/// Reads the zip of "Download all submissions", or the folder it was unpacked into, with a folder or a file
/// for each student. Members of a group with the same files are one arrival. Throws UsageError for another
/// layout and a worksheet that is none.
[[nodiscard]] Arrivals readMoodle(const std::filesystem::path& source, const MoodleOptions& options,
                                  const std::vector<ExerciseInfo>& exercises);

/// Reads the zip of "Export Submissions", or its folder. Throws like readMoodle().
[[nodiscard]] Arrivals readGradescope(const std::filesystem::path& source,
                                      const std::vector<ExerciseInfo>& exercises);

struct CloneOptions {
  std::filesystem::path roster{};  ///< CSV file that says who is who; empty: none
  std::filesystem::path record{};  ///< CSV file: when which repository was handed in; empty: none
  std::string assignment{};        ///< what the names of clones begin with; empty: what they have in common
  std::optional<std::int64_t> deadline{};  ///< take the last commit until then
};
/// Reads a folder of clones. Throws like readMoodle().
[[nodiscard]] Arrivals readClones(const std::filesystem::path& source, const CloneOptions& options,
                                  const std::vector<ExerciseInfo>& exercises);

/// Reads NAME/main.cpp, NAME.cpp and NAME.zip. Throws like readMoodle().
[[nodiscard]] Arrivals readFolders(const std::filesystem::path& source,
                                   const std::vector<ExerciseInfo>& exercises);

}  // namespace rex::grading
