// What students meet when their file is broken: every file of tests/cli/broken against the golden text beside
// it. Set REX_UPDATE_GOLDEN=1 to store what is printed now; read it.
#include <algorithm>
#include <cstdlib>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/template_project.h"

namespace rex::cli::broken_submissions_test {

using ::testing::HasSubstr;
using ::testing::Not;

const fs::path kCorpus = REX_SOURCE_DIR "/tests/cli/broken";

std::vector<std::string> submissions() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kCorpus))
    if (entry.path().extension() == ".cpp") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class BrokenSubmission : public TemplateProject, public ::testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    TemplateProject::SetUp();
    // Soon enough for a loop; a slow machine prints for longer until the limit of what may be printed.
    if (GetParam() == "infinite_loop")
      replace(exercise() / "exercise.toml", "cpu_seconds = 5", "cpu_seconds = 1");
  }
  // What is printed, with a short name for the folder of the project.
  static std::string plain(std::string text, const std::string& root) {
    for (std::size_t at; (at = text.find(root)) != std::string::npos;) text.replace(at, root.size(), "ROOT");
    return text;
  }
  Ended grade(const std::string& name) const {
    return rex({"test", "98", "--main", kCorpus / (name + ".cpp")});
  }
};

TEST_P(BrokenSubmission, IsExplained) {
  const Ended ended = grade(GetParam());
  const std::string said =
      plain(ended.output + "--- standard error, exit code " + std::to_string(ended.code) + "\n" + ended.error,
            root());
  // Whatever a file does, its result is whole, and no check stays ungraded if it compiles.
  const auto result = nlohmann::json::parse(fileText(out() / "results.json"));
  EXPECT_NE(result.at("outcome"), "grader_error");
  if (ended.code != 2) {
    EXPECT_EQ(result.at("checks").size(), 3u);
    for (const auto& check : result.at("checks")) EXPECT_NE(check.at("status"), "not_run");
  }
#ifdef __SANITIZE_ADDRESS__
  static const std::set<std::string> kTheirs{"crash", "dangling_view", "division", "recursion",
                                             "ten_gigabytes"};
  if (kTheirs.contains(GetParam())) GTEST_SKIP() << "the sanitizers of this tree end it, in other words";
#endif
  const fs::path golden = kCorpus / (GetParam() + ".txt");
  if (std::getenv("REX_UPDATE_GOLDEN") != nullptr) write(golden, said);
  EXPECT_EQ(said, fileText(golden));
}

INSTANTIATE_TEST_SUITE_P(All, BrokenSubmission, ::testing::ValuesIn(submissions()),
                         [](const auto& tested) { return tested.param; });

}  // namespace rex::cli::broken_submissions_test
