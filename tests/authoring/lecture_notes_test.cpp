// The lecturer's notes (notes/) answer every question that the exercises ask to discuss, and quote it as it
// stands there. What they say in numbers and formulas is tested in tests/course/.
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text.h"
#include "base/text_file.h"
#include "submission/exercise_info.h"
#include "support/paths.h"

namespace rex::authoring::lecture_notes_test {

namespace fs = std::filesystem;
using ::testing::Contains;

// The items of the list below "Discuss in the tutorial", each in one line.
std::vector<std::string> questionsOf(std::string_view readme) {
  std::vector<std::string> questions;
  bool isOpen = false;
  for (const std::string_view line : splitLines(readme)) {
    if (line.starts_with('#')) isOpen = line == "## Discuss in the tutorial";
    if (!isOpen) continue;
    if (line.starts_with("- ")) questions.emplace_back(line.substr(2));
    if (line.starts_with("  ") && !questions.empty()) questions.back() += line.substr(1);
  }
  return questions;
}

struct Answer {
  std::string question;
  std::size_t letters = 0;
};

// The quotations of notes, each in one line, and the length of what follows each.
std::vector<Answer> answersIn(std::string_view notes) {
  std::vector<Answer> answers;
  bool isQuoting = false;
  for (const std::string_view line : splitLines(notes)) {
    const bool isQuote = line.starts_with("> ");
    if (isQuote && isQuoting)
      answers.back().question += line.substr(1);
    else if (isQuote)
      answers.push_back({.question = std::string(line.substr(2))});
    else if (!answers.empty() && !line.starts_with('#'))
      answers.back().letters += line.size();
    isQuoting = isQuote;
  }
  return answers;
}

TEST(LectureNotes, AnswerEveryQuestion) {
  const fs::path root = homeFolder();
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(root / "exercises")) {
    if (!fs::exists(entry.path() / "exercise.toml") || submission::readExerciseInfo(entry.path()).isPrivate)
      continue;
    const std::string name = entry.path().filename().string();
    const std::vector<std::string> questions = questionsOf(readTextFile(entry.path() / "README.md"));
    EXPECT_FALSE(questions.empty()) << name;
    std::vector<std::string> quoted;
    for (const Answer& answer : answersIn(readTextFile(root / "notes" / (name + ".md")))) {
      EXPECT_GT(answer.letters, 150u) << name << ": " << answer.question;
      // What only the script asks begins with its number.
      const bool isOfTheScript = answer.question.starts_with("12.");
      EXPECT_TRUE(isOfTheScript || ::testing::Value(questions, Contains(answer.question)))
          << name << " does not ask: " << answer.question;
      quoted.push_back(answer.question);
    }
    for (const std::string& question : questions)
      EXPECT_THAT(quoted, Contains(question)) << "notes/" << name << ".md does not answer it";
    EXPECT_EQ(std::set(quoted.begin(), quoted.end()).size(), quoted.size()) << name;
    count += questions.size();
  }
  EXPECT_GT(count, 100u);
}

TEST(LectureNotes, AnswerThePaperExercisesOfTheScript) {
  const fs::path notes = homeFolder() / "notes";
  const auto expectAnswered = [&](const char* name, std::vector<const char*> headings) {
    const std::string text = readTextFile(notes / (std::string(name) + ".md"));
    for (const char* heading : headings) EXPECT_THAT(text, ::testing::HasSubstr(heading)) << name;
  };
  expectAnswered("00-basics", {"> 12.8.2 a, b and c", "**a.**", "**b.**", "**c.**"});
  expectAnswered("02-pegInAHole", {"## 12.4.1 a:", "## 12.4.1 b, c:", "**b.**", "**c.**"});
  expectAnswered("06-kalmanSLAM", {"## 12.13.1 a:"});
  expectAnswered("08-mdp", {"## 12.10.1 a:", "## 12.10.1 d:"});
}

}  // namespace rex::authoring::lecture_notes_test
