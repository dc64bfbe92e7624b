#pragma once

#include <array>
#include <cassert>
#include <vector>

namespace rex {

/// Numbers of many configurations for kernels, in blocks of 8 configurations: [block][item][number][8], the
/// same on every machine, with each item of a block aligned to 64 bytes. The last block is padded. All
/// numbers are initially zero.
template <int kNumbers>
class LaneBlocks {
 public:
  static constexpr int kLanes = 8;

  /// Does not keep the numbers. Allocates nothing if there were at least as many before.
  void resize(int items, int count) {
    assert(items >= 0 && count >= 0);
    items_ = items;
    count_ = count;
    blocks_.resize(static_cast<std::size_t>(items) * static_cast<std::size_t>(blocks()));
  }
  int items() const { return items_; }
  int count() const { return count_; }
  int blocks() const { return (count_ + kLanes - 1) / kLanes; }

  /// The numbers of an item, kNumbers times 8; the next item follows.
  double* block(int b, int item) { return blocks_[index(b, item)].numbers.data(); }
  const double* block(int b, int item) const { return blocks_[index(b, item)].numbers.data(); }

  /// The numbers of an item at configuration k.
  std::array<double, kNumbers> at(int item, int k) const {
    assert(0 <= k && k < count_);
    const double* from = block(k / kLanes, item) + k % kLanes;
    std::array<double, kNumbers> numbers;
    for (std::size_t i = 0; i < kNumbers; ++i) numbers[i] = from[kLanes * i];
    return numbers;
  }

 private:
  struct alignas(64) Block {
    std::array<double, kNumbers * kLanes> numbers;
  };
  std::size_t index(int b, int item) const {
    assert(0 <= b && b < blocks() && 0 <= item && item < items_);
    return static_cast<std::size_t>(b) * static_cast<std::size_t>(items_) + static_cast<std::size_t>(item);
  }

  std::vector<Block> blocks_;
  int items_ = 0, count_ = 0;
};

}  // namespace rex
