#include "authoring/handed_out.h"

#include <fmt/format.h>

#include "base/text.h"
#include "base/text_file.h"

namespace rex::authoring {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) { return fs::exists(file) ? readTextFile(file) : ""; }

std::size_t publicExercises(const fs::path& root) {
  std::size_t count = 0;
  for (const submission::ExerciseInfo& one : submission::listExercises(root / "exercises"))
    count += one.isPrivate ? 0 : 1;
  return count;
}

/// A text that a file must have, and what it is.
struct Demand {
  std::string file, text, what;
};

}  // namespace

std::vector<std::string> missingDescriptions(const fs::path& root, const submission::ExerciseInfo& exercise) {
  const std::string& name = exercise.name;
  const std::string number = name.substr(0, name.find('-'));
  const std::vector<Demand> demands = {
      {"exercises/" + name + "/README.md", "\n## Discuss in the tutorial\n", "questions for the tutorial"},
      {"notes/" + name + ".md", "\n> ", "answers to these questions, each below the question as a quotation"},
      {"share/doc/exercises.md", fmt::format("\n| `{}` |", name), "a row of the exercise"},
      {"share/doc/course-map.md", fmt::format("`{}`", number), "the parts that practise a slide"},
      {"share/doc/teaching.md", fmt::format("`{}`", name), "a week in the plan"},
      {"share/ci/github-actions.yml", fmt::format("name: {},", name), "a step of the exercise"},
      {"share/ci/gitlab-ci.yml", fmt::format("\n{}:", name), "a job of the exercise"},
      {"README.md", fmt::format("[{} exercises]", publicExercises(root)), "the number of exercises"}};
  std::vector<std::string> missing;
  for (const Demand& demand : demands)
    if (textOf(root / demand.file).find(demand.text) == std::string::npos)
      missing.push_back(fmt::format("{}: missing: {}, '{}'", demand.file, demand.what, trimmed(demand.text)));
  return missing;
}

}  // namespace rex::authoring
