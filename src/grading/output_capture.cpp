#include "grading/output_capture.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <sstream>
#include <string_view>

#include <unistd.h>

namespace rex::grading {
namespace {

constexpr std::size_t kHead = 64u << 10;
constexpr std::size_t kTail = 4u << 10;

// In "worker: src/Core/Block.h:120: Eigen::Block<...>::Block(...) [with ...]: Assertion `a' failed." only the
// part from "Assertion" on is of use.
std::string shorten(const std::string& line) {
  constexpr std::size_t kLongest = 300;
  const std::size_t assertion = line.find("Assertion `");
  const std::string useful = assertion == std::string::npos ? line : line.substr(assertion);
  return useful.size() <= kLongest ? useful : useful.substr(0, kLongest) + " ...";
}

std::string trimmed(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

OutputCapture::~OutputCapture() {
  if (fd_ >= 0) ::close(fd_);
}

void OutputCapture::drain() {
  std::array<char, 64u << 10> buffer;
  for (int round = 0; round < 4 && fd_ >= 0; ++round) {
    const ssize_t got = ::read(fd_, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) return;
    if (got <= 0) {
      ::close(fd_);
      fd_ = -1;
      return;
    }
    const std::string_view bytes(buffer.data(), static_cast<std::size_t>(got));
    total_ += bytes.size();
    head_ += bytes.substr(0, kHead - head_.size());
    tail_ += bytes.substr(bytes.size() - std::min(bytes.size(), kTail));
    if (tail_.size() > kTail) tail_.erase(0, tail_.size() - kTail);
  }
}

std::string tellingLine(const std::string& errorOutput) {
  constexpr std::array<std::string_view, 3> kTelling = {"Assertion `", "ERROR: AddressSanitizer",
                                                        "runtime error:"};
  std::string last;
  std::istringstream lines(errorOutput);
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line);
    if (line.empty()) continue;
    // The second line that the runtime prints about an uncaught exception.
    last = line.starts_with("what():") ? last + ", " + line : line;
    const auto tells = [&](std::string_view sign) { return line.find(sign) != std::string::npos; };
    if (std::any_of(kTelling.begin(), kTelling.end(), tells)) break;
  }
  return shorten(last);
}

}  // namespace rex::grading
