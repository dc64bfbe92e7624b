#pragma once

#include <string>
#include <string_view>

#include "formats/ors_graph_internal.h"

namespace rex::ors {

/// How much was read so far, over all files of a scene, and what was strange there.
struct Budget {
  int nodes = 0;
  int words = 0;
  int directives = 0;
  Diagnostics notes{};
};

/// Whether `c` is one of the characters; never true of the '\0' that Cursor::peek() gives at the end.
[[nodiscard]] inline bool contains(std::string_view set, char c) {
  return set.find(c) != std::string_view::npos;
}

/// Reads the text of one file from left to right. Failures are Errors that name the place.
class Cursor {
 public:
  Cursor(std::string_view text, const std::string& file, Budget& budget)
      : text_(text), file_(file), budget_(budget) {}

  bool atEnd() const { return at_ >= text_.size(); }
  char peek() const { return atEnd() ? '\0' : text_[at_]; }
  char take();
  void skip(std::string_view set);
  void skipSpaceAndComments();

  Place here() const { return {&file_, line_, static_cast<int>(at_ - lineStart_) + 1}; }
  /// What stands here, short enough for a message.
  std::string found() const;

  /// Everything up to one of `terminators` or the end, at most 256 bytes of UTF-8 without control characters.
  std::string word(std::string_view terminators);
  /// The same up to `closing`, which is taken too; lines may end in it. `what` was opened at `open`.
  std::string upTo(char closing, const Place& open, const char* what);
  bool atNumber() const { return contains("+-.0123456789", peek()); }
  /// A finite number, or also inf and -inf.
  double number(const char* wanted, bool mayBeInfinite = false);

  void warn(const Place& where, std::string text) const;

  [[noreturn]] void fail(std::string what, std::string found, std::string wanted) const;
  [[noreturn]] static void failAt(const Place& where, std::string what, std::string found,
                                  std::string wanted);

 private:
  void countWord();
  std::string textUpTo(std::size_t end);
  [[noreturn]] void failAtByte() const;

  std::string_view text_;
  const std::string& file_;
  Budget& budget_;
  std::size_t at_ = 0, lineStart_ = 0;
  int line_ = 1;
};

/// [1 2 3], [1 2; 3 4], rows also by line ends, or [<2 2> 1 2 3 4] with explicit dimensions. The cursor
/// stands on the '['.
[[nodiscard]] Eigen::MatrixXd readArray(Cursor& cursor);

/// <T ...> is a pose; the text of any other type is kept as it stands. The cursor stands on the '<'.
[[nodiscard]] Value readTyped(Cursor& cursor);

}  // namespace rex::ors
