#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/toolchain.h"

namespace rex::grading {

/// A shared library of rex, one of those that programs may be linked with.
struct LibraryPart {
  std::string target;                  ///< of the build: "rex_planning"
  std::filesystem::path file{};        ///< once it is built
  std::string folder{};                ///< of its sources, below that of the library: "planning"
  std::vector<std::string> headers{};  ///< in that folder, whose functions have their bodies here
  std::vector<std::string> symbols{};  ///< functions of other headers that have theirs here
  std::vector<std::string> uses{};     ///< targets that it is linked with itself
};

/// How to build a program that is not an exercise: what the build wrote to program.json.
struct ProgramToolchain {
  Toolchain toolchain;                 ///< without libraries, worker and grader
  std::filesystem::path sourceFolder;  ///< of the library
  std::vector<LibraryPart> libraries{};
};

/// Reads program.json. Throws Error when it is missing (the project is not built), or a key is.
[[nodiscard]] ProgramToolchain readProgramToolchain(const std::filesystem::path& programJson);

/// The libraries that a program needs which was compiled with these files, and all that those use, in the
/// order of the toolchain: of each header of the library the one with its body or, where none has its name,
/// the first of its folder; and those with a symbol that `symbolTable`, what `objdump -t -C` prints of the
/// object file, has as undefined.
[[nodiscard]] std::vector<LibraryPart> librariesFor(const ProgramToolchain& program,
                                                    const std::vector<std::filesystem::path>& files,
                                                    std::string_view symbolTable);

}  // namespace rex::grading
