#pragma once

#include "cli/template_project.h"

namespace rex::cli {

// The project of the template with a build folder of its own, in which several exercises share one grader.
class LinkedBuild : public TemplateProject {
 protected:
  void SetUp() override {
    TemplateProject::SetUp();
    link("98-template");
  }

  // Another exercise, in everything but its name the one that is there.
  void addExercise(const std::string& name) const {
    fs::copy(exercise(), folderOf(name), fs::copy_options::recursive);
    link(name);
  }

  fs::path build() const { return root() / "build"; }
  fs::path folderOf(const std::string& name) const { return root() / "exercises" / name; }
  fs::path outOf(const std::string& name) const { return root() / "out" / name; }
  Ended rex(std::vector<std::string> arguments) const { return rexIn(build(), std::move(arguments)); }

  // What interrupted gradings left in the folders where they work.
  int workFolders() const {
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(build() / "exercises"))
      count += entry.path().filename().string().starts_with("rex-work-");
    return count;
  }

 private:
  void link(const std::string& name) const {
    fs::create_directories(build() / "exercises" / name);
    for (const char* file : {"build.json", "grader"})
      fs::create_symlink(fs::path(REX_BINARY_DIR "/tests/template/exercises/98-template") / file,
                         build() / "exercises" / name / file);
  }
};

}  // namespace rex::cli
