#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "remote/wire.h"

namespace rex::remote {

enum class Kind : std::uint32_t {
  kHello = 1,  ///< worker: ready; the id is the signature of its functions
  kCall,       ///< trusted side: run function number `method`
  kCallback,   ///< worker: the function calls its argument number `method`, a function of the trusted side
  kReply,      ///< either: the result of the call or callback with this id
  kThrew       ///< either: it ended with an exception
};

/// One message as received. `body` points into the channel's buffer and is valid until the next receive().
struct Message {
  Kind kind{};
  std::uint64_t id = 0;
  std::uint32_t method = 0;
  Reader body{{}};
};

/// The other side has closed the channel or does not read, or was given up.
class Closed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Framed messages over two file descriptors, which it does not own. At most one message is in transit:
/// bytes after a message are an error. Each message takes one system call to send, and usually one to
/// receive.
class Channel {
 public:
  enum class Direction { kRead, kWrite };
  /// Blocks until the descriptor is ready; throws to give up. Required for non-blocking descriptors.
  using Wait = std::function<void(int fd, Direction)>;

  static constexpr std::size_t kMaxBody = 16u << 20;  ///< bytes of one message

  Channel(int in, int out, Wait wait = {});

  /// Throws Closed if nobody reads, std::length_error if the body is larger than kMaxBody.
  void send(Kind kind, std::uint64_t id, std::uint32_t method, const Writer& body);

  /// Throws Closed at end of file, ProtocolError if reading fails or the bytes are not exactly one message.
  Message receive();

 private:
  std::size_t readSome();

  int in_;
  int out_;
  Wait wait_;
  std::vector<std::byte> buffer_;
  std::size_t filled_ = 0;
};

/// The parts of an exception that are sent between the sides.
struct Thrown {
  enum class Kind : std::uint8_t {
    kError,      ///< rex::Error
    kException,  ///< another std::exception
    kBadAlloc,   ///< out of memory
    kOther       ///< anything else, such as `throw 42`
  };
  Kind kind = Kind::kOther;
  std::string type{};  ///< as C++ spells it: "std::out_of_range"
  std::string text{};  ///< its what(), cut at 2000 bytes; empty if it has none
};

/// Describes the exception being handled. Call it inside a catch block.
[[nodiscard]] Thrown describeCurrentException();

/// A remote function ended with an exception.
class RemoteThrow : public std::exception {
 public:
  RemoteThrow(std::string function, Thrown thrown);
  const char* what() const noexcept override { return text_.c_str(); }
  const std::string& function() const { return function_; }
  const Thrown& thrown() const { return thrown_; }

 private:
  std::string function_;
  Thrown thrown_;
  std::string text_;
};

}  // namespace rex::remote
