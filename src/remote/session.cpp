#include "remote/session.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "remote/signature.h"
#include "remote/thrown.h"
#include "remote/wire.h"

namespace rex::remote {

Session::Session(Channel channel, std::span<const Method> methods)
    : channel_(std::move(channel)), methods_(methods) {}

void Session::serve() {
  std::uint64_t signature = kEmptySignature;
  for (const Method& method : methods_) signature = combineHashes(signature, method.hash);
  channel_.send(Kind::kHello, signature, 0, Writer());
  while (const std::optional<Message> request = nextRequest()) {
    if (request->kind != Kind::kCall) throw ProtocolError("wanted a call");
    answer(*request);
  }
}

std::optional<Message> Session::nextRequest() {
  try {
    return channel_.receive();
  } catch (const Closed&) {
    return std::nullopt;
  }
}

void Session::answer(const Message& request) {
  if (request.method >= methods_.size()) throw ProtocolError("there is no such function");
  Writer result;
  Kind kind = Kind::kReply;
  active_.push_back(request.id);
  try {
    Reader arguments = request.body;
    methods_[request.method].run(*this, arguments, result);
    if (result.bytes().size() > Channel::kMaxBody)
      throw Error({.what = "the result", .found = "more than 16 MB", .wanted = "at most 16 MB"});
  } catch (const ProtocolError&) {
    throw;
  } catch (const Closed&) {
    throw;
  } catch (...) {
    kind = Kind::kThrew;
    result = Writer();
    Wire<Thrown>::put(result, describeCurrentException());
  }
  active_.pop_back();
  // What the function printed must not be lost if a later one crashes.
  std::fflush(stdout);
  channel_.send(kind, request.id, request.method, result);
}

std::uint64_t Session::activeCall() const {
  if (active_.empty()) throw Error({.what = "no call is running"});
  return active_.back();
}

Reader Session::callBack(std::uint64_t id, std::uint32_t argument, const Writer& arguments) {
  if (std::find(active_.begin(), active_.end(), id) == active_.end())
    throw Error({.what = "a function argument was used after the call it belongs to"});
  channel_.send(Kind::kCallback, id, argument, arguments);
  for (;;) {
    Message message = channel_.receive();
    if (message.kind == Kind::kCall) {
      answer(message);
      continue;
    }
    if (message.id != id || message.method != argument)
      throw ProtocolError("wanted the answer to a callback");
    if (message.kind == Kind::kReply) return message.body;
    if (message.kind != Kind::kThrew) throw ProtocolError("wanted the answer to a callback");
    throw Error({.what = Wire<Thrown>::get(message.body).text});
  }
}

}  // namespace rex::remote
