#pragma once

#include <nlohmann/json.hpp>

#include "cli/template_project.h"
#include "commands/all_commands.h"
#include "support/paths.h"

namespace rex::cli {

// scripts/rex of a small tree, without building: FOLDER WORDS...
inline const std::string kRexOfTree = buildPath("tests/commands/rex_of_tree");
// A compiler that compiles equal files once.
inline const std::string kKeptCompiler = buildPath("tests/template/kept_compiler");

// The same with a build folder of its own. All exercises in it share the grader that was built beforehand,
// and equal files are compiled once for all tests, by kKeptCompiler.
class BuiltProject : public TemplateProject {
 protected:
  void SetUp() override {
    TemplateProject::SetUp();
    link("98-template");
  }
  CommandSet commandSet(Program program) const override { return anyCommands(program); }

  // Another exercise, in everything but its name the one that is there.
  void addExercise(const std::string& name) const {
    fs::copy(exercise(), folderOf(name), fs::copy_options::recursive);
    link(name);
  }

  // For sandboxes, which show no other folder, and where compiling has to take its time.
  void useRealCompiler() const {
    fs::copy_file(built() / "build.json", build() / "exercises" / "98-template" / "build.json",
                  fs::copy_options::overwrite_existing);
  }

  // The description by which programs that are not exercises are built.
  void addProgramDescription() const {
    fs::create_directories(build() / "student");
    describe(buildPath("student/program.json"), build() / "student" / "program.json");
  }

  fs::path folderOf(const std::string& name) const { return root() / "exercises" / name; }
  fs::path outOf(const std::string& name) const { return root() / "out" / name; }

  // What interrupted gradings left in the folders where they work.
  int workFolders() const {
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(build() / "exercises"))
      count += entry.path().filename().string().starts_with("rex-work-");
    return count;
  }

 private:
  static fs::path built() { return buildPath("tests/template/exercises/98-template"); }
  void link(const std::string& name) const {
    fs::create_directories(build() / "exercises" / name);
    describe(built() / "build.json", build() / "exercises" / name / "build.json");
    fs::create_symlink(built() / "grader", build() / "exercises" / name / "grader");
  }
  static void describe(const fs::path& real, const fs::path& copy) {
    nlohmann::json description = nlohmann::json::parse(fileText(real));
    description["compiler"] = kKeptCompiler;
    write(copy, description.dump());
  }
};

}  // namespace rex::cli
