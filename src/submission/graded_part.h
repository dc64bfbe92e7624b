#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// The graded part of a student's file: `functions` and everything they need. main() and what only main()
/// needs, which takes as long to compile, is replaced by blanks and declarations, so that the rest keeps
/// its lines, columns and behaviour. Empty if none of the functions exists, or if a removed function other
/// than main() names one of `watched`. The result need not compile.
[[nodiscard]] std::string gradedPart(std::string_view source, const std::vector<std::string>& functions,
                                     const std::vector<std::string>& watched);

}  // namespace rex::grading
