#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "remote/channel.h"
#include "remote/layout.h"
#include "remote/remote.h"
#include "remote/wire.h"

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

inline constexpr int kWorkerIn = 3;          ///< where a worker process reads its calls
inline constexpr int kWorkerOut = 4;         ///< where it writes its replies
inline constexpr int kProtocolFailure = 70;  ///< its exit code when it cannot talk to the trusted side

namespace detail {

/// How the worker makes an argument of type T from the bytes of a call: values are read ...
template <class T>
struct ReceivedArgument {
  static auto get(Session&, std::uint32_t, Reader& reader) {
    return Remote<T>::fromSent(Wire<typename Remote<T>::Sent>::get(reader));
  }
};

/// ... and functions call the trusted side.
template <class R, class... A>
struct ReceivedArgument<std::function<R(A...)>> {
  static std::function<R(A...)> get(Session& session, std::uint32_t number, Reader& reader) {
    if (!Wire<bool>::get(reader)) return {};
    return [&session, number, id = session.activeCall()](A... values) -> R {
      Writer writer;
      (Wire<typename Remote<std::remove_cvref_t<A>>::Sent>::put(writer, values), ...);
      Reader result = session.callBack(id, number, writer);
      if constexpr (!std::is_void_v<R>) return Wire<std::remove_cvref_t<R>>::get(result);
    };
  }
};

/// Passes a received argument on as the parameter type A: by reference, or moved into a parameter by value.
template <class A, class Received>
decltype(auto) passAs(Received& received) {
  if constexpr (std::is_same_v<std::remove_cvref_t<A>, Received>) {
    return static_cast<A&&>(received);
  } else {
    return (received);
  }
}

template <auto function, class F>
struct InvokeAs;

template <auto function, class R, class... A>
struct InvokeAs<function, R (*)(A...)> {
  using Type = R(A...);

  static void run(Session& session, Reader& arguments, Writer& result) {
    run(session, arguments, result, std::index_sequence_for<A...>{});
  }

 private:
  template <std::size_t... I>
  static void run(Session& session, Reader& reader, Writer& result, std::index_sequence<I...>) {
    // Braces evaluate from left to right, in the order in which the arguments were sent.
    std::tuple<decltype(ReceivedArgument<std::remove_cvref_t<A>>::get(session, I, reader))...> values{
        ReceivedArgument<std::remove_cvref_t<A>>::get(session, I, reader)...};
    reader.expectEnd();
    if constexpr (std::is_void_v<R>) {
      function(passAs<A>(std::get<I>(values))...);
    } else {
      Wire<std::remove_cvref_t<R>>::put(result, function(passAs<A>(std::get<I>(values))...));
    }
  }
};

}  // namespace detail

/// Reads the arguments of a function, calls it and writes its result.
template <auto function>
using Invoke = detail::InvokeAs<function, decltype(function)>;

/// Offers a function to remote callers: `method<&::ikStep>("ikStep", &Invoke<&::ikStep>::run)`.
template <auto function>
Method method(const char* name, decltype(Method::run) run = &Invoke<function>::run) {
  return {.name = name, .hash = functionHash<typename Invoke<function>::Type>(name), .run = run};
}

/// The whole main() of a worker process: serves kWorkerIn and kWorkerOut until the trusted side closes
/// them, then ends the process without running the destructors of the student's globals.
[[noreturn]] void runWorker(std::span<const Method> methods);

/// The replacements that linkWorkerParts() uses for functions that a part lacks: the student's and the
/// library's. Both throw Error.
extern "C" void rexOfAnotherPart(Session& session, Reader& arguments, Writer& result);
extern "C" void rexNotAllowedHere();

/// Its replacement for all of the student's functions in the control, a worker without a student's code: it
/// works for so many seconds of processor time.
extern "C" void rexOfControl(Session& session, Reader& arguments, Writer& result);
inline constexpr double kControlSeconds = 0.05;

}  // namespace rex::remote
