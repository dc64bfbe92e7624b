#pragma once

#include <map>
#include <string>
#include <vector>

#include "grading/results.h"
#include "render/figure.h"

namespace rex::cli {

/// The attempts of one student at one grading::Record.
struct Attempts {
  std::string unit{};
  bool isMoreBetter = false;
  std::vector<double> values{};  ///< in the order of the tests, without repetitions
  std::string fileSha256{};      ///< of the file that was tested last
};
/// By the name of the record.
using Records = std::map<std::string, Attempts>;

/// So many attempts at a record are kept: the last ones, and the best.
inline constexpr std::size_t kMostAttempts = 500;

/// Adds the records of a test. One that is as before, or of the same file, is no attempt: times vary.
void addRecords(Records& records, const grading::GradeResult& result);

/// The best value; there is at least one.
[[nodiscard]] double bestOf(const Attempts& attempts);

/// "length of the path: 1.62 m, your best was 1.58 m (7 attempts)".
[[nodiscard]] std::string recordText(const std::string& name, const Attempts& attempts);

/// The values over the attempts, and the best as a line.
[[nodiscard]] Figure recordFigure(const std::string& name, const Attempts& attempts);

}  // namespace rex::cli
