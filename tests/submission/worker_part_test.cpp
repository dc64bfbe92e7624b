#include "submission/worker_part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "base/text_file.h"
#include "submission/symbol_scan.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::submission::worker_part_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

// A library of five functions and a loop that calls two functions of a student's.
constexpr const char* kLibrary =
    "namespace rex { int helper(int x) { return x + 1; } int easy(int x) { return helper(x); } "
    "int hard(int x) { return 7 * x; } int both(int x) { return easy(x) + hard(x); } "
    "struct Rng { int next(); }; int Rng::next() { return 4; } }\n"
    "extern \"C\" void rexNotAllowedHere() { throw 1; }\nextern \"C\" void rexOfAnotherPart() { throw 2; }\n"
    "extern \"C\" int puts(const char*); extern \"C\" void rexOfControl() { puts(\"control\"); }\n";
constexpr const char* kLoop =
    "int first(int); int second(int); namespace rex { int hard(int); }\n"
    "extern \"C\" __attribute__((weak)) void rexRun_first() { first(1); }\n"
    "extern \"C\" __attribute__((weak)) void rexRun_second() { second(rex::hard(1)); }\n"
    "int main() { rexRun_first(); rexRun_second(); }\n";

class WorkerPart : public ::testing::Test {
 protected:
  WorkerPart() : folder_(temporary_.path() / "it's a \"folder\"") {
    fs::create_directory(folder_);
    writeTextFile(folder() / "groups.toml", "course = [\"rex::easy\", \"rex::Rng\"]\n");
    compile("library", kLibrary);
    compile("loop", kLoop);
  }

  const fs::path& folder() const { return folder_; }

  void compile(const std::string& name, const std::string& text) const {
    const ProcessResult done = runProcess({"g++", "-x", "c++", "-O1", "-fPIC", "-ffunction-sections", "-c",
                                           "-", "-o", (folder() / name).string() + ".o"},
                                          {.input = text});
    ASSERT_TRUE(done.ok()) << done.error;
  }

  void link(const std::string& toml, const std::string& ofPart = "") const {
    writeTextFile(folder() / "exercise.toml", "title = \"T\"\nscript = \"1\"\n" + toml +
                                                  "\n[[part]]\nid = \"one\"\ntitle = \"One\"\npoints = 1\n" +
                                                  ofPart);
    linkWorkerParts({.exercise = folder(),
                     .groups = folder() / "groups.toml",
                     .worker = folder() / "loop.o",
                     .objects = {folder() / "library.o"},
                     .functions = {"first", "second"},
                     .libraries = libraries_,
                     .compiler = "g++",
                     .objcopy = "objcopy",
                     .nm = "nm",
                     .folder = folder()});
  }

  std::vector<fs::path> libraries_;

