#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "render/frame_sink.h"
#include "render/video_sink.h"

namespace rex {

/// A sink, or else what the machine lacks for it, in one line that names the Debian package.
struct MadeSink {
  std::unique_ptr<FrameSink> sink;
  std::string missing;
};

/// The sink for a path: a VideoSink for .mp4, .webm and .gif (or in capitals), a PngSequence into that folder
/// for a path without ending. Throws Error for another ending, and as the constructors of both.
[[nodiscard]] MadeSink makeFrameSink(const std::filesystem::path& path, const VideoOptions& options = {});

}  // namespace rex
