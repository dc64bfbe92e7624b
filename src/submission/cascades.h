#pragma once

#include <string_view>
#include <vector>

#include "grading/results.h"

namespace rex::grading {

/// Adds a sentence to each visible check that failed in a function which calls, itself or through others of
/// the file, a function that failed in an earlier check: "circle uses ikStep, which fails above [step-hand]."
void explainCascades(std::vector<CheckResult>& checks, std::string_view source);

}  // namespace rex::grading
