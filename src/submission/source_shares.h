#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// Divides what a grader calls of a student's file, so that several compilers work on it at once: up to
/// `most` texts which, compiled apart and linked together, behave as these functions of the whole file do.
/// Each has the bodies of some functions, only declarations of the others, and no main(); all code keeps its
/// line and column. One text where something would be there twice, as a variable that can change; none where
/// the file is not understood well enough even for that. The caller compares with the whole file whether it
/// compiles at all.
[[nodiscard]] std::vector<std::string> sourceShares(std::string_view source,
                                                    const std::vector<std::string>& functions, int most);

}  // namespace rex::grading
