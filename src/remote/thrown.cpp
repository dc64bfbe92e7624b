#include "remote/thrown.h"

#include <cstdlib>
#include <memory>
#include <new>
#include <typeinfo>

#include <cxxabi.h>

#include "base/error.h"

namespace rex::remote {
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
