#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "render/frame_sink.h"
#include "render/video_sink.h"

namespace rex {

/// A sink, or, if the machine lacks something for it, one line that names the Debian package.
struct MadeSink {
  std::unique_ptr<FrameSink> sink;
  std::string missing;
};

/// The sink for a path: a VideoSink for .mp4, .webm and .gif (in upper or lower case), or a PngSequence
/// into that folder for a path without an extension. Throws Error for others, and as both constructors.
[[nodiscard]] MadeSink makeFrameSink(const std::filesystem::path& path, const VideoOptions& options = {});

}  // namespace rex
