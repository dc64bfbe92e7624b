#pragma once
// The order in which `rex watch` runs checks: those of what changed since the last save first, slow ones
// last. So the verdict for which a student waits comes before that of a search of half a minute.
//   job.checks = checkOrder(listed, {.last = last.checks, .before = text, .now = newText}).ids;
#include <cstddef>
#include <string>
#include <vector>

#include "grading/results.h"

namespace rex::cli {

/// Seconds of processor time from which a check is called slow.
inline constexpr double kSlowCheck = 3;

/// What is known when a file was saved.
struct SavedFile {
  std::vector<grading::CheckResult> last{};  ///< the checks of the last test; empty: there was none
  std::string before{};                      ///< the text of that test; empty: not known
  std::string now{};
};

struct CheckOrder {
  std::vector<std::string> ids{};  ///< all checks
  std::size_t changed = 0;         ///< the first so many are about what changed
};

/// A check is about what changed if it failed in a function whose text is another now, or one of its part
/// did. Then come other checks that failed, then those that passed, in their own order; slow ones are the
/// last unless they are about what changed.
[[nodiscard]] CheckOrder checkOrder(const std::vector<grading::CheckResult>& listed, const SavedFile& file);

}  // namespace rex::cli
