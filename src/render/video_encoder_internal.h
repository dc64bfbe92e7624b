#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/process.h"
#include "render/image.h"
#include "render/video_format_internal.h"
#include "render/video_sink.h"

namespace rex::internal {

/// Feeds frames to an ffmpeg, on a thread of its own, with a short queue between.
class VideoEncoder {
 public:
  static constexpr std::size_t kQueue = 3;  ///< frames that may wait

  /// Encodes to `part`; messages speak of `file`.
  VideoEncoder(const VideoFormat& format, const VideoOptions& options, std::filesystem::path file,
               std::filesystem::path part);
  /// Ends ffmpeg where finish() did not.
  ~VideoEncoder();
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;

  /// Waits for room in the queue. Throws what went wrong so far: Error, or Interrupted.
  void add(const Image& frame);
  /// Waits until all is encoded; throws as add().
  void finish();

 private:
  void run();
  void encode();
  std::optional<Image> next();
  void start(const Image& first);
  void requireSuccess(const ProcessResult& result, bool tookAll) const;

  VideoFormat format_;
  VideoOptions options_;
  std::filesystem::path file_, part_;
  std::mutex mutex_;  ///< guards what follows, except the thread
  std::condition_variable changed_;
  std::deque<Image> queue_;
  bool complete_ = false;   ///< no frame will follow
  bool abandoned_ = false;  ///< nobody wants the video any more
  bool over_ = false;       ///< the thread takes no more frames
  std::exception_ptr failure_;
  std::unique_ptr<ChildProcess> ffmpeg_;
  std::thread thread_;
};

}  // namespace rex::internal
