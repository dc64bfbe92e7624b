#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace rex::authoring {

/// The files below `root` that are in its git history or index, as "src/a.h"; empty if root has no .git of
/// its own. Throws Error naming a file in `places` (names below root) that is neither known to git nor
/// ignored by .gitignore, because nobody has decided what to do with it. Also throws Error if git fails.
[[nodiscard]] std::optional<std::set<std::string>> knownFiles(const std::filesystem::path& root,
                                                              const std::vector<std::string>& places);

/// What students must not get before they solve an exercise, or ever.
enum class SecretKind {
  kSolution,
  kHiddenCheck,
  kHiddenName,
  kVisibleCheck,  ///< no secret of source trees, which packages are built from
  kWrongVariant,
  kLecturersNote,
  kCourseSecret
};

/// "a line of the solution", "a hidden check".
[[nodiscard]] std::string_view toString(SecretKind kind);

/// One piece of a secret, long enough to be distinctive.
struct Secret {
  SecretKind kind = SecretKind::kSolution;
  std::string text{};                ///< for messages: its first line; never the secret of the course
  SourceLocation origin{};           ///< where it is, below the root
  std::vector<std::string> forms{};  ///< normalText() to look for, each of at least kShortestForm letters
};
inline constexpr std::size_t kShortestForm = 16;

/// The secrets of these exercise folders below `root`: each line of a solution's regions; runs of at least
/// 48 letters of hidden checks and wrong variants, and of 64 of visible checks and of headers that only
/// checks include; literals of hidden checks; the headers of wrong variants; and the long lines of the
/// lecturer's notes in ROOT/notes, except for the questions that they quote. Public text is excluded: code
/// outside regions, the template and, except from solutions, what studentFiles() have; for hidden checks and
/// wrong variants also that of visible checks. Throws Error for malformed markers.
[[nodiscard]] std::vector<Secret> collectSecrets(const std::vector<std::filesystem::path>& exercises,
                                                 const std::filesystem::path& root);

/// The secret of the course in that file. Throws Error like readCourseSecret(), and if too little of it
/// remains to search for.
[[nodiscard]] Secret courseSecretIn(const std::filesystem::path& file);

}  // namespace rex::authoring
