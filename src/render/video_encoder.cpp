#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "render/video_encoder_internal.h"

namespace rex::internal {
namespace {

std::string_view bytesOf(const Image& frame) {
  return {reinterpret_cast<const char*>(frame.rgb.data()), frame.rgb.size()};
}

}  // namespace

VideoEncoder::VideoEncoder(const VideoFormat& format, const VideoOptions& options, std::filesystem::path file,
                           std::filesystem::path part)
    : format_(format), options_(options), file_(std::move(file)), part_(std::move(part)), thread_([this] {
        run();
      }) {}

VideoEncoder::~VideoEncoder() {
  {
    const std::lock_guard lock(mutex_);
    abandoned_ = true;
    if (ffmpeg_) ffmpeg_->cancel();
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void VideoEncoder::add(const Image& frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return queue_.size() < kQueue || over_; });
  if (failure_) std::rethrow_exception(failure_);
  queue_.push_back(frame);
  changed_.notify_all();
}

void VideoEncoder::finish() {
  {
    const std::lock_guard lock(mutex_);
    complete_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void VideoEncoder::run() {
  std::exception_ptr failure;
  try {
    encode();
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  failure_ = failure;
  over_ = true;
  changed_.notify_all();
}

void VideoEncoder::encode() {
  bool tookAll = true;
  while (const std::optional<Image> frame = next()) {
    if (!ffmpeg_) start(*frame);
    tookAll = ffmpeg_->write(bytesOf(*frame), ChildProcess::after(options_.patience));
    if (!tookAll) break;
  }
  if (ffmpeg_) requireSuccess(ffmpeg_->finish(ChildProcess::after(options_.patience)), tookAll);
}

// The next frame to encode; empty if all are encoded, or if nobody wants them.
std::optional<Image> VideoEncoder::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !queue_.empty() || complete_ || abandoned_; });
  if (queue_.empty() || abandoned_) return std::nullopt;
  Image frame = std::move(queue_.front());
  queue_.pop_front();
  changed_.notify_all();
  return frame;
}

void VideoEncoder::start(const Image& first) {
  auto ffmpeg =
      std::make_unique<ChildProcess>(ffmpegCommand(format_, first.width, first.height, options_.rate, part_));
  const std::lock_guard lock(mutex_);
  ffmpeg_ = std::move(ffmpeg);
  if (abandoned_) ffmpeg_->cancel();
}

void VideoEncoder::requireSuccess(const ProcessResult& result, bool tookAll) const {
  if (result.ok() && tookAll) return;
  // The lines after the first are complaints about its consequences.
  std::string cause = result.error.substr(0, result.error.find('\n'));
  if (!result.started) cause = "cannot start ffmpeg: " + cause;
  if (result.timedOut)
    cause = fmt::format("ffmpeg made no progress for {:g} s", options_.patience);
  else if (result.signal != 0)
    cause = fmt::format("ffmpeg was ended by signal {}", result.signal);
  else if (cause.empty() && result.ok())
    cause = "ffmpeg ended before the last frame";
  else if (cause.empty())
    cause = fmt::format("ffmpeg ended with exit code {}", result.exitCode);
  throw Error({.what = "cannot make the video", .where = {file_.string()}, .found = std::move(cause)});
}

}  // namespace rex::internal
