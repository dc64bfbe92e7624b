#include "grading/grader_fingerprint.h"

#include <gtest/gtest.h>

#include "grading/text_file.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::grading {
namespace {

class GraderFingerprint : public ::testing::Test {
 protected:
  GraderFingerprint() {
    for (const char* name :
         {"grader", "worker.o", "library.so", "src/base/a.h", "src/base/b.h", "01-x/check.cpp"})
      writeTextFile(file(name), name);
  }
  std::filesystem::path file(const std::string& name) const { return temporary_.path() / name; }
  std::string fingerprint(const std::string& flag = "-O1") const {
    Toolchain toolchain;
    toolchain.compiler = "c++";
    toolchain.flags = {flag, "-isystem", file("src").string(), "-isystem", file("none").string()};
    toolchain.workerObject = file("worker.o");
    toolchain.grader = file("grader");
    toolchain.studentLibrary = file("library.so");
    ExerciseInfo exercise;
    exercise.folder = file("01-x");
    return graderFingerprint(toolchain, exercise);
  }

 private:
  TemporaryFolder temporary_;
};

TEST_F(GraderFingerprint, ChangesWithAllThatGrades) {
  const std::string before = fingerprint();
  EXPECT_EQ(before.size(), 64u);
  EXPECT_EQ(fingerprint(), before);
  EXPECT_NE(fingerprint("-O2"), before);
  for (const char* name : {"grader", "worker.o", "library.so", "src/base/a.h", "01-x/check.cpp"}) {
    writeTextFile(file(name), "another");
    EXPECT_NE(fingerprint(), before) << name;
    writeTextFile(file(name), name);
    EXPECT_EQ(fingerprint(), before) << name;
  }
}

TEST_F(GraderFingerprint, TellsWhichHeaderHoldsWhat) {
  const std::string before = fingerprint();
  writeTextFile(file("src/base/a.h"), "src/base/b.h");
  writeTextFile(file("src/base/b.h"), "src/base/a.h");
  EXPECT_NE(fingerprint(), before);
}

TEST_F(GraderFingerprint, PassesByWhatIsNotCompiledIn) {
  const std::string before = fingerprint();
  writeTextFile(file("src/base/a.cpp"), "in the library already");
  EXPECT_EQ(fingerprint(), before);
}

TEST_F(GraderFingerprint, NeedsAllFiles) {
  std::filesystem::remove(file("worker.o"));
  EXPECT_REX_ERROR(fingerprint(), "worker.o: cannot read this file");
}

}  // namespace
}  // namespace rex::grading
