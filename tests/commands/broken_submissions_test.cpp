// What students meet when their file is broken: every file of tests/commands/broken against the golden text
// beside it, as many at once as there are processors. Set REX_UPDATE_GOLDEN=1 to store what is printed now;
// read it.
#include <algorithm>
#include <cstdlib>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/process_pool.h"
#include "commands/built_project.h"
#include "support/paths.h"

namespace rex::cli::broken_submissions_test {

const fs::path kCorpus = sourcePath("tests/commands/broken");

std::vector<std::string> submissions() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kCorpus))
    if (entry.path().extension() == ".cpp") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class BrokenSubmissions : public BuiltProject {
 protected:
  // A project for each, so that all names are those that a student meets.
  fs::path projectOf(const std::string& name) const { return root() / name; }
  fs::path resultsOf(const std::string& name) const {
    return projectOf(name) / "out" / "98-template" / "results.json";
  }
  fs::path saidOf(const std::string& name) const { return projectOf(name) / "said"; }

  void grade(const std::string& name) const {
    const fs::path folder = projectOf(name) / "exercises" / "98-template";
    fs::create_directories(folder.parent_path());
    fs::copy(exercise(), folder, fs::copy_options::recursive);
    // Soon enough for a loop; a slow machine prints for longer until the limit of what may be printed.
    if (name == "infinite_loop") replace(folder / "exercise.toml", "cpu_seconds = 5", "cpu_seconds = 1");
    const Ended ended = rexWith({projectOf(name), buildPath("tests/template")},
                                {"test", "98", "--main", kCorpus / (name + ".cpp")});
    std::string said =
        ended.output + "--- standard error, exit code " + std::to_string(ended.code) + "\n" + ended.error;
    const std::string place = projectOf(name).string();
    for (std::size_t at; (at = said.find(place)) != std::string::npos;)
      said.replace(at, place.size(), "ROOT");
    write(saidOf(name), said);
  }
};

TEST_F(BrokenSubmissions, AreExplained) {
  const std::vector<std::string> names = submissions();
  const int processors = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const auto gradeOne = [&](int k) {
    grade(names[static_cast<std::size_t>(k)]);
    return 0;
  };
  forkMap(static_cast<int>(names.size()), processors, gradeOne,
          [&](int k, int end) { EXPECT_EQ(end, 0) << names[static_cast<std::size_t>(k)]; });
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    // Whatever a file does, its result is whole, and no check stays ungraded if it compiles.
    const auto result = nlohmann::json::parse(fileText(resultsOf(name)));
    EXPECT_NE(result.at("outcome"), "grader_error");
    if (result.at("outcome") != "compile_error") {
      EXPECT_EQ(result.at("checks").size(), 3u);
      for (const auto& check : result.at("checks")) EXPECT_NE(check.at("status"), "not_run");
    }
#ifdef __SANITIZE_ADDRESS__
    // The sanitizers of this tree end them, in other words.
    static const std::set<std::string> kTheirs{"crash",        "dangling_view", "division",
                                               "fills_memory", "recursion",     "ten_gigabytes"};
    if (kTheirs.contains(name)) continue;
#endif
    const fs::path golden = kCorpus / (name + ".txt");
    if (std::getenv("REX_UPDATE_GOLDEN") != nullptr) write(golden, fileText(saidOf(name)));
    EXPECT_EQ(fileText(saidOf(name)), fileText(golden));
  }
}

}  // namespace rex::cli::broken_submissions_test
