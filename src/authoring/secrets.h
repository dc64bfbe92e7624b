#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace rex::grading {

/// What students must not get before they solve an exercise, or ever.
enum class SecretKind { kSolution, kHiddenCheck, kHiddenName, kWrongVariant, kCourseSecret };

/// "a line of the solution", "a hidden check".
[[nodiscard]] std::string_view nameOf(SecretKind kind);

/// One piece of it, long enough to be told from what everybody writes.
struct Secret {
  SecretKind kind = SecretKind::kSolution;
  std::string text{};                ///< for messages: the line where it begins; never the course's secret
  SourceLocation origin{};           ///< where it stands, below the root
  std::vector<std::string> forms{};  ///< normalText() to look for, each of at least kShortestForm letters
};
inline constexpr std::size_t kShortestForm = 16;

/// Of these folders of exercises below `root`: each line of a solution's regions; runs of at least 48 letters
/// of hidden checks and wrong variants, literals of hidden checks, the headers of wrong variants. Not what is
/// public: code outside of regions, the template, and, but for solutions, todos, headers and visible checks.
/// Throws Error for malformed markers.
[[nodiscard]] std::vector<Secret> secretsOf(const std::vector<std::filesystem::path>& exercises,
                                            const std::filesystem::path& root);

/// The secret of the course in that file. Throws Error as readCourseSecret(), and where too little of it can
/// be looked for.
[[nodiscard]] Secret courseSecretIn(const std::filesystem::path& file);

}  // namespace rex::grading
