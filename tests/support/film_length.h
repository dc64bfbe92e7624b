#pragma once

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>

#include "base/process.h"
#include "support/file_text.h"

namespace rex {

/// The number of frames of a video, and what ffprobe says of its rate: "61,30/1"; needs ffmpeg.
inline std::string framesOf(const std::filesystem::path& video) {
  const ProcessResult probe =
      runProcess({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                  "stream=avg_frame_rate,nb_read_frames", "-of", "csv=p=0", video.string()});
  std::string text = probe.output.substr(0, probe.output.find('\n'));
  const std::size_t comma = text.find(',');
  return text.substr(comma + 1) + "," + text.substr(0, comma);
}

/// How long the film of a replay page lasts, seconds: the largest number of an accessor of times in its GLB.
inline double replaySeconds(const std::filesystem::path& page) {
  const std::string text = fileText(page), mark = "id=\"film\">";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (std::size_t i = text.find(mark) + mark.size(); i < text.size() && text[i] != '<'; ++i) {
    static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = kDigits.find(text[i]);
    if (digit == std::string::npos) break;
    bits = bits << 6 | static_cast<unsigned>(digit);
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  const std::string json = bytes.substr(0, bytes.rfind("]}") + 2);
  static const std::regex kLast(R"("max":\[([0-9.eE+-]+)\])");
  double seconds = 0;
  for (std::sregex_iterator one(json.begin(), json.end(), kLast), none; one != none; ++one)
    seconds = std::max(seconds, std::stod((*one)[1]));
  return seconds;
}

}  // namespace rex
