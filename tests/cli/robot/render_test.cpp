// `rex render` as a user meets it.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "cli/rex_command.h"
#include "render/image.h"
#include "support/changed_path.h"
#include "support/file_text.h"
#include "support/needs_osmesa.h"
#include "support/paths.h"

namespace rex::cli::render_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class RenderCommand : public RexCommand {
 protected:
  void expectRefusal(std::vector<std::string> arguments, int code, const std::string& message) const {
    arguments.insert(arguments.begin(), {"render", "pegArm.ors"});
    const ProcessResult result = rex(arguments);
    EXPECT_EQ(result.exitCode, code) << message;
    EXPECT_THAT(flat(result.error), HasSubstr(message));
    EXPECT_TRUE(fs::is_empty(in(""))) << message;
  }
  std::string textOf(const std::string& name) const { return fileText(in(name)); }
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

TEST_F(RenderCommand, MakesTheFoldersOfItsFile) {
  REX_NEEDS_OSMESA();
  ASSERT_EQ(rex({"render", "pegArm.ors", "--size", "32x24", "-o", "no/such/a.png"}).exitCode, 0);
  EXPECT_EQ(readPng(in("no/such/a.png")).width, 32);
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
  ASSERT_EQ(
      rex({"render", "pegArm", "--size", "600x90", "--q", "0,0,0", "--q", "1,1,1", "-o", "c.png"}).exitCode,
      0);
  EXPECT_GE(readPng(in("c.png")).width, 1800);
}

// A cube whose sides have colours of their own, in both formats.
class ColouredCube : public RenderCommand {
 protected:
  struct Side {
    const char* name;
    const char* place;
    const char* size;
    std::array<int, 3> color;  // 0 or 1
  };
  static constexpr std::array<Side, 5> kSides = {{{"plusX", "0.5 0 0", "0.02 1 1", {1, 0, 0}},
                                                  {"minusX", "-0.5 0 0", "0.02 1 1", {0, 1, 1}},
                                                  {"plusY", "0 0.5 0", "1 0.02 1", {0, 1, 0}},
                                                  {"minusY", "0 -0.5 0", "1 0.02 1", {1, 0, 1}},
                                                  {"plusZ", "0 0 0.5", "1 1 0.02", {0, 0, 1}}}};

