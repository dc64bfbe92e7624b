#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/image.h"

namespace rex {

/// Receives the frames of a film, one after the other, and makes something of them. A film that finish()
/// did not complete is dropped when the sink is destroyed.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;

  /// Adds the next frame. Throws Error if it has no pixels or not the size of the first one, and if the
  /// sink cannot take it, as on a full disk; the cause may be an earlier frame.
  void add(const Image& frame);

  /// Completes the film; no frame may follow. Throws Error for a film without frames and if the sink cannot
  /// complete it.
  void finish();

 protected:
  /// `name`, such as its file, stands for the film in messages.
  explicit FrameSink(std::string name);

 private:
  virtual void take(const Image& frame) = 0;
  virtual void complete() = 0;

  std::string name_;
  int count_ = 0, width_ = 0, height_ = 0;
  bool finished_ = false;
};

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
