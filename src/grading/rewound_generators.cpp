#include "grading/rewound_generators.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "base/error.h"
#include "base/rng.h"
#include "grading/answer_value.h"

namespace rex::grading {
namespace {

using GeneratorState = std::array<std::uint64_t, 4>;

// The inverse of Rng::next().
GeneratorState stateBefore(const GeneratorState& after) {
  const std::uint64_t last = std::rotr(after[3], 45);
  const std::uint64_t first = after[0] ^ last;
  const std::uint64_t mixed = after[1] ^ after[2];
  const std::uint64_t second = mixed ^ mixed << 17 ^ mixed << 34 ^ mixed << 51;
  const std::uint64_t third = after[1] ^ second;
  return {first, second, third ^ first, last ^ second};
}

// The seed whose first splitmix64 number, the first word of the state of Rng(seed), is `z`.
std::uint64_t seedOf(std::uint64_t z) {
  z = (z ^ z >> 31 ^ z >> 62) * 0x319642b2d24d8ec3u;
  z = (z ^ z >> 27 ^ z >> 54) * 0x96de1b173f119089u;
  return (z ^ z >> 30 ^ z >> 60) - 0x9e3779b97f4a7c15u;
}

}  // namespace

std::optional<std::uint64_t> seedBehind(GeneratorState state, int draws) {
  for (int k = 0; k <= draws; ++k) {
    const std::uint64_t seed = seedOf(state[0]);
    if (Rng(seed).state() == state) return seed;
    state = stateBefore(state);
  }
  return {};
}

void requireNoSeedBehind(const std::string& check, const std::string& function,
                         std::span<const std::byte> arguments, const std::vector<std::string>& layouts) {
  constexpr int kDraws = 20000;  // a tour of 18-gridSLAM took 10976
  if (std::ranges::find(layouts, "r") == layouts.end()) return;
  for (std::size_t k = 1; k < layouts.size(); ++k) {
    const std::size_t size = sizeOfValue(arguments, layouts[k]);
    if (layouts[k] == "r") {
      GeneratorState state{};
      std::memcpy(state.data(), arguments.data(), sizeof state);
      if (seedBehind(state, kDraws))
        throw Error({.what = fmt::format("{}: the generator handed to {} gives the seed of the case when run "
                                         "backwards",
                                         check, function)});
    }
    arguments = arguments.subspan(size);
  }
}

}  // namespace rex::grading
