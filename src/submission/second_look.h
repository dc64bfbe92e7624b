#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "submission/toolchain.h"

namespace rex::grading {

/// Where and why a program crashed, as the sanitizers saw it.
struct CrashSite {
  std::string finding{};   ///< in plain words: "reads or writes outside of an array on the heap"
  std::string function{};  ///< the student's; empty: unknown
  int line = 0;            ///< of the student's file; 0: nothing of it was running
};

/// The first finding in what a program built by sanitizedToolchain() wrote to standard error, at the
/// innermost line of `mainFile` that was running, or where a recursion that used up the stack calls itself;
/// nothing where there is no finding.
[[nodiscard]] std::optional<CrashSite> crashSiteIn(std::string_view standardError,
                                                   const std::string& mainFile);

/// How to build the same program for the sanitizers of addresses and of undefined behaviour: it ends with a
/// report at the first finding, some twenty times slower, and ends itself when it holds more bytes of memory.
/// Writes a header into `folder`, which must exist as long as the result is used.
[[nodiscard]] Toolchain sanitizedToolchain(const Toolchain& toolchain, const std::filesystem::path& folder,
                                           std::size_t memory);

}  // namespace rex::grading
