#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "classroom/download.h"
#include "submission/exercise_info.h"

namespace rex::grading {

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
[[nodiscard]] Layout layoutOf(const std::vector<std::string>& names,
                              const std::vector<ExerciseInfo>& exercises);

/// Reads what that importer takes. Throws UsageError for another layout, which says what was found and which
/// importer fits, and like readDownload().
[[nodiscard]] Download readDownloadOf(Platform platform, const std::filesystem::path& path,
                                      const std::vector<ExerciseInfo>& exercises);

/// Throws the same UsageError unless the folder has that layout.
void requireLayout(Platform platform, const std::filesystem::path& folder,
                   const std::vector<ExerciseInfo>& exercises);

/// The layout of a folder, as far as four levels tell it.
[[nodiscard]] Layout layoutOfFolder(const std::filesystem::path& folder,
                                    const std::vector<ExerciseInfo>& exercises);

/// The parts of "Zoe Miller_501_assignsubmission_file_main.cpp", as Moodle names files, or of
/// "Zoe Miller_501_assignsubmission_file_", as it names folders.
struct MoodleName {
  std::string person{};  ///< "Zoe Miller", with the group in front: "Group A-Zoe Miller"
  std::string number{};  ///< "501"
  std::string kind{};    ///< file or onlinetext
  std::string file{};    ///< empty for folders
};
[[nodiscard]] std::optional<MoodleName> parseMoodleName(const std::string& name);

/// The file in which Gradescope says who handed in what.
inline constexpr const char* kGradescopeMetadata = "submission_metadata.yml";

}  // namespace rex::grading
