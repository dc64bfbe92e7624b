#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sandbox/confinement.h"

namespace rex::classroom {

/// One grading task: a student's file for one exercise, and everything that its result depends on.
struct Task {
  std::string student{};
  std::string exercise{};
  std::string sourceSha256{};  ///< hash of the copy's text: see writeSnapshot()
  std::string graderSha256{};  ///< see graderFingerprint()
  sandbox::Level level{};
  std::optional<std::uint64_t> seed{};
  std::string secretId{};        ///< id of the secret of the course; empty: none
  std::int64_t submitted = 0;    ///< seconds since 1970 in UTC
  std::string timeFrom{};        ///< the source of that time
  std::filesystem::path file{};  ///< file to grade; relative to the output folder, or absolute

  /// Hash of everything the result depends on; the time of submission is not part of it.
  [[nodiscard]] std::string inputsSha256() const;
};

/// The text of tasks.tsv: a header line, then one line per task, easy to count and split for any batch
/// system.
[[nodiscard]] std::string toManifest(const std::vector<Task>& tasks);

/// Reads it back. Throws Error with the line if the text is malformed.
[[nodiscard]] std::vector<Task> readManifest(const std::filesystem::path& file);

/// "1,4-6,9": how batch systems name tasks.
[[nodiscard]] std::string numberRanges(std::vector<int> numbers);

}  // namespace rex::classroom
