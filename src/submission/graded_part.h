#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// A student's file without main() and the functions that only main() needs, which take as long to compile as
/// what is graded: `functions`, and all that those need. Blanks and declarations stand in their place, so
/// that the rest keeps its lines and columns and behaves as before. Empty where none of the functions is
/// there, or where one that is left out, other than main(), names one of `watched`. Whether the file compiles
/// is another question.
[[nodiscard]] std::string gradedPart(std::string_view source, const std::vector<std::string>& functions,
                                     const std::vector<std::string>& watched);

}  // namespace rex::grading
