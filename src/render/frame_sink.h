#pragma once

#include <string>

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

}  // namespace rex
