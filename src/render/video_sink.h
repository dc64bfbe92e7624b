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

/// What this machine lacks for a video with the ending of `file`, in one line that names the Debian package;
/// empty where nothing does. Asks ffmpeg. Throws Error for an ending other than .mp4, .webm, .gif.
[[nodiscard]] std::string missingForVideo(const std::filesystem::path& file);

/// Writes a video through ffmpeg: .mp4 (H.264), .webm (VP9), or .gif (large, and ffmpeg holds all of it in
/// memory). Of an odd size .mp4 and .webm lose the last row or column. The same frames give the same bytes.
/// The encoder works on a thread of its own while the next frames are drawn. The file appears whole or not at
/// all; a sink that dies unfinished ends ffmpeg.
class VideoSink final : public FrameSink {
 public:
  /// Throws Error for an unknown ending, a rate out of range and a file that cannot be written. What ffmpeg
  /// complains about, or its absence, is thrown as Error by add() or finish(). A signal of HeldSignals ends
  /// ffmpeg and is thrown by them as Interrupted.
  explicit VideoSink(const std::filesystem::path& file, const VideoOptions& options = {});
  ~VideoSink() override;

 private:
  void take(const Image& frame) override;
  void complete() override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rex
