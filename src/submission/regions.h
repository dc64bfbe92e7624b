#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace rex::submission {

/// Makes the student's main.cpp from solution.cpp. Between `// <solution NAME>` and `// </solution>` only
/// the lines `//| text` after `// <todo>` remain, uncommented at their own indentation. `file` is for
/// messages. Throws Error (file:line:column) for a marker that is unknown, unclosed, nested, repeated or
/// misplaced.
[[nodiscard]] std::string stripSolution(std::string_view solution, const std::string& file);

/// check.cpp without the blocks between `// <hidden>` and `// </hidden>`. Throws Error (file:line:column).
[[nodiscard]] std::string stripHidden(std::string_view check, const std::string& file);

/// The text outside the regions of solution.cpp. Throws like stripSolution().
[[nodiscard]] std::string textOutsideRegions(std::string_view solution, const std::string& file);

/// solution.cpp without its markers and todos: what readVariants() makes of it if nothing is replaced.
/// Throws like stripSolution().
[[nodiscard]] std::string referenceText(std::string_view solution, const std::string& file);

/// A trimmed line of a file with marked blocks, and its number from 1.
struct BlockLine {
  int number = 0;
  std::string text{};
};

/// The lines that stripSolution() and stripHidden() remove, block by block, without markers and todos. Both
/// throw like these.
[[nodiscard]] std::vector<std::vector<BlockLine>> solutionBlocks(std::string_view solution,
                                                                 const std::string& file);
[[nodiscard]] std::vector<std::vector<BlockLine>> hiddenBlocks(std::string_view check,
                                                               const std::string& file);

/// A plausible mistake, as a section of wrong.cpp describes it.
struct WrongVariant {
  std::string name{};
  std::vector<std::string> caughtBy{};  ///< ids of checks, or kForbiddenCall
  std::vector<std::string> shownBy{};   ///< ids of checks that write a picture of it; may be empty
  std::string mistake{};
  std::string question{};                           ///< asked by checks that recognise it; empty: none
  std::string source{};                             ///< complete main.cpp with the mistake in it
  std::map<std::string, SourceLocation> namedAt{};  ///< where wrong.cpp names each of these checks
};

/// In `caught by`: the variant is rejected before any check because it calls a forbidden function.
inline constexpr std::string_view kForbiddenCall = "forbidden-call";

/// The variants of wrong.cpp in order. A section begins with `// <variant NAME> caught by: id, id`, in one
/// line or two, then come the lines `// shown by: id, id` and `// ask: question`, as many as it takes, and
/// `// mistake: text`, then regions, each after a line `// <solution NAME>`, which replace those of the
/// solution. A region with a line `// in place of: TEXT` replaces only that line of the solution which begins
/// with TEXT, and with `TEXT ... END` all from there to the next line that begins with END. Regions and
/// sections end at the next marker, without the blank lines before it. Before the first section there may be
/// comments. Throws Error (file:line:column) for an unknown, repeated or misplaced marker, an unknown or
/// missing line, a region or passage that the solution lacks, a section without one, and code outside
/// regions.
[[nodiscard]] std::vector<WrongVariant> readVariants(std::string_view solution,
                                                     const std::string& solutionFile, std::string_view wrong,
                                                     const std::string& wrongFile);

/// The names of the variants of wrong.cpp in order, also if other lines are malformed.
[[nodiscard]] std::vector<std::string> variantNamesIn(std::string_view wrong);

/// The lines of each variant without markers. Throws Error (file:line:column) for a malformed marker.
[[nodiscard]] std::vector<std::vector<BlockLine>> variantBlocks(std::string_view wrong,
                                                                const std::string& file);

}  // namespace rex::submission
