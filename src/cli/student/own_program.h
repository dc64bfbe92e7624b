#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "cli/project.h"

namespace rex::cli {

/// What a user means who gives this to `rex run`: a program of his own, any path that ends in .cpp, links
/// followed, or an exercise, also where its main.cpp is named by a path. Throws UsageError, with the nearest
/// names, for a file that is not there, and as Project::exercise().
[[nodiscard]] std::variant<std::filesystem::path, ExerciseInfo> programMeant(const Project& project,
                                                                             const std::string& argument);

/// out/NAME for NAME.cpp, and for FOLDER/main.cpp out/FOLDER. Throws UsageError where that is the folder of
/// an exercise.
[[nodiscard]] std::filesystem::path outFolderOf(const Project& project, const std::filesystem::path& file);

/// Compiles the file as a student's, with the headers beside it, brings the parts of the library up to date
/// that its headers belong to, and links it. Prints what is wrong with the file and returns no program then;
/// the log goes to out/build.log. Throws Error when the tools fail, and BuildFailure as bringUpToDate().
[[nodiscard]] std::optional<std::filesystem::path> buildOwnProgram(const Project& project,
                                                                   const std::filesystem::path& file,
                                                                   const std::filesystem::path& workFolder,
                                                                   const std::filesystem::path& out);

}  // namespace rex::cli
