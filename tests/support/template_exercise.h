#pragma once
// A copy of the template of exercises, whose grader was built beforehand, for gates that compile and grade:
//   class WrongVariantsTest : public TemplateExercise {};
//   TEST_F(WrongVariantsTest, Pass) { EXPECT_TRUE(pass("wrong").passed); }
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "authoring/gates.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex {

class TemplateExercise : public ::testing::Test {
 protected:
  TemplateExercise() {
    std::filesystem::create_directories(exercise().parent_path());
    std::filesystem::copy(buildPath("tests/template/source"), exercise(),
                          std::filesystem::copy_options::recursive);
  }

  std::filesystem::path exercise() const { return temporary_.path() / "exercises" / "98-template"; }
  void write(const std::filesystem::path& file, const std::string& text) const {
    std::ofstream(exercise() / file) << text;
  }
  authoring::GateResult pass(const std::string& gate, bool storesMessages = false,
                             const std::vector<std::string>& variants = {}) const {
    const std::filesystem::path work = temporary_.path() / "work";
    std::filesystem::remove_all(work);
    std::filesystem::create_directory(work);
    return authoring::runGate(
        {.root = temporary_.path(),
         .exercise = submission::readExerciseInfo(exercise()),
         .toolchain = submission::readToolchain(buildPath("tests/template/exercises/98-template/build.json")),
         .workFolder = work,
         .variants = variants,
         .storesMessages = storesMessages},
        gate);
  }

  TemporaryFolder temporary_;
};

}  // namespace rex
