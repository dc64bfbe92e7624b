#include "remote/split_rng.h"

#include <array>
#include <string>

#include <fmt/format.h>

#include "base/sha256.h"
#include "base/text.h"

namespace rex::remote {
namespace {

Rng hashed(const Rng& from, std::uint64_t label) {
  const auto& [a, b, c, d] = from.state();
  const std::string hash = sha256(fmt::format("{} {} {} {} {}", a, b, c, d, label));
  std::array<std::uint64_t, 4> state{};
  for (std::size_t k = 0; k < 4; ++k)
    state[k] = parseNumber<std::uint64_t>(hash.substr(16 * k, 16), 16).value();
  return Rng::fromState(state);
}

}  // namespace

SplitRng::SplitRng(const Rng& from, std::uint64_t label) : Rng(hashed(from, label)) {}

}  // namespace rex::remote
