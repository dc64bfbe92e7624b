#include "render/png_sequence.h"

#include <algorithm>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "render/png.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

bool isFrame(const fs::path& file) {
  const std::string stem = file.stem().string();
  return file.extension() == ".png" && stem.find_first_not_of("0123456789") == std::string::npos;
}

void removeFrames(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (isFrame(entry.path())) fs::remove(entry.path());
  }
}

}  // namespace

PngSequence::PngSequence(const fs::path& folder) : FrameSink(folder.string()), folder_(folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (!fs::is_directory(folder)) {
    throw Error({.what = "cannot make the folder for frames",
                 .where = {folder.string()},
                 .found = problem.message()});
  }
  try {
    removeFrames(folder);
  } catch (const fs::filesystem_error& error) {
    throw Error({.what = "cannot remove the frames of an earlier film",
                 .where = {folder.string()},
                 .found = error.code().message()});
  }
}

void PngSequence::take(const Image& frame) { writePng(frame, folder_ / fmt::format("{:04}.png", next_++)); }

}  // namespace rex
