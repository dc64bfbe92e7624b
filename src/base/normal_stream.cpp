#include "base/normal_stream.h"

#include <algorithm>

#include "base/cpu_lanes.h"
#include "base/normal_kernel_internal.h"
#include "base/rng.h"

namespace rex {

static_assert(NormalStream::kStreams == internal::NormalKernel::kStreams);

NormalStream::NormalStream(Rng& rng) {
  for (auto& word : words_)
    for (std::uint64_t& bits : word) bits = rng.next();
}

void NormalStream::fill(std::span<double> numbers) {
  constexpr std::size_t kBlock = 2 * kStreams;
  const auto kernel = kernelFor<internal::NormalKernel>(cpuLanes());
  const std::size_t blocks = numbers.size() / kBlock, rest = numbers.size() % kBlock;
  kernel.fill(words_[0].data(), numbers.data(), static_cast<long>(blocks));
  if (rest == 0) return;
  std::array<double, kBlock> last;
  kernel.fill(words_[0].data(), last.data(), 1);
  std::copy_n(last.begin(), rest, numbers.end() - static_cast<std::ptrdiff_t>(rest));
}

}  // namespace rex
