#pragma once

#include <iterator>
#include <string>
#include <string_view>

namespace rex {

/// The texts in a row, with `between` between neighbours: "a, b, c". (fmt's formatting of ranges takes
/// seconds to compile.)
template <class Texts>
[[nodiscard]] std::string join(const Texts& texts, std::string_view between) {
  std::string all;
  for (auto text = std::begin(texts); text != std::end(texts); ++text) {
    if (text != std::begin(texts)) all += between;
    all += *text;
  }
  return all;
}

}  // namespace rex
