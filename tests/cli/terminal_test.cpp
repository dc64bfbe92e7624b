#include "cli/terminal.h"

#include <gtest/gtest.h>

namespace rex::cli::terminal_test {

TEST(Wrap, BreaksAtBlanksWithinEightyColumns) {
  const std::string word(30, 'x');
  EXPECT_EQ(wrap(word + " " + word + " " + word, 4, 0), word + " " + word + "\n    " + word);
  EXPECT_EQ(wrap(word + " " + word, 4, 60), word.substr(0, 0) + word + "\n    " + word);
  EXPECT_EQ(wrap("a\nb  c", 2, 0), "a\n  b c");
  EXPECT_EQ(wrap("1 day\na b", 2, 0), "1 day\n  a b") << "a first word that is shorter than the indent";
  EXPECT_EQ(wrap(std::string(200, 'x'), 2, 0), std::string(200, 'x'));
  EXPECT_EQ(wrap("", 2, 0), "");
}

TEST(Wrap, CountsLettersNotBytes) {
  std::string letters;
  for (int k = 0; k < 39; ++k) letters += "\u00e4";
  EXPECT_EQ(wrap(letters + " " + letters, 2, 0), letters + " " + letters);
}

TEST(Bar, IsNeitherEmptyNorFullUnlessTheWholeIs) {
  const std::string empty(20, '.'), full(20, '#');
  EXPECT_EQ(bar(0, 7), empty);
  EXPECT_EQ(bar(7, 7), full);
  EXPECT_EQ(bar(5, 10), std::string(10, '#') + std::string(10, '.'));
  EXPECT_EQ(bar(1, 1000), "#" + std::string(19, '.'));
  EXPECT_EQ(bar(999, 1000), std::string(19, '#') + ".");
  for (const auto& [part, whole] : {std::pair{-3, 7}, {0, 0}, {3, 0}}) EXPECT_EQ(bar(part, whole), empty);
  EXPECT_EQ(bar(9, 7), full);
}

TEST(Paint, LeavesTextPlainOffATerminal) { EXPECT_EQ(paint(Colour::kRed, "text"), "text"); }

TEST(Harmless, LetsNoEscapeSequenceThrough) {
  EXPECT_EQ(escapeForTerminal("a\tb"), "a\tb");
  EXPECT_EQ(escapeForTerminal("\033[2J").find('\033'), std::string::npos);
}

}  // namespace rex::cli::terminal_test
