#pragma once

#include <filesystem>

#include "render/frame_sink.h"

namespace rex {

/// Writes folder/0000.png, 0001.png, ... Each file appears whole; an unfinished sequence stays.
class PngSequence final : public FrameSink {
 public:
  /// The first frame makes the folder if it is missing, and removes the frames of an earlier film:
  /// 0000.png, 0001.png, ... up to the first number without a file. add() throws Error naming the path.
  explicit PngSequence(const std::filesystem::path& folder);

 private:
  void take(const Image& frame) override;
  void complete() override {}

  std::filesystem::path folder_;
  int next_ = 0;
};

}  // namespace rex
