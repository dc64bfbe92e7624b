// Throws exceptions with signs that turn text round, are invisible or end lines, each between the words FROM
// and TO so that it can be found in reports.
#include <stdexcept>
#include <string>

#include "exercise.h"

namespace {
const char* const signs[] = {"\u202e",
                             "\u202d",
                             "\u202a",
                             "\u2066",
                             "\u2067",
                             "\u2068",
                             "\u061c",
                             "\u200e",
                             "\u200f",  // direction
                             "\u200b",
                             "\u200c",
                             "\u200d",
                             "\u2060",
                             "\ufeff",
                             "\u00ad",
                             "\u180e",
                             "\u034f",
                             "\u2061",  // invisible
                             "\u115f",
                             "\u1160",
                             "\u3164",
                             "\uffa0",
                             "\u2800",
                             "\u17b4",
                             "\U0001d173",
                             "\ufe0f",  // blank letters
                             "\U000e0001",
                             "\U000e0041",
                             "\U000e0100",
                             "\ufff9",
                             "\ufffa",
                             "\ufffb",
                             "\u206a",
                             "\u206f",  // tags, notes
                             "\u2028",
                             "\u2029",
                             "\xc2\x85",
                             "\xc2\x9b"
                             "31m",
                             "\xc2\x9d"
                             "0;title\x07",
                             "\xc2\x90q",  // lines, C1
                             "\x9b"
                             "31m",
                             "\xc0\xbc",
                             "\xed\xa0\x80",
                             "\xed\xae\x80",
                             "\xef\xbf\xbe",
                             "\xf4\x90\x80\x80",
                             "\xe2\x80",
                             "\x7f",
                             "\033[2J\033[31m",
                             "\033]8;;http://x\033\\link",
                             "\033]0;t\007",
                             "\b\b\b\b\b",
                             "\r",
                             "\v",
                             "\f",
                             "\x1c",
                             "\x1e",
                             "e\u0301\u0301\u0301\u0301\u0301\u0301\u0301\u0301\u0489"};
}

double twice(double) {
  std::string text;
  for (const char* sign : signs) text += std::string("FROM") + sign + "TO ";
  throw std::runtime_error(text);
}

std::vector<double> squares(int count) {
  const std::size_t number = sizeof signs / sizeof *signs;
  throw std::runtime_error(std::string(signs[static_cast<std::size_t>(count) % number]) + "10 of 10 points");
}

int main() {}