  void writeUrdf() const {
    std::string visuals;
    for (const Side& side : kSides)
      visuals += fmt::format(
          "<visual><origin xyz='{}'/><geometry><box size='{}'/></geometry><material name='{}'>"
          "<color rgba='{} {} {} 1'/></material></visual>",
          side.place, side.size, side.name, side.color[0], side.color[1], side.color[2]);
    std::ofstream(in("cube.urdf")) << "<robot name='cube'><link name='cube'>" << visuals << "</link></robot>";
  }
  void writeOrs() const {
    std::ofstream file(in("cube.ors"));
    file << "body cube { }\n";
    for (const Side& side : kSides)
      file << fmt::format("shape {} (cube) {{ type=0 rel=<T t({})> size=[{} 0] color=[{} {} {}] }}\n",
                          side.name, side.place, side.size, side.color[0], side.color[1], side.color[2]);
  }
  // The sides in the middle of the pictures from the front, back, left, right and top.
  std::string sidesSeen(const std::string& file) const {
    std::string seen;
    for (const std::string camera : {"front", "back", "left", "right", "top"}) {
      const ProcessResult result =
          rex({"render", file, "--camera", camera, "--size", "40x40", "-o", "a.png"});
      if (result.exitCode != 0) return result.error;
      const auto middle = readPng(in("a.png")).at(20, 20);
      const int brightest = std::max({middle[0], middle[1], middle[2]});
      for (const Side& side : kSides) {
        bool isThis = true;
        for (std::size_t i = 0; i < 3; ++i) isThis &= (3 * middle[i] > 2 * brightest) == (side.color[i] == 1);
        if (isThis) seen += side.name + std::string(" ");
      }
    }
    return seen;
  }
};

TEST_F(ColouredCube, ShowsTheFaceOfAUrdfRobotFromPlusX) {
  REX_NEEDS_OSMESA();
  writeUrdf();
  EXPECT_EQ(sidesSeen("cube.urdf"), "plusX minusX plusY minusY plusZ ");
}

TEST_F(ColouredCube, ShowsTheFaceOfAnOrsRobotFromMinusY) {
  REX_NEEDS_OSMESA();
  writeOrs();
  EXPECT_EQ(sidesSeen("cube.ors"), "minusY plusY plusX minusX plusZ ");
}

TEST_F(ColouredCube, SaysFromWhichAxis) {
  REX_NEEDS_OSMESA();
  writeUrdf();
  for (const std::string out : {"a.png", "a.glb", "a.html"})
    EXPECT_THAT(flat(rex({"render", "cube.urdf", "--camera", "front", "-o", out}).error),
                HasSubstr("view: front (from +x)"))
        << out;
}

TEST_F(RenderCommand, PaintsMeshesOnRequest) {
  REX_NEEDS_OSMESA();
  Image red(4, 4);
  for (std::size_t i = 0; i < red.rgb.size(); i += 3) red.rgb[i] = 255;
  writePng(red, in("red.png"));
  std::ofstream(in("wall.mtl")) << "newmtl m\nKd 0.1 0.1 0.9\nmap_Kd red.png\n";
  std::ofstream(in("wall.obj")) << "mtllib wall.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
                                   "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";
  std::ofstream(in("wall.ors")) << "shape wall { type=3 mesh='wall.obj' }\n";
  const auto middleOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", "wall.ors", "--camera", "0,-1,0",
                                      "--size", "40x40",    "-o",       "a.png"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(rex(words).exitCode, 0);
    return readPng(in("a.png")).at(20, 20);
  };
  const auto bare = middleOf({}), painted = middleOf({"--textures"});
  EXPECT_GT(bare[2], 2 * bare[0]);
  EXPECT_GT(painted[0], 2 * painted[2]);
  fs::remove(in("red.png"));
  const ProcessResult missing = rex({"render", "wall.ors", "--textures", "--size", "40x40", "-o", "a.png"});
  EXPECT_EQ(missing.exitCode, 0);
  EXPECT_THAT(flat(missing.error), HasSubstr("wall.ors:1:"));
  EXPECT_THAT(flat(missing.error), HasSubstr("texture 'red.png': found no such file"));
}

