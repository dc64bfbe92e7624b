#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/project.h"
#include "submission/student_build.h"

namespace rex::cli {

/// The file to work on: `main` if given, the exercise's solution.cpp if asked for, else its main.cpp.
/// Throws UsageError if the solution is requested in a tree without one.
[[nodiscard]] std::filesystem::path chooseStudentFile(const ExerciseInfo& exercise, bool solution,
                                                      const std::filesystem::path& main = {});

/// Compiles the file and links the student's program, keeping the log in out/build.log. If the file has
/// errors, it prints them and returns no program. Throws Error if the tools fail, and like prepare().
[[nodiscard]] std::optional<std::filesystem::path> buildProgram(
    const Project& project, const ExerciseInfo& exercise, const submission::StudentBuildOptions& options,
    const std::filesystem::path& out);

/// The same with any toolchain and a file for the log; `beforeLinking` is called with the compiled file.
[[nodiscard]] std::optional<std::filesystem::path> buildProgram(
    const submission::Toolchain& toolchain, const submission::StudentBuildOptions& options,
    const std::filesystem::path& log,
    const std::function<void(const submission::StudentObject& object)>& beforeLinking);

/// The same for the worker, which grading talks to.
[[nodiscard]] std::optional<std::filesystem::path> buildWorker(const Project& project,
                                                               const ExerciseInfo& exercise,
                                                               const submission::StudentBuildOptions& options,
                                                               const std::filesystem::path& out);

/// Prints the first error in detail, the number of others, and where the log is.
void explain(const std::vector<grading::CompileDiagnostic>& messages, const std::string& source,
             const std::filesystem::path& log);

}  // namespace rex::cli
