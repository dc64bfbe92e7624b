#include <fstream>

#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::ors_include_test {

namespace fs = std::filesystem;

// A folder "scenes" for files of scenes, which stands in a larger one, the asset root.
class OrsInclude : public testing::Test {
 protected:
  void write(const std::string& name, std::string_view text) const {
    fs::create_directories(path(name).parent_path());
    std::ofstream(path(name)) << text;
  }
  fs::path path(const std::string& name) const { return folder_.path() / "scenes" / name; }
  SceneSpec read(std::string_view text) const {
    write("main.ors", text);
    return readOrs(path("main.ors")).spec;
  }

  TemporaryFolder folder_;
};

TEST_F(OrsInclude, ReadsNodesInPlace) {
  write("parts/arm.ors", "body arm {}\njoint (post arm) {}\nInclude='tools/hand.ors'");
  write("parts/tools/hand.ors", "body hand {}\njoint (arm hand) {}");
  const SceneSpec spec = read("body post {}\nInclude='parts/arm.ors'\nshape (hand) { type=0 }");
  ASSERT_EQ(spec.bodies.size(), 3u);
  EXPECT_EQ(spec.bodies[2].name, "hand");
  EXPECT_EQ(spec.bodies[2].shapes.size(), 1u);
  EXPECT_EQ(spec.bodies[2].where.file, path("parts/tools/hand.ors").string());
}

TEST_F(OrsInclude, WarnsOfAFolderThatIsNotThere) {
  write("main.ors", "body a {}\nChDir='meshs'");
  const Diagnostics notes = readOrs(path("main.ors")).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(toString(notes[0]),
            path("main.ors").string() + ":2:7: warning: ChDir: no folder 'meshs' beside the scene");
  fs::create_directories(path("meshs"));
  EXPECT_TRUE(readOrs(path("main.ors")).notes.empty());
}

TEST_F(OrsInclude, SharesAttributes) {
  write("steel.ors", "mass=7 color=[.5 .5 .6]");
  const SceneSpec spec = read("body a { type=0 Include='steel.ors' }\nbody b { Include='steel.ors' mass=1 }");
  EXPECT_EQ(spec.bodies[0].mass, 7);
  EXPECT_EQ(spec.bodies[0].shapes.at(0).color[2], .6);
}

TEST_F(OrsInclude, EditsAndDeletesWhatWasIncluded) {
  write("robots/arm.ors", "body a { mass=1 }\nbody b {}\njoint j (a b) { type=hingeX }");
  const SceneSpec spec = read("Include='robots/arm.ors'\nEdit body a { mass=2 }\nDelete joint j");
  EXPECT_EQ(spec.bodies[0].mass, 2);
  EXPECT_TRUE(spec.joints.empty());
}

TEST_F(OrsInclude, EditsJointsWithoutAName) {
  write("arm.ors", "body a {}\nbody b {}\nbody c {}\njoint (a b) {}\njoint (b c) {}");
  const SceneSpec spec =
      read("Include='arm.ors'\nEdit joint (b c) { limits=[-1 1] }\nEdit joint a>b { q=1 }");
  EXPECT_EQ(spec.joints.at(0).q0[0], 1);
  EXPECT_EQ(spec.joints.at(1).name, "b>c");
  EXPECT_EQ(spec.joints.at(1).upper[0], 1);
}

TEST_F(OrsInclude, FindsMeshesBesideTheFileThatNamesThem) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  write("parts/meshes/a.obj", triangle);
  write("../meshes/b.obj", triangle);
  write("parts/plate.ors",
        "shape { type=3 mesh='meshes/a.obj' }\nChDir='../../meshes'\nshape { type=3 mesh='b.obj' }");
  const SceneSpec spec = read("Include='parts/plate.ors'\nshape { type=3 mesh='parts/meshes/a.obj' }");
  ASSERT_EQ(spec.worldShapes.size(), 3u);
  EXPECT_EQ(spec.worldShapes[0].meshFile, "parts/meshes/a.obj");
  EXPECT_EQ(spec.worldShapes[1].meshFile, "../meshes/b.obj");
  EXPECT_EQ(spec.worldShapes[2].meshFile, "parts/meshes/a.obj");  // ChDir counts for its own file
  for (const ShapeSpec& shape : spec.worldShapes) EXPECT_EQ(shape.shape.mesh.triangles().size(), 1u);
}

