#pragma once

#include <cstdint>
#include <exception>
#include <string>

namespace rex::remote {

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
