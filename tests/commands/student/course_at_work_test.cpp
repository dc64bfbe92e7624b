// A course folder in which a student works, beside an installed rex.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commands/built_project.h"

namespace rex::cli::course_at_work_test {

using ::testing::HasSubstr;

class CourseAtWork : public BuiltProject {
 protected:
  void SetUp() override {
    BuiltProject::SetUp();
    fs::create_directories(root() / "share" / "course");
    fs::copy(exercise() / "main.cpp", exercise() / "starter.cpp");
  }
  fs::path course() const { return root() / "course"; }
  fs::path mine(const std::string& name) const { return course() / "exercises" / "98-template" / name; }
  Ended installed(const std::vector<std::string>& arguments) const {
    const fs::path here = fs::exists(course()) ? course() : root();
    return rexWith({.root = here, .build = build(), .installed = root()}, arguments);
  }
};

TEST_F(CourseAtWork, IsWhereStudentsWork) {
  ASSERT_EQ(installed({"init", course().string()}).code, 0);
  write(mine("main.cpp"), kGood);
  const Ended ended = installed({"test", "98"});
  EXPECT_EQ(ended.code, 0) << ended.output << ended.error;
  EXPECT_TRUE(fs::exists(course() / "out" / "98-template" / "results.json"));
  EXPECT_THAT(installed({}).output, HasSubstr("1 of 1 exercises solved"));
  // What an exercise demands cannot be changed here.
  write(mine("exercise.toml"), "title = \"easy\"\n");
  write(mine("exercise.h"), "#error\n");
  EXPECT_EQ(installed({"test", "98"}).code, 0);
  EXPECT_THAT(installed({"list"}).output, ::testing::Not(HasSubstr("easy")));
  EXPECT_EQ(installed({"reset", "98"}).code, 0);
  EXPECT_EQ(fileText(mine("main.cpp")), fileText(exercise() / "main.cpp"));
}

}  // namespace rex::cli::course_at_work_test
