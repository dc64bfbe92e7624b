#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace rex::submission {

inline constexpr std::size_t kLargest = 1u << 20;  // of a student's file

inline std::string repeated(const std::string& piece, std::size_t size) {
  std::string text;
  text.reserve(size);
  while (text.size() + piece.size() <= size) text += piece;
  return text;
}

// Pieces with a number in each.
inline std::string numbered(const std::string& before, const std::string& after, std::size_t size) {
  std::string text;
  for (int k = 0; text.size() + before.size() + after.size() + 10 < size; ++k)
    text += before + std::to_string(k) + after;
  return text;
}

inline std::string inside(const std::string& before, const std::string& piece, const std::string& after,
                          std::size_t size) {
  return before + repeated(piece, size - before.size() - after.size()) + after;
}

// Each function calls the next, and the last is the one that is graded or the first that failed.
inline std::string chain(bool isReversed, std::size_t size) {
  std::vector<std::string> functions;
  for (int k = 0; k < static_cast<int>(size / 42); ++k)
    functions.push_back("int f" + std::to_string(k) + "() { return f" + std::to_string(k + 1) + "(); }\n");
  std::string text;
  for (std::size_t k = 0; k < functions.size(); ++k)
    text += functions[isReversed ? functions.size() - 1 - k : k];
  return text;
}

/// Files up to the size limit that are made to be slow, by name: at least ten for each reader.
inline std::map<std::string, std::string> slowSources(std::size_t size = kLargest) {
  return {{"openings of comments", repeated("/*\n", size)},
          {"signs before openings of comments", repeated("#/*\n", size)},
          {"a chain of comments behind each sign", repeated("#/*\n#/**/", size)},
          {"ends of comments", repeated("*/#", size)},
          {"one long comment", inside("/*", "* /", "*/", size)},
          {"digits", repeated("7", size)},
          {"a quotient of long numbers", inside("x = 1", "0", " / 7;", size)},
          {"quotients", repeated("1/7,", size)},
          {"double quotes", repeated("\"", size)},
          {"single quotes", repeated("'", size)},
          {"quotes and backslashes", repeated("\"\\", size)},
          {"raw strings that are open", repeated("R\"(", size)},
          {"marks of raw strings", inside("R\"", ")", "(", size)},
          {"raw strings that nearly end", inside("R\"aaaaaaaaaaaaaaaa(", ")aaaaaaaaaaaaaaaa", "", size)},
          {"line markers", repeated("#1\n", size)},
          {"pragmas", repeated("system_header", size)},
          {"backslashes", repeated("\\", size)},
          {"backslashes and blanks", repeated("\\ ", size)},
          {"spliced lines", repeated("\\\n", size)},
          {"comments of spliced lines", repeated("//\\\n", size)},
          {"opening parentheses", repeated("(", size)},
          {"calls in calls", repeated("f(", size)},
          {"calls", repeated("f()", size)},
          {"closing parentheses", repeated(")", size)},
          {"braces", repeated("{}", size)},
          {"opening braces", repeated("{", size)},
          {"heads of main", repeated("main ", size)},
          {"mains", repeated("main(){f;", size)},
          {"auto lines", repeated("auto a = f(b).head(2);\n", size)},
          {"a long auto line", inside("auto a = ", "f(b).head(2)+", "c;\n", size)},
          {"nested views", inside("auto a = ", "(", "b", size / 3) + repeated(").head(2)", size / 2) + ";\n"},
          {"auto and blanks", inside("auto", " ", "\nauto a", size)},
          {"a long name", repeated("a", size)},
          {"long lines of names", repeated("a ", size)},
          {"definitions of macros", repeated("#define a\n", size)},
          {"words of a macro", repeated("define ", size)},
          {"includes", repeated("#include <cmath>\n", size)},
          {"functions", numbered("int f", "() { return 1; }\n", size)},
          {"a chain of functions", chain(false, size)},
          {"a chain of functions from its end", chain(true, size)},
          {"unnamed namespaces", repeated("namespace{", size)},
          {"semicolons", repeated(";", size)},
          {"line ends", repeated("\n", size)},
          {"blanks", repeated(" ", size)},
          {"bytes of no encoding", repeated("\xff", size)}};
}

}  // namespace rex::submission
