#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/exit_code.h"

namespace rex::cli {

struct CmaRunOptions {
  std::string function{};  ///< see testFunction()
  int dimension = 10;
  std::optional<double> deviation{};  ///< of the first samples; this, box and target: those of the function
  std::optional<double> low{}, high{};
  std::optional<double> target{};
  int lambda = 0;  ///< 0: the usual
  int restarts = 0;
  double maxEvaluations = 1e7;  ///< for each seed
  std::uint64_t seed = 0;
  int seeds = 1;
  bool json = false;
  std::filesystem::path out{};  ///< a folder for a figure; empty: none
};
/// How many evaluations CMA-ES needs for a test function. kBelow if no seed reaches the target.
ExitCode cma(const CmaRunOptions& options);

}  // namespace rex::cli
