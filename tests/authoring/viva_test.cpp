#include "authoring/viva.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "submission/student_build.h"
#include "support/expect_error.h"
#include "support/template_exercise.h"

namespace rex::authoring::viva_test {

using ::testing::HasSubstr;

class Viva : public TemplateExercise {
 protected:
  std::vector<VivaQuestion> questionsAbout(const std::string& text) const {
    const std::filesystem::path work = temporary_.path() / "work", file = temporary_.path() / "main.cpp";
    std::filesystem::remove_all(work);
    std::filesystem::create_directory(work);
    std::ofstream(file) << text;
    return vivaQuestions(
        submission::readToolchain(buildPath("tests/template/exercises/98-template/build.json")),
        submission::readExerciseInfo(exercise()), file, {}, work);
  }
};

// Two functions, a helper among them, and nothing but the file: no regions, no main().
TEST_F(Viva, AsksAboutLinesOfTheFileWhoseChangeTheGraderSees) {
  const std::string text = R"(#include "exercise.h"

namespace {
double across(const Eigen::Vector2d& p, double angle) {
  return std::sin(angle) * p.x() + std::cos(angle) * p.y();
}
}  // namespace

Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  const double unused = 0.5 * angle;
  const double along = std::cos(angle) * p.x() - std::sin(angle) * p.y();
  return Eigen::Vector2d(along + 0 * unused, across(p, angle));
}
)";
  const std::vector<VivaQuestion> questions = questionsAbout(text);
  ASSERT_EQ(questions.size(), 3u);
  std::set<int> lines;
  std::set<std::string> functions;
  for (const VivaQuestion& one : questions) {
    lines.insert(one.line);
    functions.insert(one.function);
    EXPECT_NE(one.before, one.after);
    EXPECT_NE(one.line, 10) << "no check sees a change of `unused`";
    EXPECT_THAT(one.message, HasSubstr("wanted"));
    EXPECT_THAT(one.check, ::testing::AnyOf("quarter-turn", "keeps-length"));
  }
  EXPECT_EQ(lines.size(), 3u);
  EXPECT_EQ(functions, (std::set<std::string>{"across", "rotated"}));
  const std::vector<VivaQuestion> again = questionsAbout(text);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(again[k].after, questions[k].after) << "the same file";
}

TEST_F(Viva, NeedsAFileThatPassesACheck) {
  EXPECT_REX_ERROR(questionsAbout("int main() { return 0; }\n"), "nothing to ask about");
  EXPECT_REX_ERROR(questionsAbout(R"(#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d&, double) { return {7, 7}; }
)"),
                   "found a file that passes no visible check");
}

}  // namespace rex::authoring::viva_test
