#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sandbox/level.h"

namespace rex::grading {

/// One grading: a student's file of one exercise, and all that its result depends on.
struct Task {
  std::string student{};
  std::string exercise{};
  std::string sourceSha256{};  ///< of the copy's text: see snapshotOf()
  std::string graderSha256{};  ///< see graderFingerprint()
  sandbox::Level level{};
  std::optional<std::uint64_t> seed{};
  std::string secretId{};        ///< of the secret of the course; empty: none
  std::int64_t submitted = 0;    ///< seconds since 1970 in UTC
  std::string timeFrom{};        ///< where that time comes from
  std::filesystem::path file{};  ///< to grade; relative to the output folder, or absolute

  /// Hash of everything the result depends on; when it was submitted does not count.
  [[nodiscard]] std::string inputsSha256() const;
};

/// One line per task, after a line of headings: tasks.tsv, which any engine can count and cut.
[[nodiscard]] std::string toManifest(const std::vector<Task>& tasks);

/// Throws Error, with the line, for what is not such a text.
[[nodiscard]] std::vector<Task> readManifest(const std::filesystem::path& file);

}  // namespace rex::grading
