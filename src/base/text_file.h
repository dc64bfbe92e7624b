#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rex {

/// The whole file. Throws Error when it cannot be read.
[[nodiscard]] std::string readTextFile(const std::filesystem::path& file);

/// Makes or replaces the file, in folders made where missing. Throws Error when that fails.
void writeTextFile(const std::filesystem::path& file, std::string_view text);

/// Replaces the file at once: a reader sees the old text or the new one, also after a kill or a power cut.
/// Throws Error "cannot write WHAT".
void replaceTextFile(const std::filesystem::path& file, std::string_view text, const std::string& what);

/// Waits until the file or the entries of the folder would survive a power cut. Throws Error when the disk
/// does not take a file; of folders, some file systems cannot tell.
void bringToDisk(const std::filesystem::path& fileOrFolder);

}  // namespace rex
