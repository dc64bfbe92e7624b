#include "grading/output_capture.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include "base/text.h"

namespace rex::grading {
namespace {

constexpr std::size_t kHead = 64u << 10;
constexpr std::size_t kTail = 4u << 10;

// What assertions of Eigen and of the standard library mean that students' programs meet.
const char* meaningOf(const std::string& assertion) {
  constexpr std::pair<std::string_view, const char*> kMeanings[] = {
      {"aLhs.rows() == aRhs.rows()",
       "two matrices or vectors of different sizes are added, subtracted or compared"},
      {"lhs.cols() == rhs.rows()", "the sizes of a matrix product do not fit"},
      {"row >= 0 && row < rows()", "an index is outside of a matrix"},
      {"index >= 0 && index < size()", "an index is outside of a vector"},
      {"(BlockRows==1) && (BlockCols==XprType::ColsAtCompileTime)",
       "a row or column outside of a matrix is used"},
      {"startRow >= 0", "a block reaches beyond its matrix"},
      {"DenseBase::resize() does not actually allow",
       "a value of another size is assigned to a part of a matrix"},
      {"dst.rows() == src.rows()", "a value of another size is assigned to a part of a matrix"},
      {"__n < this->size()", "an index is beyond the end of a std::vector or std::array"},
      {"!this->empty()", "front(), back() or pop_back() of an empty container"},
      {"_M_is_engaged()", "the value of an empty std::optional is used"},
      {"_M_get() != nullptr", "an empty pointer is used"},
      {"get() != pointer()", "an empty pointer is used"}};
  for (const auto& [text, meaning] : kMeanings)
    if (assertion.find(text) != std::string::npos) return meaning;
  return nullptr;
}

// In "worker: src/Core/Block.h:120: Eigen::Block<...>::Block(...) [with ...]: Assertion `a' failed." only the
// part from "Assertion" on is of use.
std::string shorten(const std::string& line) {
  constexpr std::size_t kLongest = 300;
  std::size_t assertion = line.find("Assertion `");
  if (assertion == std::string::npos) assertion = line.find("Assertion '");
  if (assertion == std::string::npos)
    return line.substr(0, kLongest) + (line.size() > kLongest ? " ..." : "");
  std::string useful = line.substr(assertion, kLongest) + (line.size() - assertion > kLongest ? " ..." : "");
  if (const char* meaning = meaningOf(useful)) useful = fmt::format("{} ({})", meaning, useful);
  return useful;
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
  constexpr std::array<std::string_view, 4> kTelling = {"Assertion `", "Assertion '",
                                                        "ERROR: AddressSanitizer", "runtime error:"};
  std::string last;
  for (const std::string_view whole : splitLines(errorOutput)) {
    const std::string line(trimmed(whole));
    if (line.empty()) continue;
    // The second line that the runtime prints about an uncaught exception.
    last = line.starts_with("what():") ? last + ", " + line : line;
    const auto tells = [&](std::string_view sign) { return line.find(sign) != std::string::npos; };
    if (std::any_of(kTelling.begin(), kTelling.end(), tells)) break;
  }
  return shorten(last);
}

}  // namespace rex::grading
