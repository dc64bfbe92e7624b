#include "remote/worker.h"

#include <algorithm>
#include <cstdio>
#include <ctime>

#include <malloc.h>
#include <unistd.h>

#include "base/error.h"
#include "remote/channel.h"
#include "remote/layout.h"
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

void runWorker(std::span<const Method> methods) {
  // By default, large vectors get fresh pages again and again, which cost more than what is computed in them.
  ::mallopt(M_MMAP_THRESHOLD, 64 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
  // Line by line, so that the last lines before a crash arrive.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  int exitCode = 0;
  try {
    Session(Channel(kWorkerIn, kWorkerOut), methods).serve();
  } catch (const ProtocolError&) {
    exitCode = kProtocolFailure;
  } catch (const Closed&) {
    exitCode = kProtocolFailure;
  }
  std::fflush(stdout);
  ::_exit(exitCode);
}

extern "C" void rexOfAnotherPart(Session&, Reader&, Writer&) {
  throw Error({.what = "a check calls a function that exercise.toml does not name for its part"});
}

extern "C" void rexOfControl(Session&, Reader&, Writer&) {
  const auto end = std::clock() + static_cast<std::clock_t>(kControlSeconds * CLOCKS_PER_SEC);
  while (std::clock() < end) {
  }
}

extern "C" void rexNotAllowedHere() {
  throw Error({.what = "calls a function of the library that this part of the exercise does not allow"});
}

}  // namespace rex::remote
