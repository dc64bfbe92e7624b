#include "render/video.h"

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "base/process.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, std::string found) {
  throw Error({.what = "cannot make the video", .where = {file.string()}, .found = std::move(found)});
}

// One thread and no version stamps: with more, the bytes depend on the machine's load.
constexpr const char* kInput = "ffmpeg -v error -xerror -nostdin -y -start_number 0 -framerate";
constexpr const char* kEncoding =
    "-i %04d.png -vf crop=trunc(iw/2)*2:trunc(ih/2)*2 -c:v libx264 -preset veryfast -crf 20 -pix_fmt yuv420p "
    "-threads 1 -fflags +bitexact -flags:v +bitexact -f mp4";

std::vector<std::string> command(int rate, const fs::path& file) {
  std::istringstream words(fmt::format("{} {} {}", kInput, rate, kEncoding));
  std::vector<std::string> all(std::istream_iterator<std::string>(words), {});
  all.push_back(file.string());
  return all;
}

}  // namespace

bool joinToVideo(const fs::path& folder, const fs::path& file, int rate) {
  constexpr double kLongest = 600;  // seconds
  if (!fs::exists(folder / "0000.png"))
    throw Error(
        {.what = "no pictures to join", .where = {folder.string()}, .wanted = "0000.png, 0001.png, ..."});
  const fs::path target = fs::absolute(file);
  fs::path unfinished = target;
  unfinished += fmt::format(".{}.part", ::getpid());
  const ProcessResult joined =
      runProcess(command(rate, unfinished), {.directory = folder, .timeout = kLongest});
  if (!joined.started) return false;
  std::error_code problem;
  const bool whole = joined.ok() && fs::file_size(unfinished, problem) > 0;
  if (whole) fs::rename(unfinished, target, problem);
  if (whole && !problem) return true;
  std::string cause = problem ? problem.message() : joined.error;
  if (joined.timedOut) cause = fmt::format("no end after {:g} s", kLongest);
  if (joined.signal != 0 && !joined.timedOut) cause = fmt::format("ffmpeg ended by signal {}", joined.signal);
  fs::remove(unfinished, problem);
  fail(file, cause);
}

}  // namespace rex
