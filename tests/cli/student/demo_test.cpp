// rex demo: which demonstrations there are, and what it says to names that are none. They run in
// tests/examples.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/command_schema.h"
#include "cli/template_project.h"
#include "submission/demonstrations.h"
#include "support/paths.h"

namespace rex::cli::demo_test {

using ::testing::HasSubstr;

class Demo : public TemplateProject {
 protected:
  void demonstration(const std::string& name, const std::string& text) const {
    fs::create_directories(root() / "share" / "demonstrations");
    write(root() / "share" / "demonstrations" / (name + ".cpp"), text);
  }
};

TEST(Demonstrations, CoverChapters2To11) {
  std::set<int> chapters;
  for (const submission::Demonstration& one :
       submission::demonstrations(homeFolder() / "share" / "demonstrations")) {
    chapters.insert(one.chapter);
    EXPECT_EQ(submission::demonstrationFacts(one).size(), 4u) << one.name;
    EXPECT_TRUE(one.slides.starts_with(std::to_string(one.chapter) + ":")) << one.name;
  }
  EXPECT_EQ(chapters, (std::set<int>{2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
}

TEST_F(Demo, ListsByChapter) {
  demonstration("swing",
                "// Chapter 3: A swing. It swings\n// to and fro.\n// Slides: 3:4, 3:5\n"
                "// Formula: |x| = a sin(w t)\n// Try: Push it\n// hard.\nint main() {}\n");
  demonstration("arm", "// Chapter 2: An arm. It moves.\nint main() {}\n");
  EXPECT_EQ(rex({"demo"}).output,
            " 2  arm    An arm\n 3  swing  A swing (3:4, 3:5)\n\nTo show one: scripts/rex demo NAME\n");
  const Ended asJson = rex({"demo", "--json"});
  EXPECT_EQ(schemaFaultsOf(asJson.output, "demo"), "");
  const auto all = nlohmann::json::parse(asJson.output).at("demonstrations");
  EXPECT_EQ(all.at(1).at("about"), "It swings to and fro.");
  EXPECT_EQ(all.at(1).at("try"), "Push it hard.");
  EXPECT_EQ(all.at(1).at("formula"), "|x| = a sin(w t)");
  EXPECT_THAT(rex({"--complete", "demo", "s"}).output, HasSubstr("swing"));
}

TEST_F(Demo, SaysWhatThereIsInstead) {
  demonstration("swing", "// Chapter 3: A swing. It swings.\nint main() {}\n");
  const Ended unknown = rex({"demo", "swimg"});
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(unknown.error, HasSubstr("there is no demonstration 'swimg'"));
  EXPECT_THAT(unknown.error, HasSubstr("did you mean 'swing'?"));
  EXPECT_THAT(rex({"demo", "12"}).error, HasSubstr("no demonstration belongs to chapter 12"));
  EXPECT_THAT(flat(rex({"demo", "3", "--json"}).error),
              HasSubstr("--json lists all demonstrations: found 3, wanted nothing else"));
  EXPECT_THAT(flat(rex({"demo", "--seed", "3"}).error),
              HasSubstr("--seed and --runs are for one demonstration: wanted its name"));
  EXPECT_THAT(flat(rex({"demo", "swing", "--seed", "3"}).error),
              HasSubstr("swing has no random numbers: --seed has no effect"));
  EXPECT_THAT(flat(rex({"demo", "swing", "--runs", "3"}).error),
              HasSubstr("swing has no runs to compare: --runs has no effect"));
  demonstration("broken", "int main() {}\n");
  EXPECT_THAT(rex({"demo"}).error, HasSubstr("broken.cpp:1: the first comment"));
}

}  // namespace rex::cli::demo_test
