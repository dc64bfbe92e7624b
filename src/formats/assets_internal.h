#pragma once

#include <filesystem>
#include <string>
#include <vector>

// What the readers of scenes ask about files before they open one.
namespace rex::internal {

/// Whether a regular file lies there, links followed: opening a pipe might wait for ever.
[[nodiscard]] bool isRegularFile(const std::filesystem::path& path);

inline constexpr const char* kNoSuchFile = "no such file";

/// What lies there instead of a file that can be read, for a message: kNoSuchFile, "a folder", ...; empty if
/// nothing is in the way.
[[nodiscard]] std::string obstacleAt(const std::filesystem::path& path);

/// The absolute path without links, "." and "..", as far as it exists.
[[nodiscard]] std::filesystem::path realPath(const std::filesystem::path& path);

/// Whether `path` lies in `root` or is it, links followed.
[[nodiscard]] bool isInside(const std::filesystem::path& path, const std::filesystem::path& root);

/// The folder of a file; "." for a bare name.
[[nodiscard]] std::filesystem::path folderOf(const std::filesystem::path& file);

/// The names of what lies in the folder of a file, sorted; a user may have meant one of them.
[[nodiscard]] std::vector<std::string> namesBeside(const std::filesystem::path& file);

}  // namespace rex::internal
