#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/rng.h"
#include "remote/channel.h"

namespace rex::remote {

/// The trusted end of a channel: sends calls and answers the callbacks that arrive before their replies.
class Caller {
 public:
  /// Message ids are drawn with `idSeed`, which the other side should not be able to guess.
  Caller(Channel channel, std::uint64_t idSeed) : channel_(std::move(channel)), ids_(idSeed) {}

  using Bytes = std::span<const std::byte>;

  /// Answers calls without a worker and without callbacks. For testing what checks do with the answers.
  using StandIn = std::function<Bytes(std::uint32_t method)>;
  explicit Caller(StandIn standIn) : channel_(-1, -1), ids_(0), standIn_(std::move(standIn)) {}

  /// Waits until the worker is ready. Throws ProtocolError unless it serves exactly the functions of
  /// `signature`.
  void handshake(std::uint64_t signature);

  /// Answers callback number `argument`: reads its arguments, writes its result.
  using Answer = std::function<void(std::uint32_t argument, Reader& arguments, Writer& result)>;

  /// Runs a function of the worker and returns the bytes of its result, valid until the next call. Throws
  /// RemoteThrow if the function threw, ProtocolError or Closed if the worker misbehaves. A rex::Error
  /// thrown by `answer` is passed on to the remote function; any other exception ends the remote function
  /// and is rethrown here.
  [[nodiscard]] Reader call(std::uint32_t method, const std::string& name, const Writer& arguments,
                            const Answer& answer);

  /// The function that is running, or was running when the worker failed; empty between calls.
  const std::string& running() const { return running_; }

  /// The function that was called last; empty before the first call.
  const std::string& lastCalled() const { return lastCalled_; }

  /// Replaces each result by what `tamper` returns, which must be valid until the next call.
  using Tamper = std::function<Bytes(std::uint32_t method, Bytes arguments, Bytes result)>;
  void tamperWithResults(Tamper tamper) { tamper_ = std::move(tamper); }

  /// Calls `told` with the name of the running function before the first value from the worker is read, be
  /// it a result or an argument of a callback.
  void whenFirstAnswered(std::function<void(const std::string&)> told) { told_ = std::move(told); }

  /// Calls `heard` after each call with its arguments and the answer, or without an answer
  /// if the function threw. The bytes are valid until it returns.
  using Heard = std::function<void(std::uint32_t method, const std::string& name, Bytes arguments,
                                   const std::optional<Bytes>& answer)>;
  void listen(Heard heard) { heard_ = std::move(heard); }

 private:
  void answerCallback(const Message& request, const Answer& answer, std::exception_ptr& refusal);

  Channel channel_;
  Rng ids_;
  std::string running_, lastCalled_;
  StandIn standIn_{};
  Tamper tamper_{};
  std::function<void(const std::string&)> told_{};
  Heard heard_{};
};

}  // namespace rex::remote
