#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "remote/caller.h"
#include "remote/remote.h"
#include "remote/wire.h"

namespace rex::remote {

namespace detail {

/// How the trusted side treats an argument of type T: values travel with the call ...
template <class T>
struct SentArgument {
  using Type = typename Remote<T>::Sent;
  static void put(Writer& writer, const Type& value) { Wire<Type>::put(writer, value); }
  static void answer(const Type&, Reader&, Writer&) {
    throw ProtocolError("that argument is not a function");
  }
};

/// ... and functions stay here: only whether there is one is sent.
template <class R, class... A>
struct SentArgument<std::function<R(A...)>> {
  using Type = std::function<R(A...)>;
  static void put(Writer& writer, const Type& function) { Wire<bool>::put(writer, function != nullptr); }
  static void answer(const Type& function, Reader& reader, Writer& result) {
    if (!function) throw ProtocolError("that argument is an empty function");
    std::tuple<typename Remote<std::remove_cvref_t<A>>::Sent...> values{
        Wire<typename Remote<std::remove_cvref_t<A>>::Sent>::get(reader)...};
    reader.expectEnd();
    if constexpr (std::is_void_v<R>) {
      std::apply(function, values);
    } else {
      Wire<std::remove_cvref_t<R>>::put(result, std::apply(function, values));
    }
  }
};

template <class... S, std::size_t... I>
void answerArgument(std::uint32_t number, const std::tuple<const typename S::Type&...>& values,
                    Reader& reader, Writer& result, std::type_identity<std::tuple<S...>>,
                    std::index_sequence<I...>) {
  const bool found = ((number == I ? (S::answer(std::get<I>(values), reader, result), true) : false) || ...);
  if (!found) throw ProtocolError("there is no such argument");
}

}  // namespace detail

/// A function of the worker, called as if it were local: `Call<decltype(::ikStep)> ikStep(caller, 0,
/// "ikStep")`. Throws like Caller::call(), and AnswerRefused for an answer that is not finite or too large,
/// before anything computes with it.
template <class F>
class Call;

template <class R, class... A>
class Call<R(A...)> {
  template <class T>
  using Sent = detail::SentArgument<std::remove_cvref_t<T>>;

 public:
  Call(Caller& caller, std::uint32_t method, std::string name)
      : caller_(&caller), method_(method), name_(std::move(name)) {}

  /// The same function, with infinite numbers allowed in its answer.
  Call orInfinite() const {
    Call copy = *this;
    copy.limits_.infinite = true;
    return copy;
  }
  /// The same function, with all numbers allowed: for checks that examine and show numbers that are not
  /// finite.
  Call asItIs() const {
    Call copy = *this;
    copy.limits_.any = true;
    return copy;
  }

  R operator()(const typename Sent<A>::Type&... arguments) const {
    Writer writer;
    (Sent<A>::put(writer, arguments), ...);
    const std::tuple<const typename Sent<A>::Type&...> values(arguments...);
    const auto answer = [&values](std::uint32_t number, Reader& reader, Writer& result) {
      detail::answerArgument(number, values, reader, result, std::type_identity<std::tuple<Sent<A>...>>{},
                             std::index_sequence_for<A...>{});
    };
    Reader reply = caller_->call(method_, name_, writer, answer);
    reply.limitTo(limits_, name_);
    if constexpr (std::is_void_v<R>) {
      reply.expectEnd();
    } else {
      std::remove_cvref_t<R> result = Wire<std::remove_cvref_t<R>>::get(reply);
      reply.expectEnd();
      return result;
    }
  }

 private:
  Caller* caller_;
  std::uint32_t method_;
  std::string name_;
  AnswerLimits limits_{};
};

}  // namespace rex::remote
