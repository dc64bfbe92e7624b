// `rex render` and `rex doctor` as a user meets them.
#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <stdlib.h>

#include "base/process.h"
#include "render/png.h"
#include "support/needs_osmesa.h"
#include "support/temporary_folder.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RenderCommand : public ::testing::Test {
 protected:
  ProcessResult rex(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), REX_BINARY_DIR "/rex");
    return runProcess(arguments, {.directory = folder_.path(), .timeout = 120});
  }
  void expectRefusal(std::vector<std::string> arguments, int code, const std::string& message) const {
    arguments.insert(arguments.begin(), {"render", "pegArm.ors"});
    const ProcessResult result = rex(arguments);
    EXPECT_EQ(result.exitCode, code) << message;
    EXPECT_THAT(flat(result.error), HasSubstr(message));
    EXPECT_TRUE(fs::is_empty(folder_.path())) << message;
  }
  static std::string flat(std::string text) {
    for (std::size_t at; (at = text.find('\n')) != std::string::npos;) text.replace(at, 1, " ");
    for (std::size_t at; (at = text.find("  ")) != std::string::npos;) text.erase(at, 1);
    return text;
  }
  fs::path in(const std::string& name) const { return folder_.path() / name; }

 private:
  TemporaryFolder folder_;
};

TEST_F(RenderCommand, DrawsAPictureAndNamesTheRenderer) {
  REX_NEEDS_OSMESA();
  const ProcessResult result = rex({"render", "man.ors", "--size", "160x120", "-o", "man.png"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_EQ(result.output, "man.png\n");
  EXPECT_THAT(result.error, HasSubstr("llvmpipe"));
  const Image image = readPng(in("man.png"));
  EXPECT_EQ(image.width, 160);
  EXPECT_EQ(image.height, 120);
}

TEST_F(RenderCommand, PutsSeveralCamerasAndMomentsOnOneSheet) {
  REX_NEEDS_OSMESA();
  ASSERT_EQ(
      rex({"render", "man.ors", "--size", "100x90", "--camera", "front", "--camera", "top", "-o", "a.png"})
          .exitCode,
      0);
  EXPECT_GE(readPng(in("a.png")).width, 200);
  ASSERT_EQ(rex({"render", "pegArm.ors", "--size", "100x90", "--q", "0,0,0", "--q", "1,1,1", "-o", "b.png"})
                .exitCode,
            0);
  EXPECT_GE(readPng(in("b.png")).width, 300);
}

TEST_F(RenderCommand, ShowsDepthAndSegmentation) {
  REX_NEEDS_OSMESA();
  for (const std::string show : {"depth", "segmentation"})
    ASSERT_EQ(rex({"render", "man.ors", "--size", "80x60", "--show", show, "-o", show + ".png"}).exitCode, 0);
  EXPECT_NE(readPng(in("depth.png")), readPng(in("segmentation.png")));
}

TEST_F(RenderCommand, TakesTheBackendFromTheEnvironment) {
  REX_NEEDS_OSMESA();
  ::setenv("REX_GL", "osmesa", 1);
  EXPECT_THAT(rex({"render", "man.ors", "--size", "80x60", "-o", "a.png"}).error, HasSubstr("OSMesa"));
  ::setenv("REX_GL", "osmosis", 1);
  EXPECT_THAT(rex({"render", "man.ors", "-o", "a.png"}).error, HasSubstr("'osmosis'"));
  ::unsetenv("REX_GL");
}

TEST_F(RenderCommand, MakesFilmsModelsAndPages) {
  REX_NEEDS_OSMESA();
  if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "needs the package ffmpeg";
  for (const std::string name : {"a.mp4", "a.gif", "a.glb", "a.html", "frames"}) {
    const ProcessResult result = rex({"render", "pegArm.ors", "--size", "64x48", "--q", "0,0,0", "--q",
                                      "1,1,1", "--seconds", "0.2", "--trace", "peg", "-o", name});
    EXPECT_EQ(result.exitCode, 0) << name << result.error;
  }
  for (const char* file : {"a.mp4", "a.gif", "a.glb", "a.html", "frames/0006.png"})
    EXPECT_GT(fs::file_size(in(file)), 500u) << file;
  EXPECT_FALSE(fs::exists(in("frames/0007.png")));
}

TEST_F(RenderCommand, WalksAroundAPosture) {
  REX_NEEDS_OSMESA();
  ASSERT_EQ(rex({"render", "pegArm.ors", "--size", "48x36", "-o", "around"}).exitCode, 0);
  EXPECT_NE(readPng(in("around/0000.png")), readPng(in("around/0040.png")));
  EXPECT_TRUE(fs::exists(in("around/0119.png")));
}

TEST_F(RenderCommand, LeavesTheFramesWhereThereIsNoFfmpeg) {
  REX_NEEDS_OSMESA();
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const ProcessResult result = rex({"render", "pegArm.ors", "--size", "48x36", "--q", "0,0,0", "--q", "1,1,1",
                                    "--seconds", "0.1", "-o", "a.mp4"});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_THAT(result.error, HasSubstr("ffmpeg"));
  EXPECT_EQ(result.output, "a\n");
  EXPECT_TRUE(fs::exists(in("a/0003.png")));
  EXPECT_FALSE(fs::exists(in("a.mp4")));
}

TEST_F(RenderCommand, RefusesWhatItCannotDraw) {
  expectRefusal({"-o", "a.pgn"}, 64, "found the ending '.pgn', wanted .png");
  expectRefusal({"-o", "a.png", "--size", "640"}, 64, "--size: found '640', wanted WIDTHxHEIGHT");
  expectRefusal({"-o", "a.png", "--size", "0x480"}, 3, "picture size: found 0 x 480");
  expectRefusal({"-o", "a.png", "--gl", "opengl"}, 3, "OpenGL backend: found 'opengl'");
  expectRefusal({"-o", "a.png", "--aa", "msa4"}, 64, "--aa: found 'msa4', wanted none, fxaa, msaa4");
  expectRefusal({"-o", "a.png", "--show", "colour"}, 64, "did you mean 'color'?");
  expectRefusal({"-o", "a.png", "--camera", "frnt"}, 64, "did you mean 'front'?");
  expectRefusal({"-o", "a.png", "--q", "1,2"}, 64, "--q: found 2 numbers, wanted 3");
  expectRefusal({"-o", "a.png", "--q", "1,2,3", "--motion", "x"}, 64, "--motion and --q: wanted one of them");
  expectRefusal({"-o", "a.png", "--motion", "nowhere.csv"}, 3, "nowhere.csv: cannot read the motion");
  expectRefusal({"-o", "a.png", "--trace", "pge"}, 3, "did you mean 'peg'?");
  expectRefusal({"-o", "no/such/folder/a.png"}, 3, "cannot write 'no/such/folder/a.png'");
  EXPECT_THAT(rex({"render", "mann.ors", "-o", "a.png"}).error, HasSubstr("mann.ors"));
}

TEST_F(RenderCommand, DrawsTheSameTwice) {
  REX_NEEDS_OSMESA();
  for (const char* name : {"a.png", "b.png"})
    ASSERT_EQ(rex({"render", "man.ors", "--size", "80x60", "-o", name}).exitCode, 0);
  EXPECT_EQ(readPng(in("a.png")), readPng(in("b.png")));
}

TEST_F(RenderCommand, DoctorTriesEverything) {
  REX_NEEDS_OSMESA();
  const ProcessResult result = rex({"doctor", "--json"});
  const auto findings = nlohmann::json::parse(result.output).at("findings");
  bool allWork = true;
  std::set<std::string> names;
  for (const auto& finding : findings) {
    names.insert(finding.at("name").get<std::string>());
    allWork = allWork && finding.at("works").get<bool>();
  }
  EXPECT_EQ(names,
            (std::set<std::string>{"OpenGL by osmesa", "OpenGL by egl", "figures", "videos", "replays"}));
  EXPECT_EQ(result.exitCode, allWork ? 0 : 3) << result.output;
}

TEST_F(RenderCommand, DoctorSaysWhatIsMissing) {
  REX_NEEDS_OSMESA();
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const ProcessResult result = rex({"doctor", "--gl", "osmesa"});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_THAT(result.output, ::testing::ContainsRegex("figures +fails +gnuplot"));
  EXPECT_THAT(result.output, ::testing::ContainsRegex("videos +fails +ffmpeg"));
  EXPECT_THAT(result.output, ::testing::ContainsRegex("OpenGL by osmesa +works"));
  EXPECT_EQ(result.output.find("egl"), std::string::npos);
}

}  // namespace
}  // namespace rex::cli
