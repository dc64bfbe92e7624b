#pragma once
// A result file with what bulk grading keeps in it, opened once and parsed once:
//   const std::optional<grading::ResultFile> file = grading::readResultFile(folder / "results.json");
//   if (file && file->fault.empty()) points = file->result->score;

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "grading/results.h"
#include "sandbox/confinement.h"

namespace rex::grading {

/// What a result was made with, besides the text and the grader.
struct GradedWith {
  sandbox::Level level{};
  std::optional<std::uint64_t> seed{};
  std::string secretId{};  ///< of the course; empty: none
  bool alone = false;      ///< by `rex grade --student`: the settings of the class do not count
};

/// What bulk grading keeps in a result file, as `inputs` and in `volatile`; empty where it does not say.
struct ResultInputs {
  std::string sha256{};              ///< of everything that the result depends on
  std::string sourceSha256{};        ///< of the student's file
  std::string seal{};                ///< see computeSeal()
  std::string hmac{};                ///< of the seal, with the secret of the course
  std::optional<GradedWith> with{};  ///< the settings
  bool evidence = false;             ///< pictures and replays were kept
};

/// What one reading of a result file gives.
struct ResultFile {
  std::optional<GradeResult> result{};  ///< empty: the text is none
  /// Why nobody should rely on its points: the text is no result, they do not add up, the outcome does not
  /// fit the checks, or it was changed since it was sealed (see computeSeal()). Empty: they can be relied on.
  std::string fault{};
  ResultInputs inputs{};
};
/// Empty if there is no such file. Throws Error if it cannot be read.
[[nodiscard]] std::optional<ResultFile> readResultFile(const std::filesystem::path& file);

}  // namespace rex::grading
