#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "grading/results.h"

namespace rex::grading {

/// A warning for each quotient of two whole numbers that is written out and leaves a remainder: 1 / 2 is 0
/// in C++. Comments and lines with text in quotes are skipped.
[[nodiscard]] std::vector<CompileDiagnostic> integerDivisions(std::string_view source,
                                                              const std::string& name);

}  // namespace rex::grading