TEST_F(OrsInclude, FindsMeshesBesideAFileWithAnAddress) {
  write("parts/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("parts/plate.ors", "shape { type=3 mesh='a.obj' }");
  const auto mesh = [&](const std::string& text) { return read(text).worldShapes.at(0).meshFile; };
  EXPECT_EQ(mesh("Include='package://parts/plate.ors'"), "parts/a.obj");
  EXPECT_EQ(mesh("Include='file://" + fs::absolute(path("parts/plate.ors")).string() + "'"), "parts/a.obj");
  EXPECT_EQ(mesh("ChDir='package://parts'\nInclude='plate.ors'"), "parts/a.obj");
  EXPECT_EQ(mesh("ChDir='package://parts'\nshape { type=3 mesh='a.obj' }"), "package://parts/a.obj");
  EXPECT_TRUE(readOrs(path("main.ors")).notes.empty());
}

TEST_F(OrsInclude, SaysWhichFileIsWrong) {
  write("bad.ors", "body a {\n  mass=heavy }");
  EXPECT_REX_ERROR(
      read("Include='bad.ors'"),
      path("bad.ors").string() + ":2:8: body 'a': attribute 'mass': found 'heavy', wanted a number");
  write("open.ors", "body a {");
  EXPECT_REX_ERROR(read("Include='open.ors'\n}"), "open.ors:1:8: '{' is never closed");
  write("closing.ors", "body a {} }");
  EXPECT_REX_ERROR(read("body b { Include='closing.ors' }"), "closing.ors:1:11: unmatched '}'");
  EXPECT_REX_ERROR(read("body a {}\nInclude='bat.ors'"),
                   "main.ors:2:9: Include 'bat.ors': found no file 'bat.ors', wanted " +
                       path("bat.ors").string() + " (did you mean 'bad.ors'?)");
  EXPECT_REX_ERROR(read("body a {\n type=3\n mesh='no.obj' }"),
                   "main.ors:3:7: shape 'a': mesh: found no file");
  EXPECT_REX_ERROR(read("Include=bad.ors"), "main.ors:1:9: Include: found 'bad.ors', wanted Include='FILE'");
  EXPECT_REX_ERROR(parseOrs("\nInclude='bad.ors'", "f"),
                   "f:2:9: Include 'bad.ors': found a scene that was given as text, wanted no Include: only "
                   "scenes in files include others");
}

TEST_F(OrsInclude, StaysInsideTheAssetRoot) {
  write("../robots/arm.ors", "body arm {}");
  EXPECT_EQ(read("Include='../robots/arm.ors'").bodies.size(), 1u);
  write("main.ors", "Include='../robots/arm.ors'");
  EXPECT_REX_ERROR(
      readOrs(path("main.ors"), {.assetRoot = path("")}),
      "main.ors:1:9: Include '../robots/arm.ors': found '../robots/arm.ors', wanted a file inside the "
      "asset root");
  EXPECT_REX_ERROR(read("Include='/etc/passwd'"), "wanted a file inside the asset root");
}

TEST_F(OrsInclude, EndsAtLoopsAndTooManyFiles) {
  EXPECT_REX_ERROR(
      read("Include='main.ors'"),
      "main.ors:1:9: Include 'main.ors': found a file that includes itself, wanted another file");
  write("a.ors", "Include='b.ors'");
  write("b.ors", "Include='./a.ors'");
  EXPECT_REX_ERROR(read("Include='a.ors'"),
                   "b.ors:1:9: Include './a.ors': found a file that includes itself");
  for (int i = 1; i <= 17; ++i)
    write("n" + std::to_string(i) + ".ors", "Include='n" + std::to_string(i + 1) + ".ors'");
  write("n17.ors", "body a {}");
  EXPECT_EQ(read("Include='n2.ors'").bodies.size(), 1u);
  EXPECT_REX_ERROR(read("Include='n1.ors'"),
                   "n16.ors:1:9: Include 'n17.ors': found level 17, wanted at most 16");
  write("large.ors", "body a {}");
  fs::resize_file(path("large.ors"), 17u << 20);
  std::ofstream(path("large.ors"), std::ios::in | std::ios::out) << "#";
  EXPECT_REX_ERROR(read("Include='large.ors'\nInclude='large.ors'"),
                   "main.ors:2:9: Include 'large.ors': found 35651623 bytes in all, wanted at most 32 MiB");
}

}  // namespace rex::ors_include_test
