#pragma once

#include <string>

#include "render/image.h"

namespace rex {

/// Takes the frames of a film, one after the other, and makes something of them. What finish() did not
/// complete is dropped when the sink dies.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;

  /// The next frame. Throws Error for one without pixels or of another size than the first, and when the sink
  /// cannot take it, such as on a full disk; the reason may lie in an earlier frame.
  void add(const Image& frame);

  /// Completes the film; no frame may follow. Throws Error for a film without frames and when the sink cannot
  /// complete it.
  void finish();

 protected:
  /// `name` stands for the film in messages, such as its file.
  explicit FrameSink(std::string name);

 private:
  virtual void take(const Image& frame) = 0;
  virtual void complete() = 0;

  std::string name_;
  int count_ = 0, width_ = 0, height_ = 0;
  bool finished_ = false;
};

}  // namespace rex