  // The functions of the library that are in the object file, offered or not.
  std::vector<std::string> functionsIn(const std::string& object) const {
    std::vector<std::string> names;
    const ObjectFile file = readObjectFile(readTextFile(folder() / object), object);
    for (const ObjectSymbol& symbol : file.symbols)
      if (symbol.isDefined && symbol.name.starts_with("_ZN3rex"))
        names.push_back(symbol.name + (symbol.isGlobal ? "" : " hidden"));
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  TemporaryFolder temporary_;
  fs::path folder_;
};

constexpr const char* kForbidsHard = "\n[[forbidden]]\nfunction = \"rex::hard\"\nreason = \"it is part 1\"\n";

TEST_F(WorkerPart, HasWhatIsAllowedAndWhatThatNeeds) {
  compile("loop", "int main() {}");
  link("allowed = [\"course\"]");
  EXPECT_THAT(functionsIn("worker_part.o"),
              ElementsAre("_ZN3rex3Rng4nextEv", "_ZN3rex4easyEi", "_ZN3rex6helperEi hidden"));
  EXPECT_THAT(offeredSymbols(folder() / "worker.offers"),
              ElementsAre("_ZN3rex3Rng4nextEv", "_ZN3rex4easyEi"));
  EXPECT_NO_THROW(link("allowed = [\"course\", \"rex::easy\"]")) << "twice is not a fault";
  link("allowed = [\"rex::hard\"]");
  EXPECT_THAT(functionsIn("worker_part.o"), ElementsAre("_ZN3rex4hardEi"));
  link("");
  EXPECT_THAT(functionsIn("worker_part.o"),
              ElementsAre("_ZN3rex3Rng4nextEv", "_ZN3rex4easyEi", "_ZN3rex6helperEi hidden"));
}

TEST_F(WorkerPart, IsNotMadeWithSomethingForbidden) {
  compile("loop", "int main() {}");
  EXPECT_REX_ERROR(link("allowed = [\"rex::both\"]", kForbidsHard),
                   "exercise.toml: forbids functions that an allowed one needs: found rex::hard in "
                   "the worker");
  EXPECT_NO_THROW(link("allowed = [\"rex::easy\", \"rex::hard\"]", kForbidsHard)) << "it is not offered";
  EXPECT_THAT(functionsIn("worker_part.o"), ElementsAre("_ZN3rex4easyEi", "_ZN3rex6helperEi hidden"));
  EXPECT_REX_ERROR(link("allowed = [\"rex::eazy\"]"), "allows 'rex::eazy', which the library does not have");
  EXPECT_REX_ERROR(link("allowed = [\"coarse\"]"), "did you mean 'course'");
}

// A class that is destroyed by an allowed function need not be inlined there, but its other members do work.
TEST_F(WorkerPart, MayDestroyWhatIsForbidden) {
  const std::string forbidden = "\n[[forbidden]]\nfunction = \"rex::Hard\"\nreason = \"it is part 1\"\n";
  const auto libraryWhereEasy = [&](const std::string& work) {
    const std::string classHard =
        "struct Hard { ~Hard(); int solve(); }; Hard::~Hard() {} int Hard::solve() { return 7; }\n";
    compile("library", "namespace rex { " + classHard + "int easy(Hard* hard) { int x = 1; " + work +
                           " delete hard; return x; } }\nextern \"C\" void rexNotAllowedHere() {}\n"
                           "extern \"C\" void rexOfAnotherPart() {}\nextern \"C\" void rexOfControl() {}\n");
  };
  compile("loop", "int main() {}");
  libraryWhereEasy("");
  link("allowed = [\"rex::easy\"]", forbidden);
  EXPECT_THAT(functionsIn("worker_part.o"), ::testing::Contains("_ZN3rex4HardD1Ev hidden"));
  libraryWhereEasy("x = hard->solve();");
  EXPECT_REX_ERROR(link("allowed = [\"rex::easy\"]", forbidden), "found rex::Hard in the worker");
}

// The loop needs hard() for the second function: the worker of a part without it has another.
TEST_F(WorkerPart, IsMadeForOnePartAlone) {
  const std::string ofPart = "functions = [\"first\"]\nallowed = [\"rex::easy\"]\n";
  const std::string forbidden = std::string(kForbidsHard) + "part = \"one\"\n";
  link("allowed = [\"course\"]", ofPart + forbidden);
  const std::vector<WorkerOfPart> parts = workersOfParts(folder() / "worker_part.o");
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].id, "one");
  EXPECT_THAT(functionsIn("worker_part.one.o"), ElementsAre("_ZN3rex4easyEi", "_ZN3rex6helperEi hidden"));
  EXPECT_THAT(functionsIn("worker_part.o"), ::testing::Contains("_ZN3rex4hardEi hidden"));
  // What a student's file may use elsewhere, it finds here, too: it throws.
  EXPECT_EQ(readTextFile(parts[0].options), "-Wl,--defsym=_ZN3rex3Rng4nextEv=rexNotAllowedHere\n");
  compile("student",
          "namespace rex { struct Rng { int next(); }; }\nint first(int) { rex::Rng r; return r.next(); }\n"
          "int second(int) { return 0; }\n");
  const fs::path program = folder() / "program";
  const ProcessResult linked = runProcess({"g++", (folder() / "student.o").string(), parts[0].object.string(),
                                           "@" + parts[0].options.string(), "-o", program.string()});
  ASSERT_TRUE(linked.ok()) << linked.error;
  EXPECT_THAT(runProcess({program.string()}).error,
              ::testing::HasSubstr("terminate called after throwing an instance of 'int'"));
  link("allowed = [\"course\"]");
  EXPECT_TRUE(workersOfParts(folder() / "worker_part.o").empty()) << "of before";
}

// The control holds what workers hold, and needs nothing of a student's.
TEST_F(WorkerPart, HasAControl) {
  link("allowed = [\"rex::easy\"]");
  const fs::path control = controlProgram(folder() / "worker_part.o");
  EXPECT_EQ(runProcess({control.string()}).output, "control\ncontrol\n");
  EXPECT_FALSE(fs::exists(folder() / "worker.control.o"));
}

// Of two libraries that the whole of ours needs, easy() needs one.
TEST_F(WorkerPart, IsLinkedWithThoseLibrariesOfOthersThatItNeeds) {
  for (const std::string name : {"one", "other"}) {
    compile(name, "extern \"C\" int " + name + "(int x) { return x; }");
    libraries_.push_back(folder() / ("lib" + name + ".so"));
    const std::string object = (folder() / name).string() + ".o";
    ASSERT_TRUE(runProcess({"g++", "-shared", object, "-o", libraries_.back()}, {}).ok());
  }
  compile("loop", "int main() {}");
  compile("library",
          "extern \"C\" int one(int); extern \"C\" int other(int);\n"
          "namespace rex { int easy(int x) { return one(x); } int hard(int x) { return other(x); }\n"
          "struct Rng { int next(); }; int Rng::next() { return 4; } }\n"
          "extern \"C\" void rexNotAllowedHere() { throw 1; }\nextern \"C\" void rexOfControl() {}\n");
  const fs::path options = linkOptions(folder() / "worker_part.o");
  link("allowed = [\"course\"]");
  EXPECT_THAT(readTextFile(options), testing::MatchesRegex("[^\n]*/libone.so\n"));
  // As packages install it: for compiling, by its interface, and the file, which another version replaces.
  fs::create_directory(folder() / "atlas");
  fs::rename(folder() / "libone.so", folder() / "atlas" / "libone.so.3.10");
  fs::create_symlink("atlas/libone.so.3.10", folder() / "libone.so.3");
  fs::create_symlink("libone.so.3", folder() / "libone.so");
  link("allowed = [\"course\"]");
  EXPECT_THAT(readTextFile(options), testing::MatchesRegex("[^\n]*/libone.so.3\n"));
  EXPECT_THAT(readTextFile(options), testing::Not(testing::HasSubstr("atlas")));
  link("allowed = [\"rex::Rng\"]");
  EXPECT_EQ(readTextFile(options), "");
  libraries_ = {folder() / "libnone.so"};
  EXPECT_REX_ERROR(link("allowed = [\"course\"]"), "cannot run nm");
}

}  // namespace rex::submission::worker_part_test
