#pragma once

#include <string>
#include <vector>

#include "grading/results.h"
#include "submission/cpp_text.h"

namespace rex::grading {

/// The header with the questions that withAutoQuestions() asks, for the flag -include.
inline constexpr const char* kAutoQuestions = "course/auto_guard.h";

/// The source with a question to the compiler after each declaration `auto name = ...;` of one line, on that
/// line: does the variable hold an expression of Eigen, which refers to other matrices, some of which may be
/// gone? Returns an empty text if there is no such declaration.
[[nodiscard]] std::string withAutoQuestions(const CppText& text);

/// Puts our words and the place in the source into the answers among the compiler's messages.
void explainAutoAnswers(std::vector<CompileDiagnostic>& messages, const CppText& text);

}  // namespace rex::grading
