#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "render/frame_sink.h"

namespace rex {

struct VideoOptions {
  int rate = 30;          ///< frames per second, 1 to 1000
  double patience = 120;  ///< seconds that ffmpeg may take for one frame, or to finish, before it is killed
};

/// What this machine lacks for a video with the extension of `file`, in one line that names the Debian
/// package; empty if nothing is missing. Runs ffmpeg to find out. Throws Error for an extension other than
/// .mp4, .webm or .gif.
[[nodiscard]] std::string missingForVideo(const std::filesystem::path& file);

/// Writes a video through ffmpeg: .mp4 (H.264), .webm (VP9), or .gif (large, and ffmpeg holds all of it in
/// memory). With an odd size, .mp4 and .webm lose the last row or column. The same frames give the same
/// bytes. The encoder runs in a thread of its own while the next frames are drawn. The file appears whole
/// or not at all; a sink that is destroyed unfinished ends ffmpeg.
class VideoSink final : public FrameSink {
 public:
  /// Throws Error for an unknown extension, a rate out of range and a file that cannot be written. add()
  /// and finish() throw Error if ffmpeg is missing or complains, and Interrupted for a signal of
  /// HeldSignals, which also ends ffmpeg.
  explicit VideoSink(const std::filesystem::path& file, const VideoOptions& options = {});
  ~VideoSink() override;

 private:
  void take(const Image& frame) override;
  void complete() override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A sink, or, if the machine lacks something for it, one line that names the Debian package.
struct MadeSink {
  std::unique_ptr<FrameSink> sink;
  std::string missing;
};

/// The sink for a path: a VideoSink for .mp4, .webm and .gif (in upper or lower case), or a PngSequence
/// into that folder for a path without an extension. Throws Error for others, and as both constructors.
[[nodiscard]] MadeSink makeFrameSink(const std::filesystem::path& path, const VideoOptions& options = {});

}  // namespace rex
