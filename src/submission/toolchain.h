#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rex::grading {

/// How student code of one exercise is compiled and graded; the build writes this to build.json.
struct Toolchain {
  std::string compiler;
  std::vector<std::string> flags;      ///< for compiling the student's file, including its include folders
  std::vector<std::string> linkFlags;  ///< for linking it to a program that finds the libraries
  std::filesystem::path workerObject;  ///< the loop that answers the grader
  std::filesystem::path grader;
  std::vector<std::filesystem::path> libraries;  ///< shared; all of rex that the student's program may call
  std::filesystem::path show{};          ///< an archive with drawing functions for main(); empty: none
  std::vector<std::string> functions{};  ///< the student's functions that the grader calls
  std::filesystem::path prefix{};        ///< see prefixFlags(); empty: none
  std::filesystem::path workerPart{};    ///< made by linkWorkerParts(); empty: workers have the whole library
  std::filesystem::path offers{};        ///< file with the names in it that graded functions may use
  std::string objcopy = "objcopy";
  std::string objdump = "objdump";
};

/// Reads build.json, with the words of installedText() replaced. Throws Error if it is missing (the exercise
/// is not built), or if a key other than prefix, show, worker_part, offers, objcopy and objdump is.
[[nodiscard]] Toolchain readToolchain(const std::filesystem::path& buildJson);

/// The text of an installed build description: it names folders as {rex} (ownFolder()), {home} (homeFolder())
/// and {include} (the library's headers), so that it holds wherever the tree was moved.
[[nodiscard]] std::string installedText(std::string text);

}  // namespace rex::grading
