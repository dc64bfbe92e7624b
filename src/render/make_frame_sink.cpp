#include "render/make_frame_sink.h"

#include "render/png_sequence.h"
#include "render/video_format_internal.h"

namespace rex {

MadeSink makeFrameSink(const std::filesystem::path& path, const VideoOptions& options) {
  if (!path.has_extension()) return {std::make_unique<PngSequence>(path), {}};
  static_cast<void>(internal::videoFormat(path, ", or no ending for a folder of PNG frames"));
  if (std::string missing = missingForVideo(path); !missing.empty()) return {nullptr, std::move(missing)};
  return {std::make_unique<VideoSink>(path, options), {}};
}

}  // namespace rex
