#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
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

/// Takes the bytes of one message apart. Trusts nothing: every size is compared with the bytes that are left
/// before anything is allocated. Does not own the bytes.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size(); }

  /// Copies the next `size` bytes. Throws ProtocolError if there are fewer.
  void raw(void* to, std::size_t size) {
    if (size > bytes_.size()) throw ProtocolError("the message ends too early");
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  /// Reads the length of a list whose elements take at least one byte each. Throws ProtocolError if so many
  /// elements cannot follow.
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
  std::span<const std::byte> bytes_;
};

}  // namespace rex::remote
