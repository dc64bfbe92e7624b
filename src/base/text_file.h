#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rex {

/// The whole file. Throws Error if it cannot be read.
[[nodiscard]] std::string readTextFile(const std::filesystem::path& file);

/// Makes or replaces the file, and makes missing folders. Throws Error if that fails.
void writeTextFile(const std::filesystem::path& file, std::string_view text);

/// Replaces the file atomically: a reader sees the old text or the new one, even after a kill or a power
/// cut. Throws Error "cannot write WHAT".
void replaceTextFile(const std::filesystem::path& file, std::string_view text, const std::string& what);

/// Waits until the file or the entries of the folder would survive a power cut. Throws Error if the disk
/// does not take a file; for folders, some file systems cannot tell.
void bringToDisk(const std::filesystem::path& fileOrFolder);

}  // namespace rex
