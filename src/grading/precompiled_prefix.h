#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// Flags that let g++ start from the precompiled header beside `prefix`, which includes course/course.h
/// alone; none when that is missing or older than a file it was made of, when `prefix` is empty, and unless
/// the source opensWithExerciseHeader(). Messages and program are the same with and without.
[[nodiscard]] std::vector<std::string> prefixFlags(const std::filesystem::path& prefix,
                                                   std::string_view source);

/// Whether a source includes "exercise.h" before anything but blank lines, // comments and other headers of
/// the include path: then it makes no difference that course.h, which that includes, comes even earlier.
[[nodiscard]] bool opensWithExerciseHeader(std::string_view source);

}  // namespace rex::grading
