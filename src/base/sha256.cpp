#include "base/sha256.h"

#include "base/error.h"
#include "base/process.h"

namespace rex {

std::string sha256(std::string_view bytes) {
  constexpr std::size_t kDigits = 64;
  const ProcessResult summed = runProcess({"sha256sum"}, {.input = std::string(bytes)});
  if (!summed.ok() || summed.output.size() < kDigits)
    throw Error({.what = "cannot run sha256sum", .found = summed.error, .wanted = "the package coreutils"});
  return summed.output.substr(0, kDigits);
}

}  // namespace rex