TEST_F(RenderCommand, SaysThatASceneHasNothingToDraw) {
  std::ofstream(in("bare.urdf")) << "<robot name='bare'><link name='base'/></robot>";
  for (const std::string out : {"a.png", "a.glb", "a.html"}) {
    const ProcessResult result = rex({"render", "bare.urdf", "-o", out});
    EXPECT_EQ(result.exitCode, 64) << out;
    EXPECT_THAT(flat(result.error),
                HasSubstr("bare.urdf: found no shape to draw, wanted a scene with shapes"));
  }
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
    std::vector<std::string> arguments = {"render",     "pegArm.ors", "--q",     "0,0,0", "--q", "1,1,1",
                                          "--duration", "0.2",        "--trace", "peg",   "-o",  name};
    if (name != "a.glb") arguments.insert(arguments.end(), {"--size", "64x48"});
    const ProcessResult result = rex(arguments);
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
  const ChangedPath nowhere;
  const ProcessResult result = rex({"render", "pegArm.ors", "--size", "48x36", "--q", "0,0,0", "--q", "1,1,1",
                                    "--duration", "0.1", "-o", "a.mp4"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_THAT(result.error, HasSubstr("ffmpeg"));
  EXPECT_EQ(result.output, "a\n");
  EXPECT_TRUE(fs::exists(in("a/0003.png")));
  EXPECT_FALSE(fs::exists(in("a.mp4")));
}

TEST_F(RenderCommand, RefusesWhatItCannotDraw) {
  expectRefusal({"-o", "a.pgn"}, 64, "found the ending '.pgn', wanted .png");
  expectRefusal({"-o", "frames", "--size", "0x480"}, 64, "--size: found '0x480'");
  expectRefusal({"-o", "a.png", "--gl", "opengl"}, 64, "OpenGL backend: found 'opengl'");
  expectRefusal({"-o", "a.png", "--show", "colour"}, 64, "did you mean 'color'?");
  expectRefusal({"-o", "a.png", "--camera", "frnt"}, 64, "did you mean 'front'?");
  expectRefusal({"-o", "a.png", "--q", "1,2"}, 64, "--q: found 2 numbers, wanted 3");
  expectRefusal({"-o", "a.png", "--motion", "nowhere.csv"}, 64, "nowhere.csv: cannot read the motion");
  expectRefusal({"-o", "a.png", "--q", "0 0 0", "--q", "1 1 1", "--trace", "pge"}, 64,
                "--trace: scene 'pegArm.ors' has no body 'pge' (did you mean 'peg'?)");
  expectRefusal({"-o", "a.png", "--duration", "nan", "--q", "0 0 0", "--q", "1 1 1"}, 64,
                "--duration: found nan, wanted 0.04 to 600");
  expectRefusal({"-o", "a.mp4", "--duration", "600", "--q", "0 0 0", "--q", "1 1 1"}, 64,
                "motion through --q: found 600 s, wanted at most 120 s");
  expectRefusal({"-o", "a.glb", "--size", "64x48"}, 64, "--size: wanted a picture, film or page");
  for (const char* out : {"/proc/a.png", "/proc/a.glb", "/proc/a.html", "/proc/a.mp4", "/proc/frames"})
    expectRefusal({"-o", out}, 64, "cannot write '" + std::string(out) + "': found No such file");
  expectRefusal({"-o", "/proc/no/a.png"}, 64, "/proc/no: cannot make the folder for results");
}

TEST_F(RenderCommand, RefusesToReplaceAFolder) {
  fs::create_directory(in("a.png"));
  const ProcessResult result = rex({"render", "pegArm", "-o", "a.png"});
  EXPECT_EQ(result.exitCode, 64);
  EXPECT_THAT(flat(result.error), HasSubstr("cannot write 'a.png': found a folder of that name"));
}

TEST_F(RenderCommand, RefusesWaysOfAMotionWithOnePosture) {
  std::ofstream(in("one.csv")) << "0,0,0\n";
  const ProcessResult result =
      rex({"render", "pegArm", "--motion", "one.csv", "--trace", "peg", "-o", "a.png"});
  EXPECT_EQ(result.exitCode, 64);
  EXPECT_THAT(result.error, HasSubstr("--trace: found one posture, wanted a motion"));
}

TEST_F(RenderCommand, DrawsTheSameTwice) {
  REX_NEEDS_OSMESA();
  for (const char* name : {"a.png", "b.png"})
    ASSERT_EQ(rex({"render", "man.ors", "--size", "80x60", "-o", name}).exitCode, 0);
  EXPECT_EQ(readPng(in("a.png")), readPng(in("b.png")));
}

TEST_F(RenderCommand, TouchesNothingWhenRefused) {
  fs::create_directories(in("frames"));
  for (const char* file : {"frames/0000.png", "frames/note.txt", "a.png"}) std::ofstream(in(file)) << "old";
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--size", "640"},
                                             {"--q", "1"},
                                             {"--camera", "frnt"},
                                             {"--gl", "x"},
                                             {"--camera", "0,9,9@0,99,9"}}) {
    for (const std::string out : {"frames", "a.png", "new"}) {
      std::vector<std::string> arguments = {"render", "pegArm", "-o", out};
      arguments.insert(arguments.end(), wrong.begin(), wrong.end());
      EXPECT_NE(rex(arguments).exitCode, 0) << wrong[0];
    }
  }
  for (const char* file : {"frames/0000.png", "frames/note.txt", "a.png"}) EXPECT_EQ(textOf(file), "old");
  EXPECT_FALSE(fs::exists(in("new")));
}

