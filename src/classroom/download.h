#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rex::grading {

/// One file of a download.
struct DownloadedFile {
  std::string name{};   ///< path with slashes, inside the download or what one student handed in
  std::string place{};  ///< path inside the download, for messages
  std::optional<std::string> text{};  ///< of sources, archives and tables; empty: others, and what is refused
  std::string whyNot{};               ///< why a wanted file has no text: "a symbolic link"
  std::int64_t modifiedAt = 0;        ///< seconds since 1970 in UTC; 0: unknown
  int attempts = 0;                   ///< how often it was handed in; 0: the platform does not say
};

/// What a lecturer downloaded from a platform: an archive, or the folder that it was unpacked into.
struct Download {
  std::filesystem::path path{};
  std::vector<DownloadedFile> files{};  ///< by name
};

/// Reads an archive as readBundle() does, or a folder without following links, except repositories (`.git`)
/// in it. Throws Error if it cannot be read, and UsageError if there is neither.
[[nodiscard]] Download readDownload(const std::filesystem::path& path);

/// Whether a file is made by an operating system by itself: `__MACOSX`, `.DS_Store` and others.
[[nodiscard]] bool isOfSystem(const std::filesystem::path& name);

/// Whether the name ends like that of a C++ source file.
[[nodiscard]] bool isSourceName(const std::string& name);

}  // namespace rex::grading
