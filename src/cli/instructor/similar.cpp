#include "cli/instructor/similar.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/join.h"
#include "base/private_folder.h"
#include "base/text_file.h"
#include "classroom/grade_task.h"
#include "classroom/similar.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using grading::ComparedText;

void writeForOthers(const fs::path& folder, const std::vector<ComparedText>& texts,
                    const std::string& handedOut) {
  for (const char* name : {"base", "submissions"}) fs::remove_all(folder / name);
  writeTextFile(folder / "base" / "main.cpp", handedOut);
  for (const ComparedText& one : texts)
    writeTextFile(folder / "submissions" / one.student / "main.cpp", one.text);
}

}  // namespace

void writeSimilar(const Project& project, const std::vector<grading::Task>& tasks, const fs::path& out,
                  const fs::path& folder, int percent) {
  std::map<std::string, std::vector<ComparedText>> byExercise;
  for (const grading::Task& task : tasks)
    byExercise[task.exercise].push_back({task.student, grading::gradedText(out / task.file)});
  for (auto& [name, texts] : byExercise) {
    const std::string handedOut = readTextFile(project.exercise(name).definition / "main.cpp");
    writeForOthers(folder / name, texts, handedOut);
    const PrivateFolder work(fs::temp_directory_path());
    const std::vector<std::string> leftOut = grading::tooRepetitive(texts, handedOut, work.path());
    if (!leftOut.empty())
      say(fmt::format("{}: left out, since the files repeat themselves too much to be compared: {}", name,
                      harmless(join(leftOut, ", "))));
    std::erase_if(texts, [&](const ComparedText& one) {
      return std::find(leftOut.begin(), leftOut.end(), one.student) != leftOut.end();
    });
    const auto pairs = grading::similarPairs(texts, handedOut, percent, work.path());
    const fs::path page = folder / (name + ".html");
    if (pairs.empty()) {
      fs::remove(page);
      say(fmt::format("{}: no two of {} submissions have {} % in common", name, texts.size(), percent));
      continue;
    }
    replaceTextFile(page, grading::similarPage(name, texts, handedOut, pairs),
                    "the page of similar submissions");
    const auto groups = grading::groupsOf(pairs);
    say(fmt::format("{}: {} group{} of similar submissions, to be looked at: {}", name, groups.size(),
                    groups.size() == 1 ? "" : "s", shown(page)));
    for (const std::vector<std::string>& group : groups) say("  " + wrap(harmless(join(group, ", ")), 4, 2));
  }
}

}  // namespace rex::cli
