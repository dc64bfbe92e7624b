#include "render/video_sink.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/process.h"
#include "render/staged_file_internal.h"
#include "render/video_encoder_internal.h"

namespace rex {

using internal::VideoFormat;

namespace {

std::string failureOf(const ProcessResult& result) {
  if (result.timedOut) return "it does not answer";
  if (result.signal != 0) return fmt::format("signal {}", result.signal);
  const std::string firstLine = result.error.substr(0, result.error.find('\n'));
  return firstLine.empty() ? fmt::format("exit code {}", result.exitCode) : firstLine;
}

}  // namespace

std::string missingForVideo(const std::filesystem::path& file) {
  const VideoFormat& format = internal::videoFormat(file);
  // Its exit code is 0 for unknown encoders too; known ones are described on standard output.
  const ProcessResult asked = runProcess({"ffmpeg", "-v", "error", "-h", "encoder=" + format.encoder});
  if (!asked.started)
    return fmt::format("{} is missing because ffmpeg is not installed (apt-get install ffmpeg)",
                       file.string());
  if (!asked.ok())
    return fmt::format("{} is missing because ffmpeg does not work: {}", file.string(), failureOf(asked));
  if (asked.output.empty())
    return fmt::format(
        "{} is missing because this ffmpeg has no encoder {} (the one from apt-get install ffmpeg has it)",
        file.string(), format.encoder);
  return {};
}

// Members are destroyed in reverse order: ffmpeg ends before its file is removed.
struct VideoSink::Impl {
  Impl(const std::filesystem::path& file, const VideoOptions& options)
      : name(file.string()),
        format(internal::videoFormat(file)),
        staged(file),
        encoder(format, options, file, staged.part()) {}

  std::string name;
  const VideoFormat& format;
  internal::StagedFile staged;
  internal::VideoEncoder encoder;
};

VideoSink::VideoSink(const std::filesystem::path& file, const VideoOptions& options)
    : FrameSink(file.string()) {
  if (options.rate < 1 || options.rate > 1000)
    throw Error({.what = "frames per second",
                 .where = {file.string()},
                 .found = fmt::format("{}", options.rate),
                 .wanted = "1 to 1000"});
  if (!(options.patience > 0) || !std::isfinite(options.patience))
    throw Error({.what = "patience with ffmpeg",
                 .where = {file.string()},
                 .found = fmt::format("{} s", options.patience),
                 .wanted = "a positive, finite number of seconds"});
  impl_ = std::make_unique<Impl>(file, options);
}

VideoSink::~VideoSink() = default;

void VideoSink::take(const Image& frame) {
  if (impl_->format.evenSize && (frame.width < 2 || frame.height < 2))
    throw Error({.what = "size of the frames of a video",
                 .where = {impl_->name},
                 .found = fmt::format("{} x {}", frame.width, frame.height),
                 .wanted = "at least 2 x 2 pixels"});
  impl_->encoder.add(frame);
}

void VideoSink::complete() {
  impl_->encoder.finish();
  impl_->staged.commit();
}

}  // namespace rex
