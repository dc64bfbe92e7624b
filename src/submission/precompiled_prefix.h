#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// Flags that make g++ start from the precompiled header next to `prefix`, which includes only
/// course/course.h. Empty if that is missing or older than a file it was made from, if `prefix` is empty,
/// and unless the source opensWithCourseHeader(). `flags` are the other compiler flags. Messages and
/// program are the same with and without it.
[[nodiscard]] std::vector<std::string> prefixFlags(const std::filesystem::path& prefix,
                                                   std::string_view source,
                                                   const std::vector<std::string>& flags);

/// Whether a source includes "exercise.h" or "course/course.h" before anything except blank lines, //
/// comments, standard C++ headers, and headers in the -iquote and -isystem folders of the flags. Then
/// including course.h, which exercise.h includes, even earlier makes no difference.
[[nodiscard]] bool opensWithCourseHeader(std::string_view source, const std::vector<std::string>& flags);

}  // namespace rex::grading
