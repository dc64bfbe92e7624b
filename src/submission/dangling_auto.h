#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "grading/results.h"

namespace rex::grading {

/// The header with the questions that withAutoQuestions() asks, for the flag -include.
inline constexpr const char* kAutoQuestions = "course/auto_guard.h";

/// The source with a question to the compiler after each declaration `auto name = ...;` of one line, on that
/// line: does the variable hold an expression of Eigen, which refers to other matrices, some of which may be
/// gone? Returns an empty text if there is no such declaration.
[[nodiscard]] std::string withAutoQuestions(std::string_view source);

/// Puts our words and the place in `source` into the answers among the compiler's messages.
void explainAutoAnswers(std::vector<CompileDiagnostic>& messages, std::string_view source);

}  // namespace rex::grading
