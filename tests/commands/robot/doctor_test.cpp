// `rex doctor` as a user meets it.
#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <stdlib.h>

#include "cli/command_schema.h"
#include "commands/built_project.h"
#include "commands/rex_program.h"
#include "support/changed_path.h"
#include "support/needs_egl.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"

namespace rex::cli::doctor_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

#define REX_NEEDS_FFMPEG() \
  if (!::rex::runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "install ffmpeg"

struct Diagnosis {
  int exitCode = -1;
  bool ok = false;
  std::map<std::string, std::string> status{}, text{};
};

class Doctor : public RexProgram {
 protected:
  Diagnosis diagnose(std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.begin(), {"doctor", "--json"});
    const ProcessResult result = rex(arguments);
    Diagnosis diagnosis{.exitCode = result.exitCode};
    const auto json = nlohmann::json::parse(result.output);
    diagnosis.ok = json.at("ok").get<bool>();
    for (const auto& finding : json.at("findings")) {
      const std::string name = finding.at("name").get<std::string>();
      diagnosis.status[name] = finding.at("status").get<std::string>();
      diagnosis.text[name] = finding.at("text").get<std::string>();
    }
    return diagnosis;
  }

  // The doctor where programs behave like these scripts.
  Diagnosis diagnoseWith(const std::map<std::string, std::string>& programs) const {
    const TemporaryFolder fakes;
    for (const auto& [program, script] : programs) writeProgram(fakes.path() / program, script);
    const ChangedPath changed(fakes.path());
    return diagnose({"--gl", "osmesa"});
  }

  // The doctor where a library is not a library.
  Diagnosis diagnoseWithout(const std::vector<std::string>& libraries,
                            const std::vector<std::string>& arguments = {}) const {
    const TemporaryFolder fakes;
    for (const std::string& library : libraries) std::ofstream(fakes.path() / library) << "no library";
    ::setenv("LD_LIBRARY_PATH", fakes.path().c_str(), 1);
    const Diagnosis diagnosis = diagnose(arguments);
    ::unsetenv("LD_LIBRARY_PATH");
    return diagnosis;
  }

  const std::vector<std::string> osMesa_ = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  const std::vector<std::string> egl_ = {"libEGL.so.1", "libEGL.so"};
};

TEST_F(Doctor, FindsThatAllWorks) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  REX_NEEDS_GNUPLOT();
  REX_NEEDS_FFMPEG();
  const Diagnosis diagnosis = diagnose();
  EXPECT_EQ(diagnosis.exitCode, 0);
  EXPECT_TRUE(diagnosis.ok);
  const std::map<std::string, std::string> works = {{"rex", "works"},           {"compiler", "works"},
                                                    {"libraries", "works"},     {"OpenGL by osmesa", "works"},
                                                    {"OpenGL by egl", "works"}, {"figures", "works"},
                                                    {"videos", "works"},        {"replays", "works"},
                                                    {"watch", "works"},         {"sandbox", "works"},
                                                    {"exercises", "works"}};
  EXPECT_EQ(diagnosis.status, works);
  EXPECT_THAT(diagnosis.text.at("rex"), ::testing::ContainsRegex("^[0-9.]+, by (g|clang)\\+\\+ .*, on .+"));
  EXPECT_THAT(diagnosis.text.at("OpenGL by osmesa"), HasSubstr("the same pixels"));
  EXPECT_THAT(diagnosis.text.at("figures"), HasSubstr("gnuplot "));
  EXPECT_THAT(diagnosis.text.at("videos"), HasSubstr("ffmpeg version"));
  const ProcessResult table = rex({"doctor"});
  EXPECT_EQ(table.exitCode, 0);
  EXPECT_TRUE(table.output.ends_with("\nNothing else is needed.\n")) << table.output;
}

TEST_F(Doctor, DoesWhatItsExamplesSay) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "an example asks for a sandbox, which allows sanitizers too few addresses";
#endif
  REX_NEEDS_EGL();
  REX_NEEDS_GNUPLOT();
  REX_NEEDS_FFMPEG();
  const auto examples = examplesOf("doctor");
  EXPECT_GE(examples.size(), 2u);
  for (const auto& example : examples) EXPECT_EQ(rex(example).exitCode, 0) << example.back();
}

