#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "submission/exercise_info.h"

namespace rex::classroom {

/// One file of a download.
struct DownloadedFile {
  std::string name{};   ///< path with slashes, inside the download or what one student handed in
  std::string place{};  ///< path inside the download, for messages
  std::optional<std::string> text{};  ///< of sources, archives and tables; empty: others, and what is refused
  std::string whyNot{};               ///< why a wanted file has no text: "a symbolic link"
  std::int64_t modifiedAt = 0;        ///< seconds since 1970 in UTC; 0: unknown
  int attempts = 0;                   ///< how often it was handed in; 0: the platform does not say
};

/// What a lecturer downloaded from a platform: an archive, or the folder that it was unpacked into.
struct Download {
  std::filesystem::path path{};
  std::vector<DownloadedFile> files{};  ///< by name
};

/// Reads an archive as readBundle() does, or a folder without following links, except repositories (`.git`)
/// in it. Throws Error if it cannot be read, and UsageError if there is neither.
[[nodiscard]] Download readDownload(const std::filesystem::path& path);

/// Whether a file is made by an operating system by itself: `__MACOSX`, `.DS_Store` and others.
[[nodiscard]] bool isOfSystem(const std::filesystem::path& name);

/// Whether the name ends like that of a C++ source file.
[[nodiscard]] bool isSourceName(const std::string& name);

/// The platforms whose layouts are known.
enum class Platform { kMoodle, kGit, kGradescope, kFolders };
[[nodiscard]] std::string_view toString(Platform platform);

/// What lies in a folder or an archive, by its names.
struct Layout {
  std::optional<Platform> platform{};  ///< whose importer takes it; empty: unknown
  bool isReady = false;                ///< STUDENT/EXERCISE/main.cpp, which `rex grade` takes as it is
  std::string found{};                 ///< "12 entries such as 'Zoe_501_assignsubmission_file_'"
};

/// The layout of files with these names, paths with slashes. A repository has a name such as "zoe/.git/HEAD".
[[nodiscard]] Layout recognizeLayout(const std::vector<std::string>& names,
                                     const std::vector<submission::ExerciseInfo>& exercises);

/// Reads what that importer takes. Throws UsageError for another layout, which says what was found and which
/// importer fits, and like readDownload().
[[nodiscard]] Download readPlatformDownload(Platform platform, const std::filesystem::path& path,
                                            const std::vector<submission::ExerciseInfo>& exercises);

/// Throws the same UsageError unless the folder has that layout.
void requireLayout(Platform platform, const std::filesystem::path& folder,
                   const std::vector<submission::ExerciseInfo>& exercises);

/// The layout of a folder, as far as four levels tell it.
[[nodiscard]] Layout recognizeFolderLayout(const std::filesystem::path& folder,
                                           const std::vector<submission::ExerciseInfo>& exercises);

/// The parts of "Zoe Miller_501_assignsubmission_file_main.cpp", as Moodle names files, or of
/// "Zoe Miller_501_assignsubmission_file", as it names folders from version 4.1 on; before, they ended in
/// "_".
struct MoodleName {
  std::string person{};  ///< "Zoe Miller", or "Group A-Zoe Miller", or "Group A" for a team from 4.1 on
  std::string number{};  ///< "501": of the participant, or of the team
  std::string kind{};    ///< file or onlinetext
  std::string file{};    ///< empty for folders
};
[[nodiscard]] std::optional<MoodleName> parseMoodleName(const std::string& name);

/// The file in which Gradescope says who handed in what.
inline constexpr const char* kGradescopeMetadata = "submission_metadata.yml";

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
struct DownloadedSubmission {
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
struct DownloadedSubmissions {
  Platform platform{};
  std::vector<DownloadedSubmission> all{};
  std::vector<std::string> complaints{};  ///< what was not taken, as it belongs to nobody
  std::vector<std::string> doubts{};      ///< what was taken, though something contradicts it
  std::vector<std::string> notes{};
};

struct MoodleOptions {
  std::filesystem::path worksheet{};  ///< the CSV file of "Download grading worksheet"; empty: none
  std::string timeZone{};             ///< in which it writes times; empty: unknown
};
/// Reads the zip of "Download all submissions", or the folder it was unpacked into, with a folder or a file
/// for each student or each team; the column Group of the worksheet says who is in a team. Members of a group
/// with the same files are one submission. Throws UsageError for another layout and a worksheet that is none.
[[nodiscard]] DownloadedSubmissions readMoodle(const std::filesystem::path& source,
                                               const MoodleOptions& options,
                                               const std::vector<submission::ExerciseInfo>& exercises);

/// Reads the zip of "Export Submissions", or its folder. Throws like readMoodle().
[[nodiscard]] DownloadedSubmissions readGradescope(const std::filesystem::path& source,
                                                   const std::vector<submission::ExerciseInfo>& exercises);

struct CloneOptions {
  std::filesystem::path roster{};  ///< CSV file that says who is who; empty: none
  std::filesystem::path record{};  ///< CSV file: when which repository was handed in; empty: none
  std::string timeZone{};          ///< of times in the record that have none; empty: unknown
  std::string assignment{};        ///< what the names of clones begin with; empty: what they have in common
  std::optional<std::int64_t> deadline{};  ///< take the last commit until then
};
/// Reads a folder of clones. Throws like readMoodle().
[[nodiscard]] DownloadedSubmissions readClones(const std::filesystem::path& source,
                                               const CloneOptions& options,
                                               const std::vector<submission::ExerciseInfo>& exercises);

/// Reads NAME/main.cpp, NAME.cpp and NAME.zip. Throws like readMoodle().
[[nodiscard]] DownloadedSubmissions readFolders(const std::filesystem::path& source,
                                                const std::vector<submission::ExerciseInfo>& exercises);

}  // namespace rex::classroom
