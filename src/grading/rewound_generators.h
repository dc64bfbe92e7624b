#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rex::grading {

/// The seed of a generator that has this state after at most `draws` numbers, found by running it backwards;
/// nothing if no seed leads there.
[[nodiscard]] std::optional<std::uint64_t> seedBehind(std::array<std::uint64_t, 4> state, int draws);

/// Throws Error if a generator among the arguments of `function` gives its seed, as one would that the
/// student could rewind to the case that a check drew. `layouts` are those of the result and the arguments.
void requireNoSeedBehind(const std::string& check, const std::string& function,
                         std::span<const std::byte> arguments, const std::vector<std::string>& layouts);

}  // namespace rex::grading