TEST_F(Doctor, NamesThePackagesOfMissingPrograms) {
  REX_NEEDS_OSMESA();
  const ChangedPath nowhere;
  const Diagnosis diagnosis = diagnose({"--gl", "osmesa"});
  EXPECT_EQ(diagnosis.exitCode, 3);
  EXPECT_FALSE(diagnosis.ok);
  EXPECT_EQ(diagnosis.status.at("OpenGL by osmesa"), "works");
  EXPECT_EQ(diagnosis.status.count("OpenGL by egl"), 0u);
  EXPECT_EQ(diagnosis.status.at("compiler"), "missing");
  EXPECT_THAT(diagnosis.text.at("compiler"), HasSubstr("a part is missing: "));
  EXPECT_EQ(diagnosis.status.at("figures"), "missing");
  EXPECT_EQ(diagnosis.text.at("figures"),
            "cannot draw figure 'test': found No such file or directory, wanted gnuplot, Debian package "
            "gnuplot-nox");
  EXPECT_EQ(diagnosis.status.at("videos"), "missing");
  EXPECT_EQ(diagnosis.text.at("videos"),
            "film.mp4 is missing because ffmpeg is not installed (apt-get install ffmpeg)");
  const std::string table = rex({"doctor", "--gl", "osmesa"}).output;
  EXPECT_TRUE(table.ends_with("\nTo do: apt-get install ffmpeg g++ gnuplot-nox\n")) << table;
}

using InstalledDoctor = BuiltProject;

TEST_F(InstalledDoctor, NamesExercisesThatAreNotBuilt) {
  fs::create_directories(root() / "exercises" / "97-new");
  fs::copy(exercise() / "exercise.toml", root() / "exercises" / "97-new" / "exercise.toml");
  const Ended ended =
      rexWith({.root = root(), .build = build(), .installed = root()}, {"doctor", "--gl", "osmesa"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.output), HasSubstr("exercises fails not built in this rex: 97-new"));
  EXPECT_THAT(flat(ended.output), HasSubstr("repair what fails: exercises"));
}

