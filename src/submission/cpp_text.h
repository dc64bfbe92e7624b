#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rex::submission {

/// Whether a character may be part of a name.
[[nodiscard]] bool isWord(char c);

enum class TokenKind : std::uint8_t { kWord, kNumber, kText, kSign };

/// A piece of C++ source: a name or keyword, a number, a literal in quotes, or a single character of
/// anything else, such as one of the two in "::".
struct Token {
  TokenKind kind = TokenKind::kSign;
  bool startsLine = false;  ///< only blanks and comments are before it on its line
  std::uint32_t start = 0, end = 0;
};

/// The tokens of a C++ source without its comments; all that reads source reads it through this. Any text is
/// accepted: what is not closed ends with the text, or with its line if it is in plain quotes. Takes time and
/// memory in proportion to the text, which must outlive the object and have less than 4 GiB.
class CppText {
 public:
  explicit CppText(std::string_view source);

  [[nodiscard]] std::string_view source() const { return source_; }
  [[nodiscard]] std::size_t size() const { return tokens_.size(); }
  [[nodiscard]] const Token& operator[](std::size_t i) const { return tokens_[i]; }

  /// The text of a token; empty beyond the last one.
  [[nodiscard]] std::string_view at(std::size_t i) const;
  [[nodiscard]] bool isName(std::size_t i) const { return isKind(i, TokenKind::kWord); }
  [[nodiscard]] bool isKind(std::size_t i, TokenKind kind) const {
    return i < size() && tokens_[i].kind == kind;
  }
  [[nodiscard]] bool isSign(std::size_t i, char sign) const {
    return isKind(i, TokenKind::kSign) && source_[tokens_[i].start] == sign;
  }

  /// The bracket that closes or opens the one at `i`, brackets of other kinds ignored; size() if there is
  /// none.
  [[nodiscard]] std::size_t partner(std::size_t i) const { return partners_[i]; }

  /// The first token after the line of `i`, which a backslash at its end continues.
  [[nodiscard]] std::size_t nextLine(std::size_t i) const;
  /// Whether a preprocessor directive begins with token `i`.
  [[nodiscard]] bool startsDirective(std::size_t i) const { return isSign(i, '#') && tokens_[i].startsLine; }

 private:
  void findPartners();

  std::string_view source_;
  std::vector<Token> tokens_;
  std::vector<std::uint32_t> partners_;
};

/// Lines and columns, from 1, of positions in a text.
class TextPlaces {
 public:
  explicit TextPlaces(std::string_view text);
  [[nodiscard]] int line(std::size_t position) const;
  [[nodiscard]] std::pair<int, int> place(std::size_t position) const;

 private:
  std::vector<std::size_t> starts_;
};

/// A C++ source after joining lines that end in a backslash, and the original position of each character.
[[nodiscard]] std::pair<std::string, std::vector<std::size_t>> spliced(std::string_view source);

}  // namespace rex::submission
