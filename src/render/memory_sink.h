#pragma once

#include <vector>

#include "render/frame_sink.h"

namespace rex {

/// Keeps all frames.
class MemorySink final : public FrameSink {
 public:
  MemorySink() : FrameSink("frames in memory") {}
  /// The frames so far, in order.
  const std::vector<Image>& frames() const { return frames_; }

 private:
  void take(const Image& frame) override { frames_.push_back(frame); }
  void complete() override {}

  std::vector<Image> frames_;
};

}  // namespace rex
