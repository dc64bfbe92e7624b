#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/build_tools.h"

namespace rex::submission {

/// Flags that make g++ start from the precompiled header next to `prefix`, which includes only
/// course/course.h. Empty if that is missing or was made from other files, if `prefix` is empty, and unless
/// the source opensWithCourseHeader(). `flags` are the other compiler flags. Messages and program are the
/// same with and without it.
[[nodiscard]] std::vector<std::string> prefixFlags(const std::filesystem::path& prefix,
                                                   std::string_view source,
                                                   const std::vector<std::string>& flags);

/// Makes `prefix`, and beside it what prefixFlags() looks for, unless it is there and current. Throws Error
/// if the toolchain's compiler refuses the header, or is not done after `longest` seconds; then nothing that
/// it wrote is left.
void makePrefix(const std::filesystem::path& prefix, const Toolchain& toolchain, double longest = 300);

/// Whether a source includes "exercise.h" or "course/course.h" before anything except blank lines, //
/// comments, standard C++ headers, and headers in the -iquote and -isystem folders of the flags. Then
/// including course.h, which exercise.h includes, even earlier makes no difference.
[[nodiscard]] bool opensWithCourseHeader(std::string_view source, const std::vector<std::string>& flags);

/// One of the shared libraries of rex that programs may be linked with.
struct LibraryPart {
  std::string target;                  ///< build target: "rex_planning"
  std::filesystem::path file{};        ///< once it is built
  std::string folder{};                ///< of its sources, relative to the library's: "planning"
  std::vector<std::string> headers{};  ///< headers in that folder whose functions are defined here
  std::vector<std::string> symbols{};  ///< functions of other headers that are defined here
  std::vector<std::string> uses{};     ///< targets that it is linked with
};

/// How to build a program that is not an exercise; the build writes this to program.json.
struct ProgramToolchain {
  Toolchain toolchain;                 ///< without libraries, worker and grader
  std::filesystem::path sourceFolder;  ///< of the library
  std::vector<LibraryPart> libraries{};
};

/// Reads program.json. Throws Error if it or a key is missing (the project is not built).
[[nodiscard]] ProgramToolchain readProgramToolchain(const std::filesystem::path& programJson);

/// The libraries that a program compiled with these files needs, and those that they use, in the order of
/// the toolchain. For each library header this is the library that lists it, or else the first one of its
/// folder; also those that define an undefined symbol in `symbolTable`, the output of `objdump -t -C` for
/// the object file.
[[nodiscard]] std::vector<LibraryPart> librariesFor(const ProgramToolchain& program,
                                                    const std::vector<std::filesystem::path>& files,
                                                    std::string_view symbolTable);

}  // namespace rex::submission
