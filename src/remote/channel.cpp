#include "remote/channel.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <new>
#include <typeinfo>

#include <cxxabi.h>
#include <sys/uio.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::remote {
namespace {

constexpr std::uint32_t kMagic = 0x31786572;  // "rex1"
constexpr std::size_t kFirstBuffer = 64u << 10;

struct Header {
  std::uint32_t magic = kMagic;
  Kind kind{};
  std::uint64_t id = 0;
  std::uint32_t method = 0;
  std::uint32_t size = 0;
};
static_assert(sizeof(Header) == 24, "the header has no padding");

}  // namespace

Channel::Channel(int in, int out, Wait wait)
    : in_(in), out_(out), wait_(std::move(wait)), buffer_(kFirstBuffer) {}

void Channel::send(Kind kind, std::uint64_t id, std::uint32_t method, const Writer& body) {
  const std::span<const std::byte> bytes = body.bytes();
  if (bytes.size() > kMaxBody) throw std::length_error("more than 16 MB in one message");
  Header header{.kind = kind, .id = id, .method = method, .size = static_cast<std::uint32_t>(bytes.size())};
  std::array<iovec, 2> parts{
      {{&header, sizeof header}, {const_cast<std::byte*>(bytes.data()), bytes.size()}}};
  std::size_t left = sizeof header + bytes.size();
  while (left > 0) {
    const ssize_t written = ::writev(out_, parts.data(), parts.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      if (errno != EAGAIN || !wait_) throw Closed("nobody reads the messages");
      wait_(out_, Direction::kWrite);
      continue;
    }
    left -= static_cast<std::size_t>(written);
    std::size_t done = static_cast<std::size_t>(written);
    for (iovec& part : parts) {
      const std::size_t step = std::min(done, part.iov_len);
      part.iov_base = static_cast<std::byte*>(part.iov_base) + step;
      part.iov_len -= step;
      done -= step;
    }
  }
}

std::size_t Channel::readSome() {
  for (;;) {
    if (wait_) wait_(in_, Direction::kRead);
    const ssize_t got = ::read(in_, buffer_.data() + filled_, buffer_.size() - filled_);
    if (got > 0) return static_cast<std::size_t>(got);
    if (got == 0) throw Closed("no more messages");
    if (errno != EINTR && errno != EAGAIN) throw ProtocolError("the messages cannot be read");
  }
}

Message Channel::receive() {
  filled_ = 0;
  while (filled_ < sizeof(Header)) filled_ += readSome();
  Header header;
  std::memcpy(&header, buffer_.data(), sizeof header);
  if (header.magic != kMagic) throw ProtocolError("the message does not start with the mark of a message");
  if (header.size > kMaxBody) throw ProtocolError("the message is larger than 16 MB");
  const std::size_t total = sizeof header + header.size;
  if (buffer_.size() < total) buffer_.resize(total);
  while (filled_ < total) filled_ += readSome();
  if (filled_ > total) throw ProtocolError("there are bytes after the message");
  const std::span<const std::byte> body(buffer_.data() + sizeof header, header.size);
  return {.kind = header.kind, .id = header.id, .method = header.method, .body = Reader(body)};
}

namespace {

constexpr std::size_t kLongestText = 2000;

std::string currentTypeName() {
  const std::type_info* type = abi::__cxa_current_exception_type();
  if (type == nullptr) return "unknown type";
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> name(
      abi::__cxa_demangle(type->name(), nullptr, nullptr, &status), &std::free);
  return std::string(name ? name.get() : type->name()).substr(0, kLongestText);
}

}  // namespace

Thrown describeCurrentException() {
  const std::string type = currentTypeName();
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {.kind = Thrown::Kind::kBadAlloc, .type = type};
  } catch (const Error& error) {
    return {.kind = Thrown::Kind::kError,
            .type = type,
            .text = std::string(error.what()).substr(0, kLongestText)};
  } catch (const std::exception& error) {
    return {.kind = Thrown::Kind::kException,
            .type = type,
            .text = std::string(error.what()).substr(0, kLongestText)};
  } catch (...) {
    return {.kind = Thrown::Kind::kOther, .type = type};
  }
}

RemoteThrow::RemoteThrow(std::string function, Thrown thrown)
    : function_(std::move(function)), thrown_(std::move(thrown)) {
  text_ = "threw " + thrown_.type + " in " + function_;
  if (!thrown_.text.empty()) text_ += ": " + thrown_.text;
}

}  // namespace rex::remote