TEST_F(InstalledDoctor, FindsThatAHeaderOfTheLibraryIsMissing) {
  addProgramDescription();
  write(exercise() / "show.cpp", "#include \"exercise.h\"\n#include \"systems/no_such_model.h\"\n");
  const Ended ended =
      rexWith({.root = root(), .build = build(), .installed = root()}, {"doctor", "--gl", "osmesa"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(
      flat(ended.output),
      HasSubstr("exercises fails a header of the library is missing: systems/no_such_model.h: No such "
                "file or directory; install rex again"));
}

TEST_F(Doctor, IsContentWithOneWayToOpenGl) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  REX_NEEDS_GNUPLOT();
  REX_NEEDS_FFMPEG();
  const Diagnosis onlyOsMesa = diagnoseWithout(egl_), onlyEgl = diagnoseWithout(osMesa_);
  EXPECT_EQ(onlyOsMesa.exitCode, 0);
  EXPECT_EQ(onlyOsMesa.status.at("OpenGL by egl"), "missing");
  EXPECT_THAT(onlyOsMesa.text.at("OpenGL by egl"), HasSubstr("Debian packages libegl1 and libgl1-mesa-dri"));
  EXPECT_EQ(onlyEgl.exitCode, 0);
  EXPECT_TRUE(onlyEgl.ok);
  EXPECT_EQ(onlyEgl.status.at("OpenGL by osmesa"), "missing");
  EXPECT_THAT(onlyEgl.text.at("OpenGL by osmesa"), HasSubstr("Debian package libosmesa6"));
}

TEST_F(Doctor, NeedsTheOpenGlThatIsAskedFor) {
  const Diagnosis diagnosis = diagnoseWithout(egl_, {"--gl", "egl"});
  EXPECT_EQ(diagnosis.exitCode, 3);
  EXPECT_EQ(diagnosis.status.at("OpenGL by egl"), "missing");
  EXPECT_EQ(diagnosis.status.at("replays"), "missing");
  std::vector<std::string> both = osMesa_;
  both.insert(both.end(), egl_.begin(), egl_.end());
  const Diagnosis none = diagnoseWithout(both);
  EXPECT_EQ(none.exitCode, 3);
  EXPECT_THAT(none.text.at("replays"), HasSubstr("wanted Debian packages libegl1 and"));
}

// What one of them does changes nothing for the others, so each diagnosis looks at several.
TEST_F(Doctor, TellsHowProgramsFail) {
  const auto expect = [](const Diagnosis& diagnosis, const std::string& name, const std::string& status,
                         const std::string& text) {
    EXPECT_EQ(diagnosis.exitCode, 3);
    EXPECT_EQ(diagnosis.status.at(name), status);
    EXPECT_THAT(diagnosis.text.at(name), HasSubstr(text));
  };
  const Diagnosis exits =
      diagnoseWith({{"gnuplot", "echo no licence >&2; exit 7"}, {"ffmpeg", "exit 3"}, {"as", "exit 1"}});
  expect(exits, "figures", "fails", "gnuplot does not work: found exit code 7: no licence");
  expect(exits, "videos", "fails", "ffmpeg does not work: found exit code 3");
  expect(exits, "compiler", "fails", "it cannot compile a small program");
  const Diagnosis lies = diagnoseWith(
      {{"gnuplot", "kill -SEGV $$"},
       {"ffmpeg", "exit 0"},
       {"ld", "while [ \"$1\" != -o ]; do shift; done; printf '#!/bin/sh\\n' > \"$2\"; chmod +x \"$2\""}});
  expect(lies, "figures", "fails", "gnuplot does not work: found termination by signal 11");
  expect(lies, "videos", "missing", "this ffmpeg has no encoder libx264");
  expect(lies, "compiler", "fails", "a program that it compiled does not work");
  const Diagnosis later =
      diagnoseWith({{"gnuplot", "[ $1 = --version ] || kill -SEGV $$"},
                    {"ffmpeg", "[ $# -gt 9 ] && { cat > /dev/null; exit 9; }; echo fine"}});
  expect(later, "figures", "fails", "cannot draw figure 'test': found signal 11 that ended gnuplot");
  expect(later, "videos", "fails", "cannot make the video: found ffmpeg ended with exit code 9");
  expect(diagnoseWith({{"gnuplot", "cat > /dev/null"}}), "figures", "fails",
         "no complete picture from gnuplot");
}

TEST_F(Doctor, SaysWhatToRepair) {
  const TemporaryFolder fakes;
  writeProgram(fakes.path() / "gnuplot", "exit 1");
  const ChangedPath changed(fakes.path());
  const std::string table = rex({"doctor"}).output;
  EXPECT_THAT(table, HasSubstr("\nTo do: "));
  EXPECT_THAT(table, HasSubstr("repair what fails: figures"));
}

TEST_F(Doctor, NamesAFolderForTemporaryFilesThatIsNone) {
  const char* before = ::getenv("TMPDIR");
  const std::string previous = before == nullptr ? "" : before;
  ::setenv("TMPDIR", "/nonexistent", 1);
  std::vector<ProcessResult> results;
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"doctor"}, {"doctor", "--sandbox"}, {"test", "01", "--level", "1"}})
    results.push_back(rex(command));
  before == nullptr ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", previous.c_str(), 1);
  for (const ProcessResult& result : results) {
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_EQ(flat(result.error),
              "rex: TMPDIR, where temporary files go: found '/nonexistent', wanted a folder ");
  }
}

TEST_F(Doctor, RefusesAnUnknownBackend) {
  const ProcessResult result = rex({"doctor", "--gl", "opengl"});
  EXPECT_EQ(result.exitCode, 64);
  EXPECT_THAT(result.error, HasSubstr("OpenGL backend: found 'opengl'"));
}

TEST_F(Doctor, AttacksTheSandboxAndEndsWellOnlyAtTheAskedLevel) {
  const ProcessResult best = rex({"doctor", "--sandbox", "--json"});
  EXPECT_EQ(schemaFaultsOf(best.output, "doctor_sandbox"), "");
  EXPECT_EQ(schemaFaultsOf(rex({"doctor", "--json"}).output, "doctor"), "");
  const auto json = nlohmann::json::parse(best.output);
  const int level = json.at("level");
  EXPECT_EQ(best.exitCode, level > 0 ? 0 : 4);
  EXPECT_EQ(json.at("probes").size(), level > 0 ? 15u : json.at("probes").size());
  for (int asked = 0; asked <= 3; ++asked) {
    const ProcessResult result = rex({"doctor", "--sandbox", "--level", std::to_string(asked)});
    EXPECT_EQ(result.exitCode, asked <= level ? 0 : 4) << result.output;
    EXPECT_THAT(result.output,
                HasSubstr("sandbox level " + std::to_string(std::min(asked, level)) + " of 3"));
  }
  const Diagnosis whole = diagnose();
  EXPECT_THAT(whole.text.at("sandbox"), HasSubstr("sandbox level " + std::to_string(level) + " of 3"));
  EXPECT_EQ(rex({"doctor", "--level", "1"}).exitCode, 64);
}

}  // namespace rex::cli::doctor_test
