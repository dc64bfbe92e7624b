#pragma once

#include <filesystem>

namespace rex {

/// Joins the pictures 0000.png, 0001.png, ... of `folder` into a video `file` (.mp4, H.264, `rate` pictures
/// per second; of an odd size the last row or column is cut). The same pictures give the same bytes. Returns
/// false, and does nothing, where ffmpeg is not installed. Throws Error for a folder without 0000.png and
/// when ffmpeg fails, with what it says; no half a file stays.
[[nodiscard]] bool joinToVideo(const std::filesystem::path& folder, const std::filesystem::path& file,
                               int rate = 30);

}  // namespace rex
