#include "render/frame_sink.h"

#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

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

}  // namespace rex
