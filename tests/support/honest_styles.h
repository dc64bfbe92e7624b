#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/text_file.h"
#include "support/paths.h"

namespace rex {

/// The files in tests/submission/honest_styles.txt with their names. Each defines int twice(int).
inline std::vector<std::pair<std::string, std::string>> honestStyles() {
  const std::string text = readTextFile(sourcePath("tests/submission/honest_styles.txt")), mark = "\n=== ";
  std::vector<std::pair<std::string, std::string>> styles;
  for (std::size_t at = text.find(mark); at != text.npos;) {
    const std::size_t name = at + mark.size(), body = text.find('\n', name) + 1,
                      next = text.find(mark, body - 1);
    std::string source = text.substr(body, next == text.npos ? next : next + 1 - body);
    if (source.find("twice(int a)") == source.npos) source.insert(0, "int twice(int a) { return 2 * a; }\n");
    styles.emplace_back(text.substr(name, body - 1 - name), std::move(source));
    at = next;
  }
  return styles;
}

/// The same lines as an editor under Windows saves them.
inline std::string inDosLines(std::string_view source) {
  std::string text;
  for (const char c : source) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return text;
}

}  // namespace rex
