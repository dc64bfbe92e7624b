#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "submission/build_tools.h"

namespace rex::submission {

/// Where and why a program crashed, according to the sanitizers.
struct CrashSite {
  std::string finding{};   ///< in plain words: "reads or writes outside an array on the heap"
  std::string function{};  ///< the student's function; empty: unknown
  int line = 0;            ///< in the student's file; 0: none of its code was running
  std::string sides{};     ///< of an assertion's first comparison: "2 and 3"; empty: unknown
};

/// The first finding in the error output of a program built with sanitizedToolchain(), at the innermost
/// line of `mainFile` that was running, or where a recursion that used up the stack calls itself. Empty if
/// there is no finding.
[[nodiscard]] std::optional<CrashSite> crashSiteIn(std::string_view standardError,
                                                   const std::string& mainFile);

/// A toolchain for the same program with the address and undefined behaviour sanitizers. The program is
/// about twenty times slower, ends with a report at the first finding, and also ends if it uses more than
/// `memory` bytes. Writes a header into `folder`, which must exist as long as the result is used.
[[nodiscard]] Toolchain sanitizedToolchain(const Toolchain& toolchain, const std::filesystem::path& folder,
                                           std::size_t memory);

/// A toolchain for the same program, as fast as before, which ends with such a report wherever it is after
/// so many seconds of CPU time, or where it asks for memory with more than half of `memory` in use. Writes a
/// header into `folder`, too.
[[nodiscard]] Toolchain locatingToolchain(const Toolchain& toolchain, const std::filesystem::path& folder,
                                          std::size_t memory, double seconds);

}  // namespace rex::submission
