#pragma once

#include <filesystem>

namespace rex::grading {

/// Waits until the file or the entries of the folder would survive a power cut. Throws Error when the disk
/// does not take a file; of folders, some file systems cannot tell.
void bringToDisk(const std::filesystem::path& fileOrFolder);

}  // namespace rex::grading
