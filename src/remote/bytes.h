#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rex::remote {

/// The other side sent something that no correct peer would send.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Collects the bytes of one message, in the machine's own byte order: both sides run on one machine.
class Writer {
 public:
  void raw(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Limits that the numbers in an answer of a student's function must keep before anything computes with
/// them.
struct AnswerLimits {
  bool any = false;          ///< all numbers are allowed
  bool infinite = false;     ///< infinite numbers are allowed
  double magnitude = 1e100;  ///< limit for finite numbers: their squares and cubes are finite, too
};

/// A student's function returned numbers outside the limits.
class AnswerRefused : public std::exception {
 public:
  AnswerRefused(std::string function, std::string why)
      : function_(std::move(function)), why_(std::move(why)) {}
  const char* what() const noexcept override { return why_.c_str(); }
  const std::string& function() const { return function_; }

 private:
  std::string function_, why_;
};

/// Parses the bytes of one message. Trusts nothing: every size is compared with the remaining bytes before
/// anything is allocated. Does not own the bytes.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size(); }
  std::span<const std::byte> bytes() const { return bytes_; }

  /// From now on numbers() throws AnswerRefused naming `function` for numbers outside the limits. Both
  /// arguments must outlive the reader.
  void limitTo(const AnswerLimits& limits, const std::string& function) {
    limits_ = &limits;
    function_ = &function;
  }

  /// Called with all numbers that are read; checks them if there are limits.
  void numbers(const double* first, std::size_t count) {
    if (limits_ != nullptr) examine(first, count);
  }

  /// Copies the next `size` bytes. Throws ProtocolError if there are fewer.
  void raw(void* to, std::size_t size) {
    if (size > bytes_.size()) throw ProtocolError("the message ends too early");
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  /// Reads the length of a list whose elements take at least one byte each. Throws ProtocolError if it
  /// exceeds the remaining bytes.
  std::size_t count() {
    std::uint64_t n = 0;
    raw(&n, sizeof n);
    if (n > bytes_.size()) throw ProtocolError("a list is longer than its message");
    return n;
  }

  /// Throws ProtocolError if bytes are left over.
  void expectEnd() const {
    if (!bytes_.empty()) throw ProtocolError("the message is longer than its content");
  }

 private:
  void examine(const double* first, std::size_t count);

  std::span<const std::byte> bytes_;
  const AnswerLimits* limits_ = nullptr;
  const std::string* function_ = nullptr;
  std::size_t examined_ = 0;
};

}  // namespace rex::remote
