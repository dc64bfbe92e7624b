#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "authoring/gates.h"
#include "authoring/mutants.h"

namespace rex::authoring {

/// A line of equal_mutants.tsv: a change that no check can see.
struct EqualMutant {
  std::string before{}, after{};  ///< as in Mutant
  std::string reason{};
  int line = 0;  ///< in the file
};

/// The lines "before, after, reason" of equal_mutants.tsv, separated by tabs; lines that begin with # are
/// comments. Throws Error (file:line) for a line of another form.
[[nodiscard]] std::vector<EqualMutant> readEqualMutants(std::string_view text, const std::string& file);

/// What became of the mutants of an exercise.
struct MutantCounts {
  std::size_t possible = 0;  ///< all that mutantsOf() finds
  std::size_t made = 0;      ///< of these: those that were drawn
  std::size_t rejected = 0;  ///< that do not compile
  std::size_t killed = 0, survived = 0;
  std::map<std::string, std::size_t> equal{};  ///< listed in equal_mutants.tsv and not tried, by reason
  double seconds = 0;
  std::vector<std::string> complaints{};  ///< survivors, and lines of equal_mutants.tsv that fit no mutant
  std::vector<std::string> idleChecks{};  ///< no mutant's answers failed them
};

/// Some mutants, drawn by a fixed seed, in the order in which they were drawn.
[[nodiscard]] std::vector<Mutant> drawnMutants(std::vector<Mutant> mutants, std::size_t most);

/// Compiles 200 mutants of the exercise's solution together, and grades each of them until a check fails. A
/// mutant that crashes or runs four times as long as the solution is killed, too. Throws Error if the tools
/// fail, if the solution does not get all points, and like readEqualMutants().
[[nodiscard]] MutantCounts countMutants(const GateContext& context);

}  // namespace rex::authoring
