#include "render/png_sequence.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "render/png.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

fs::path frameFile(const fs::path& folder, int number) { return folder / fmt::format("{:04}.png", number); }

void makeFolder(const fs::path& folder) {
  std::error_code problem, ignored;
  fs::create_directories(folder, problem);
  if (!fs::is_directory(folder, ignored))
    throw Error(
        {.what = "cannot make the folder '" + folder.string() + "' for frames", .found = problem.message()});
}

// An earlier film ended at the first gap in the numbers.
void removeFrames(const fs::path& folder) {
  int next = 0;
  while (::unlink(frameFile(folder, next).c_str()) == 0) ++next;
  if (errno != ENOENT)
    throw Error({.what = "cannot remove '" + frameFile(folder, next).string() + "' from an earlier film",
                 .found = std::strerror(errno)});
}

}  // namespace

PngSequence::PngSequence(const fs::path& folder) : FrameSink(folder.string()), folder_(folder) {}

void PngSequence::take(const Image& frame) {
  if (next_ == 0) {
    makeFolder(folder_);
    removeFrames(folder_);
  }
  writePng(frame, frameFile(folder_, next_));
  ++next_;
}

}  // namespace rex
