#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// Flags that let g++ start from the precompiled header beside `prefix`, which includes course/course.h
/// alone; none when that is missing or, by the times of the files, older than one it was made of, when
/// `prefix` is empty, and unless the source opensWithCourseHeader(). `flags` are the compiler's others.
/// Messages and program are the same with and without.
[[nodiscard]] std::vector<std::string> prefixFlags(const std::filesystem::path& prefix,
                                                   std::string_view source,
                                                   const std::vector<std::string>& flags);

/// Whether a source includes "exercise.h" or "course/course.h" before anything but blank lines, // comments,
/// headers of standard C++, and such as lie in the folders of -iquote and -isystem in the flags: then it
/// makes no difference that course.h, which the first includes, comes even earlier.
[[nodiscard]] bool opensWithCourseHeader(std::string_view source, const std::vector<std::string>& flags);

}  // namespace rex::grading
