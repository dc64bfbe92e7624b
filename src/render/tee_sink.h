#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "render/frame_sink.h"

namespace rex {

/// Passes each frame to several sinks, in order. The first one that throws ends the film for all.
class TeeSink final : public FrameSink {
 public:
  explicit TeeSink(std::vector<std::unique_ptr<FrameSink>> sinks)
      : FrameSink("frames for several"), sinks_(std::move(sinks)) {}

 private:
  void take(const Image& frame) override {
    for (const auto& sink : sinks_) sink->add(frame);
  }
  void complete() override {
    for (const auto& sink : sinks_) sink->finish();
  }

  std::vector<std::unique_ptr<FrameSink>> sinks_;
};

}  // namespace rex
