#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rex::grading {

/// What a course makes of a result: whose it is, what people changed, what lateness costs. Points in
/// hundredths. No part of it is in results.json.
struct Judgement {
  std::string student{};               ///< the name, for people
  std::vector<std::string> changes{};  ///< a sentence for each adjustment by a person
  std::string lateness{};              ///< a sentence; empty: in time
  std::int64_t penalty = 0;            ///< for lateness
  std::int64_t final = 0;
  std::int64_t possible = 0;
};

/// "7.5": a number of hundredths, as short as possible.
[[nodiscard]] std::string hundredthsText(std::int64_t value);

/// The sentences of a judgement, the last of which gives the final points.
[[nodiscard]] std::vector<std::string> sentencesOf(const Judgement& judgement);

}  // namespace rex::grading
