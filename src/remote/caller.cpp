#include "remote/caller.h"

#include <utility>

#include "base/error.h"
#include "remote/channel.h"
#include "remote/wire.h"

namespace rex::remote {

void Caller::handshake(std::uint64_t signature) {
  const Message hello = channel_.receive();
  if (hello.kind != Kind::kHello || hello.method != 0)
    throw ProtocolError("the worker does not introduce itself");
  hello.body.expectEnd();
  if (hello.id != signature) throw ProtocolError("the worker was built from another exercise.h");
}

Reader Caller::call(std::uint32_t method, const std::string& name, const Writer& arguments,
                    const Answer& answer) {
  lastCalled_ = name;
  if (standIn_) return Reader(standIn_(method));
  const std::uint64_t id = ids_.next();
  const std::string outer = std::exchange(running_, name);
  channel_.send(Kind::kCall, id, method, arguments);
  std::exception_ptr refusal;
  for (;;) {
    Message message = channel_.receive();
    if (message.id != id) throw ProtocolError("the worker answers a call that was not made");
    if (const auto told = std::exchange(told_, {})) told(name);
    if (message.kind == Kind::kCallback) {
      answerCallback(message, answer, refusal);
      continue;
    }
    if (message.method != method) throw ProtocolError("the worker answers for another function");
    if (message.kind != Kind::kReply && message.kind != Kind::kThrew)
      throw ProtocolError("the worker sends a message of unknown kind");
    if (message.kind == Kind::kThrew && !refusal) {
      Thrown thrown = Wire<Thrown>::get(message.body);
      message.body.expectEnd();
      running_ = outer;
      if (heard_) heard_(method, name, arguments.bytes(), {});
      throw RemoteThrow(name, std::move(thrown));
    }
    running_ = outer;
    if (refusal) std::rethrow_exception(refusal);
    Reader reply = tamper_ ? Reader(tamper_(method, arguments.bytes(), message.body.bytes())) : message.body;
    if (heard_) heard_(method, name, arguments.bytes(), reply.bytes());
    return reply;
  }
}

void Caller::answerCallback(const Message& request, const Answer& answer, std::exception_ptr& refusal) {
  const std::uint32_t argument = request.method;
  Reader arguments = request.body;
  Writer result;
  Thrown thrown{.kind = Thrown::Kind::kError, .type = "rex::Error", .text = "the check has ended"};
  if (!refusal) {
    try {
      answer(argument, arguments, result);
      channel_.send(Kind::kReply, request.id, argument, result);
      return;
    } catch (const ProtocolError&) {
      throw;
    } catch (const Closed&) {
      throw;
    } catch (const Error& error) {
      thrown.text = error.what();
    } catch (...) {
      refusal = std::current_exception();
    }
  }
  Writer body;
  Wire<Thrown>::put(body, thrown);
  channel_.send(Kind::kThrew, request.id, argument, body);
}

}  // namespace rex::remote
