#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rex::classroom {

/// A submission to be compared with others.
struct ComparedText {
  std::string student{};
  std::string text{};
};

/// Lines [begin, end] of both texts, from 1, that are alike.
struct SimilarRun {
  std::pair<int, int> first{}, second{};
};

/// Two submissions that share much of their text.
struct SimilarPair {
  std::string first{}, second{};
  int firstPercent = 0;   ///< how much of the first is also in the second
  int secondPercent = 0;  ///< and the other way round
  std::vector<SimilarRun> runs{};
};

/// The text with empty lines for all lines with words that the handed-out text has, too, wherever they are
/// there; line numbers are kept.
[[nodiscard]] std::string withoutHandedOut(std::string_view text, std::string_view handedOut);

/// The pairs in which the less similar side has at least that percentage, or the other one 90 %, most similar
/// first. Compares tokens: names, numbers, comments and layout do not count, nor do regions in `#if 0`, empty
/// statements, statements `(void)...;`, and runs of fewer than 24 tokens. Candidates
/// are found by winnowing (Schleimer, Wilkerson and Aiken, "Winnowing: local algorithms for document
/// fingerprinting", 2003), which misses no run of that length, and are then compared token by token. Files
/// that are empty without the handed-out text are like no other. The time grows with the sum of the lengths
/// of each pair, whatever is in them.
[[nodiscard]] std::vector<SimilarPair> similarPairs(const std::vector<ComparedText>& texts,
                                                    std::string_view handedOut, int leastPercent);

/// The students that pairs connect, each group and all groups in order.
[[nodiscard]] std::vector<std::vector<std::string>> similarGroups(const std::vector<SimilarPair>& pairs);

/// A page that shows the pairs side by side with their similar lines marked; those of the handed-out text are
/// grey. It has no scripts, and says what the comparison does not know.
[[nodiscard]] std::string similarPage(const std::string& exercise, const std::vector<ComparedText>& texts,
                                      std::string_view handedOut, const std::vector<SimilarPair>& pairs);

}  // namespace rex::classroom
