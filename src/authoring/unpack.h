#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// A file that is packed in another file.
struct PackedFile {
  std::string name{};  ///< as stored there; empty for a file that is only compressed
  std::string bytes{};
};

/// Whether these bytes begin as a zip, tar, 7z, cpio or rar archive, or as a gzip, bzip2, xz, lzip or zstd
/// file.
[[nodiscard]] bool isPacked(std::string_view bytes);

/// The packed files, in memory: at most 256 MiB, and one level deep. Throws Error "cannot look into" with
/// the reason for files that are broken, encrypted, larger, or of a kind that cannot be read.
[[nodiscard]] std::vector<PackedFile> unpack(std::string_view bytes, const std::string& file);

}  // namespace rex::grading
