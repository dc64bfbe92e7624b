#include "base/lower_case.h"

#include <algorithm>

namespace rex {

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

std::string endingOf(const std::filesystem::path& file) { return lowerCase(file.extension().string()); }

}  // namespace rex
