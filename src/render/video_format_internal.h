#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rex::internal {

/// A kind of video file and how ffmpeg makes it.
struct VideoFormat {
  std::string ending;     ///< ".mp4"
  std::string encoder;    ///< ffmpeg's name of it
  std::string arguments;  ///< of ffmpeg between input and output, separated by blanks
  bool evenSize = false;  ///< of an odd size the last row or column is cut
};

/// All formats, the usual one first.
[[nodiscard]] const std::vector<VideoFormat>& videoFormats();

/// The format for the ending of `file`, capitals or not. Throws Error naming the choices for another ending;
/// `others` lists what else would do.
[[nodiscard]] const VideoFormat& videoFormat(const std::filesystem::path& file, const char* others = "");

/// The command that reads width x height RGB frames, `rate` per second, on standard input and writes `file`
/// (absolute), whatever its ending.
[[nodiscard]] std::vector<std::string> ffmpegCommand(const VideoFormat& format, int width, int height,
                                                     int rate, const std::filesystem::path& file);

}  // namespace rex::internal
