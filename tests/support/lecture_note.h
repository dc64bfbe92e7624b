#pragma once

#include <cctype>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "support/file_text.h"
#include "support/paths.h"

namespace rex {

/// The lecturer's notes on an exercise, in one line: text is found wherever it was broken.
inline std::string lectureNote(const std::string& exercise) {
  std::string line;
  for (const char c : fileText(homeFolder() / "notes" / (exercise + ".md"))) {
    const char letter = std::isspace(static_cast<unsigned char>(c)) ? ' ' : c;
    if (letter != ' ' || (!line.empty() && line.back() != ' ')) line += letter;
  }
  return line;
}

/// Fails unless the notes on an exercise hold these words.
inline void expectStated(const std::string& exercise, const std::string& words) {
  EXPECT_NE(lectureNote(exercise).find(words), std::string::npos)
      << "notes/" << exercise << ".md does not say: " << words;
}

}  // namespace rex
