#pragma once

#include <string>
#include <vector>

#include "grading/results.h"
#include "submission/cpp_text.h"

namespace rex::submission {

/// A warning for each quotient of two whole numbers that is written out and leaves a remainder: 1 / 2 is 0
/// in C++. Preprocessor directives are skipped, and a quotient that is itself divided or divides: in
/// x / 3 / 2 no 3 is divided.
[[nodiscard]] std::vector<grading::CompileDiagnostic> integerDivisions(const CppText& text,
                                                                       const std::string& name);

/// The header with the questions that withAutoQuestions() asks, for the flag -include.
inline constexpr const char* kAutoQuestions = "course/auto_guard.h";

/// The source with a question to the compiler after each declaration `auto name = ...;` of one line, on that
/// line: does the variable hold an expression of Eigen, which refers to other matrices, some of which may be
/// gone? Returns an empty text if there is no such declaration.
[[nodiscard]] std::string withAutoQuestions(const CppText& text);

/// Puts our words and the place in the source into the answers among the compiler's messages.
void explainAutoAnswers(std::vector<grading::CompileDiagnostic>& messages, const CppText& text);

}  // namespace rex::submission
