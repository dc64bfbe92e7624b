#include "render/video_sink.h"

#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/process.h"
#include "base/text.h"
#include "render/frame_sink.h"
#include "render/frame_sink_internal.h"
#include "render/image.h"

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

namespace {

constexpr const char* kInput =
    "ffmpeg -v error -xerror -nostdin -y -filter_threads 1 -filter_complex_threads 1 "
    "-f rawvideo -pixel_format rgb24 -video_size {}x{} -framerate {} -i pipe:0 {} {} -f {}";

// Chroma is halved, so sizes are even; and the colours say how they are coded, because players guess by size.
constexpr const char* kYuv =
    "-vf crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p "
    "-colorspace bt709 -color_primaries bt709 -color_trc bt709 -color_range tv";
constexpr const char* kMp4 = "-c:v libx264 -preset veryfast -crf 20";
constexpr const char* kWebm = "-c:v libvpx-vp9 -deadline realtime -cpu-used 8 -crf 32 -b:v 0";
// One palette for the whole film, for which ffmpeg keeps the film in memory.
constexpr const char* kGif =
    "-filter_complex "
    "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=bayer:bayer_scale=4";
// With more threads the bytes would depend on the load of the machine. Version stamps are left out.
constexpr const char* kSameBytes = "-threads 1 -fflags +bitexact -flags:v +bitexact";

}  // namespace

const std::vector<VideoFormat>& videoFormats() {
  static const std::vector<VideoFormat> kFormats{
      {".mp4", "libx264", fmt::format("{} {}", kYuv, kMp4), true},
      {".webm", "libvpx-vp9", fmt::format("{} {}", kYuv, kWebm), true},
      {".gif", "gif", kGif}};
  return kFormats;
}

const VideoFormat& videoFormat(const std::filesystem::path& file, const char* others) {
  const std::string ending = endingOf(file);
  std::vector<std::string> known;
  for (const VideoFormat& format : videoFormats()) {
    if (format.ending == ending) return format;
    known.push_back(format.ending);
  }
  throw Error({.what = "unknown kind of film",
               .where = {file.string()},
               .found = "'" + file.extension().string() + "'",
               .wanted = fmt::format("{}{}", join(known, ", "), others),
               .nearest = nearestNames(ending, known)});
}

std::vector<std::string> ffmpegCommand(const VideoFormat& format, int width, int height, int rate,
                                       const std::filesystem::path& file) {
  std::istringstream words(
      fmt::format(kInput, width, height, rate, format.arguments, kSameBytes, format.ending.substr(1)));
  std::vector<std::string> command(std::istream_iterator<std::string>(words), {});
  command.push_back("file:" + file.string());  // otherwise a colon in the name would mean a protocol
  return command;
}

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

MadeSink makeFrameSink(const std::filesystem::path& path, const VideoOptions& options) {
  if (!path.has_extension()) return {std::make_unique<PngSequence>(path), {}};
  static_cast<void>(internal::videoFormat(path, ", or no ending for a folder of PNG frames"));
  if (std::string missing = missingForVideo(path); !missing.empty()) return {nullptr, std::move(missing)};
  return {std::make_unique<VideoSink>(path, options), {}};
}

}  // namespace rex
