#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "remote/channel.h"

namespace rex::remote {

class Session;

/// One function that a worker offers; made by method() in worker.h.
struct Method {
  const char* name;
  std::uint64_t hash;  ///< its functionHash()
  void (*run)(Session& session, Reader& arguments, Writer& result);
};

/// The worker's end of a channel: answers calls one after the other, and makes callbacks while one runs.
class Session {
 public:
  Session(Channel channel, std::span<const Method> methods);

  /// Introduces itself, then answers calls until the trusted side closes the channel. An exception of a
  /// function is sent, and the session continues. Throws ProtocolError for malformed messages, and Closed
  /// if the trusted side does not wait for a reply.
  void serve();

  /// The id of the running call. Throws rex::Error if there is none.
  std::uint64_t activeCall() const;

  /// Has the trusted side run the function it passed as argument number `argument` of call `id`; the result's
  /// bytes are valid until the next message. Throws rex::Error if the function failed there, or if that call
  /// is over.
  Reader callBack(std::uint64_t id, std::uint32_t argument, const Writer& arguments);

 private:
  std::optional<Message> nextRequest();
  void answer(const Message& request);

  Channel channel_;
  std::span<const Method> methods_;
  std::vector<std::uint64_t> active_;
};

}  // namespace rex::remote
