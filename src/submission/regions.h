#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// The student's main.cpp made from solution.cpp. Between `// <solution NAME>` and `// </solution>` only the
/// lines `//| text` after `// <todo>` stay, uncommented at their own indentation. `file` is for messages.
/// Throws Error (file:line) for a marker that is unknown, unclosed, nested, repeated or out of place.
[[nodiscard]] std::string stripSolution(std::string_view solution, const std::string& file);

/// check.cpp without what lies between `// <hidden>` and `// </hidden>`. Throws Error (file:line).
[[nodiscard]] std::string stripHidden(std::string_view check, const std::string& file);

/// What stands outside of the regions of solution.cpp. Throws as stripSolution() does.
[[nodiscard]] std::string textOutsideRegions(std::string_view solution, const std::string& file);

/// solution.cpp without its markers and todos: what composeVariant() makes of it where nothing is replaced.
/// Throws as stripSolution() does.
[[nodiscard]] std::string referenceText(std::string_view solution, const std::string& file);

/// A line of a file with marked blocks, trimmed, by its number from 1.
struct BlockLine {
  int number = 0;
  std::string text{};
};

/// The lines that stripSolution() and stripHidden() leave out, block by block, without markers and todos.
/// Both throw as those do.
[[nodiscard]] std::vector<std::vector<BlockLine>> solutionBlocks(std::string_view solution,
                                                                 const std::string& file);
[[nodiscard]] std::vector<std::vector<BlockLine>> hiddenBlocks(std::string_view check,
                                                               const std::string& file);

/// A plausible mistake, as wrong/NAME.cpp describes it.
struct WrongVariant {
  std::vector<std::string> caughtBy;  ///< ids of checks, or kForbiddenCall
  std::vector<std::string> shownBy;   ///< ids of checks that leave a picture of it; may be empty
  std::string mistake;
  std::string source;  ///< complete main.cpp with the mistake in it
};

/// Stands among `caught by` for: refused before any check because it calls a forbidden function.
inline constexpr std::string_view kForbiddenCall = "forbidden-call";

/// Puts the regions of a wrong file in place of those of the solution. The file opens with
/// `// caught by: id, id`, perhaps `// shown by: id, id`, and `// mistake: text`, then holds `// <solution
/// NAME>` ... `// </solution>`. Throws Error (file:line) for a missing header line, a region the solution
/// lacks, text outside regions.
[[nodiscard]] WrongVariant composeVariant(std::string_view solution, const std::string& solutionFile,
                                          std::string_view wrong, const std::string& wrongFile);

}  // namespace rex::grading
