#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// Makes the student's main.cpp from solution.cpp. Between `// <solution NAME>` and `// </solution>` only
/// the lines `//| text` after `// <todo>` remain, uncommented at their own indentation. `file` is for
/// messages. Throws Error (file:line) for a marker that is unknown, unclosed, nested, repeated or
/// misplaced.
[[nodiscard]] std::string stripSolution(std::string_view solution, const std::string& file);

/// check.cpp without the blocks between `// <hidden>` and `// </hidden>`. Throws Error (file:line).
[[nodiscard]] std::string stripHidden(std::string_view check, const std::string& file);

/// The text outside the regions of solution.cpp. Throws like stripSolution().
[[nodiscard]] std::string textOutsideRegions(std::string_view solution, const std::string& file);

/// solution.cpp without its markers and todos: what composeVariant() makes of it if nothing is replaced.
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

/// A plausible mistake, as described by wrong/NAME.cpp.
struct WrongVariant {
  std::vector<std::string> caughtBy;  ///< ids of checks, or kForbiddenCall
  std::vector<std::string> shownBy;   ///< ids of checks that write a picture of it; may be empty
  std::string mistake;
  std::string source;  ///< complete main.cpp with the mistake in it
};

/// In `caught by`: the variant is rejected before any check because it calls a forbidden function.
inline constexpr std::string_view kForbiddenCall = "forbidden-call";

/// Replaces regions of the solution by those of a wrong file. The file begins with `// caught by: id, id`,
/// perhaps `// shown by: id, id`, and `// mistake: text`, then contains `// <solution NAME>` ... `//
/// </solution>`. Throws Error (file:line) for a missing header line, a region that the solution lacks, and
/// text outside regions.
[[nodiscard]] WrongVariant composeVariant(std::string_view solution, const std::string& solutionFile,
                                          std::string_view wrong, const std::string& wrongFile);

}  // namespace rex::grading
