#pragma once

#include <cstdint>

namespace rex::internal {

/// What normal_kernel.cpp computes with 1, 2 or 4 lanes.
struct NormalKernel {
  static constexpr int kStreams = 4;

  /// `blocks` times eight normals, by four streams whose words stand word by word: words[word * 4 + stream].
  void (*fill)(std::uint64_t* words, double* numbers, long blocks);

  template <int kLanes>
  static NormalKernel compiled();
};

}  // namespace rex::internal
