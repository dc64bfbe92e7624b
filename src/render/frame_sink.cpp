#include "render/frame_sink.h"

#include <cassert>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "render/frame_sink_internal.h"
#include "render/image.h"

namespace rex::internal {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& cause) {
  throw Error({.what = "cannot write '" + path.string() + "'", .found = cause});
}

}  // namespace

StagedFile::StagedFile(const std::filesystem::path& path) : path_(path) {
  std::error_code problem;
  target_ = std::filesystem::absolute(path, problem);
  if (problem) fail(path_, problem.message());
  part_ = target_;
  part_ += ".part-" + std::to_string(::getpid());
  if (!std::ofstream(part_, std::ios::binary)) fail(path_, std::strerror(errno));
}

StagedFile::~StagedFile() {
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void StagedFile::commit() {
  std::error_code problem;
  std::filesystem::rename(part_, target_, problem);
  if (problem) fail(path_, problem.message());
}

void writeWhole(const std::filesystem::path& path, std::string_view bytes) {
  StagedFile staged(path);
  std::ofstream file(staged.part(), std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) fail(path, std::strerror(errno));
  staged.commit();
}

}  // namespace rex::internal

namespace rex {

FrameSink::FrameSink(std::string name) : name_(std::move(name)) {}

void FrameSink::add(const Image& frame) {
  assert(!finished_);
  const auto refuse = [&](std::string wanted) {
    throw Error({.what = fmt::format("size of frame {}", count_),
                 .where = {name_},
                 .found = fmt::format("{} x {}", frame.width, frame.height),
                 .wanted = std::move(wanted)});
  };
  if (frame.width < 1 || frame.height < 1) refuse("at least 1 x 1 pixels");
  if (count_ == 0) width_ = frame.width, height_ = frame.height;
  if (frame.width != width_ || frame.height != height_)
    refuse(fmt::format("{} x {} as before", width_, height_));
  take(frame);
  ++count_;
}

void FrameSink::finish() {
  assert(!finished_);
  if (count_ == 0) throw Error({.what = "a film without frames", .where = {name_}});
  complete();
  finished_ = true;
}

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
