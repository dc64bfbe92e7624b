#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/join.h"
#include "base/lower_case.h"
#include "render/video_format_internal.h"

namespace rex::internal {
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

}  // namespace rex::internal
