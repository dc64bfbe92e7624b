#pragma once

#include <string>
#include <vector>

#include "grading/results.h"
#include "submission/cpp_text.h"

namespace rex::grading {

/// A warning for each quotient of two whole numbers that is written out and leaves a remainder: 1 / 2 is 0
/// in C++. Preprocessor directives are skipped, and a quotient that is itself divided or divides: in
/// x / 3 / 2 no 3 is divided.
[[nodiscard]] std::vector<CompileDiagnostic> integerDivisions(const CppText& text, const std::string& name);

}  // namespace rex::grading
