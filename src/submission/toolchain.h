#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rex::grading {

/// How student code of one exercise is compiled and graded: what the build wrote to build.json.
struct Toolchain {
  std::string compiler;
  std::vector<std::string> flags;      ///< for compiling the student's file, its include folders among them
  std::vector<std::string> linkFlags;  ///< for linking it to a program that finds the libraries
  std::filesystem::path workerObject;  ///< the loop that answers the grader
  std::filesystem::path grader;
  std::vector<std::filesystem::path> libraries;  ///< shared; all of rex that the student's program may call
  std::filesystem::path show{};          ///< an archive with what draws for main(); empty: nothing does
  std::vector<std::string> functions{};  ///< of the student's that the grader calls
  std::filesystem::path prefix{};        ///< see prefixFlags(); empty: none
  std::filesystem::path workerPart{};  ///< what linkWorkerParts() made; empty: workers have the whole library
  std::filesystem::path offers{};      ///< names in it that graded functions may use
  std::string objcopy = "objcopy";
  std::string objdump = "objdump";
};

/// Reads build.json. Throws Error when it is missing (the exercise is not built), or a key other than prefix,
/// show, worker_part, offers, objcopy and objdump is.
[[nodiscard]] Toolchain readToolchain(const std::filesystem::path& buildJson);

}  // namespace rex::grading
