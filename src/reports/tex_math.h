#pragma once

#include <string>
#include <string_view>

namespace rex::grading {

/// Converts a formula to a <math> element of MathML Core, which browsers draw without a script or a font of
/// ours. Knows the part of TeX that formulas of a lecture need: scripts, \frac, \sqrt, \left and \right,
/// accents, \text, alphabets such as \mathbb, names of functions, Greek letters, usual signs, and the
/// environments matrix, pmatrix, bmatrix, cases and aligned. Throws Error for anything else.
[[nodiscard]] std::string mathMlOf(std::string_view tex, bool isDisplayed);

}  // namespace rex::grading
