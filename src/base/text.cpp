#include "base/text.h"

#include <algorithm>

namespace rex {

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

std::string endingOf(const std::filesystem::path& file) { return lowerCase(file.extension().string()); }

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return text.substr(text.size());
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return text.substr(text.starts_with(kMark) ? kMark.size() : 0);
}

std::vector<std::string_view> splitAt(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<std::string_view> splitWords(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(kBlanks, at)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

std::vector<std::string_view> splitList(std::string_view text) {
  std::vector<std::string_view> all;
  const std::vector<std::string_view> fields = splitAt(text, ',');
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const std::vector<std::string_view> words = splitWords(fields[k]);
    if (words.empty() && k + 1 < fields.size()) all.push_back(trimmed(fields[k]));
    all.insert(all.end(), words.begin(), words.end());
  }
  return all;
}

bool isNumeral(std::string_view text) {
  double number = 0;
  const char* const last = text.data() + text.size();
  const auto [end, problem] = std::from_chars(text.data(), last, number);
  return end == last && problem != std::errc::invalid_argument;
}

std::string bytesOfHex(std::string_view digits) {
  std::string bytes;
  for (std::size_t k = 0; k + 1 < digits.size(); k += 2)
    bytes += static_cast<char>(parseNumber<unsigned>(digits.substr(k, 2), 16).value_or(0));
  return bytes;
}

}  // namespace rex