TEST_F(RenderCommand, DoesWhatItsExamplesSay) {
  REX_NEEDS_OSMESA();
  const auto examples = examplesOf("render");
  EXPECT_GE(examples.size(), 4u);
  for (std::vector<std::string> example : examples) {
    example.insert(example.end(), {"--size", "48x36"});
    const ProcessResult result = rex(example);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    EXPECT_TRUE(fs::exists(in(result.output.substr(0, result.output.size() - 1)))) << result.output;
  }
}

TEST_F(RenderCommand, FindsScenesByName) {
  EXPECT_EQ(rex({"render", "pegArm", "-o", "a.glb"}).exitCode, 0);
  const ProcessResult near = rex({"render", "mann.ors", "-o", "a.png"});
  EXPECT_EQ(near.exitCode, 64);
  EXPECT_THAT(flat(near.error),
              HasSubstr("rex: there is no scene 'mann.ors': wanted an .ors, .urdf or .xml file"));
  EXPECT_THAT(flat(near.error), HasSubstr("(did you mean 'man.ors'"));
  EXPECT_THAT(flat(rex({"render", "mann", "-o", "a.png"}).error), HasSubstr("(did you mean 'man'"));
  EXPECT_EQ(rex({"render", "no/man.ors", "-o", "a.png"}).exitCode, 64);
  EXPECT_EQ(rex({"render", ".", "-o", "a.png"}).exitCode, 64);
  std::ofstream(in("broken.ors")) << "body a { X=";
  const ProcessResult broken = rex({"render", "broken.ors", "-o", "a.png"});
  EXPECT_EQ(broken.exitCode, 64);
  EXPECT_THAT(broken.error, HasSubstr("broken.ors:1:"));
}

TEST_F(RenderCommand, CallsScenesAsTheUserDoes) {
  REX_NEEDS_OSMESA();
  ASSERT_EQ(rex({"render", "man.ors", "--size", "48x36", "-o", "a.html"}).exitCode, 0);
  EXPECT_THAT(textOf("a.html"), HasSubstr("<title>man</title>"));
  ASSERT_EQ(rex({"render", "man", "--caption", "A man", "--size", "48x36", "-o", "a.html"}).exitCode, 0);
  EXPECT_THAT(textOf("a.html"), HasSubstr("<title>A man</title>"));
  for (const std::string& scene :
       std::vector<std::string>{"man", "man.ors", sourcePath("data/robots/man.ors")}) {
    const ProcessResult result = rex({"render", scene, "--q", "x=1", "-o", "a.png"});
    EXPECT_THAT(flat(result.error),
                HasSubstr("--q: " + fs::path(scene).filename().string() + " has no joint"));
    EXPECT_THAT(result.error, Not(HasSubstr(homeFolder().string())));
  }
}

TEST_F(RenderCommand, TakesAnEmptyEnvironmentForNoChoice) {
  REX_NEEDS_OSMESA();
  ::setenv("REX_GL", "", 1);
  EXPECT_EQ(rex({"render", "man", "--size", "48x36", "-o", "a.png"}).exitCode, 0);
  EXPECT_EQ(rex({"render", "man", "--gl", "", "--size", "48x36", "-o", "a.png"}).exitCode, 0);
  ::unsetenv("REX_GL");
}

TEST_F(RenderCommand, WalksWithSeveralCameras) {
  REX_NEEDS_OSMESA();
  ASSERT_EQ(rex({"render", "pegArm", "--camera", "front", "--camera", "2,0,1@0,0,1", "--size", "32x24", "-o",
                 "around"})
                .exitCode,
            0);
  const Image first = readPng(in("around/0000.png"));
  EXPECT_GE(first.width, 64);
  EXPECT_NE(first, readPng(in("around/0030.png")));
}

}  // namespace rex::cli::render_test
