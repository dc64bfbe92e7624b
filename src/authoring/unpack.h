#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// What is packed in another file.
struct PackedFile {
  std::string name{};  ///< as it stands there; empty for a file that is compressed only
  std::string bytes{};
};

/// Whether these bytes begin as a zip, tar, 7z, cpio or rar archive, or as a gzip, bzip2, xz, lzip or zstd
/// file.
[[nodiscard]] bool isPacked(std::string_view bytes);

/// The files in them, in memory: at most 256 MiB, and one level deep. Throws Error "cannot look into" with
/// the reason for what is broken, encrypted, larger or of a kind that cannot be read here.
[[nodiscard]] std::vector<PackedFile> unpack(std::string_view bytes, const std::string& file);

}  // namespace rex::grading
