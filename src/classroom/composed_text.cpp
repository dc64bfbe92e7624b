#include "classroom/composed_text.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>

#include <utf8proc.h>

#include "base/lower_case.h"

namespace rex::grading {
namespace {

// Nothing if the text is not UTF-8.
std::optional<std::string> mapped(std::string_view text, int options) {
  utf8proc_uint8_t* result = nullptr;
  const utf8proc_ssize_t size = ::utf8proc_map(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                                               static_cast<utf8proc_ssize_t>(text.size()), &result,
                                               static_cast<utf8proc_option_t>(options));
  const std::unique_ptr<utf8proc_uint8_t, void (*)(void*)> owner(result, std::free);
  if (size < 0) return {};
  return std::string(reinterpret_cast<const char*>(result), static_cast<std::size_t>(size));
}

constexpr int kComposed = UTF8PROC_STABLE | UTF8PROC_COMPOSE;

}  // namespace

std::string composed(std::string_view text) { return mapped(text, kComposed).value_or(std::string(text)); }

std::string caseless(std::string_view text) {
  // Most names, and quicker: tables compare each with each.
  if (std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
    return lowerCase(text);
  return composed(mapped(text, kComposed | UTF8PROC_CASEFOLD).value_or(std::string(text)));
}

bool isUtf8(std::string_view text) { return mapped(text, kComposed).has_value(); }

}  // namespace rex::grading
