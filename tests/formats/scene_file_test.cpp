#include "formats/scene_file.h"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::scene_file_test {

namespace fs = std::filesystem;

class SceneFileTest : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    const fs::path path = folder_.path() / name;
    std::ofstream(path) << text;
    return path.string();
  }
  TemporaryFolder folder_;
};

// Has no rights of its own while it lives, not even those of root.
class AsNobody {
 public:
  AsNobody() {
    if (before_ == 0) {
      EXPECT_EQ(::seteuid(65534), 0);
    }
  }
  ~AsNobody() { EXPECT_EQ(::seteuid(before_), 0); }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  const uid_t before_ = ::geteuid();
};

TEST_F(SceneFileTest, IsReadByItsEnding) {
  for (const char* name : {"a.ors", "a.ORS"})
    EXPECT_EQ(readScene(file(name, "body a {}")).spec.bodies.at(0).name, "a");
  for (const char* name : {"a.urdf", "a.URDF"})
    EXPECT_EQ(readScene(file(name, "<robot name='r'><link name='a'/></robot>")).spec.bodies.at(0).name, "a");
  EXPECT_EQ(parseScene("<robot name='r'><link name='a'/></robot>", "a.Urdf").spec.bodies.at(0).name, "a");
  const std::string model = "<mujoco><worldbody><body name='a'/></worldbody></mujoco>";
  for (const char* name : {"a.xml", "a.XML"})
    EXPECT_EQ(readScene(file(name, model)).spec.bodies.at(0).name, "a");
  EXPECT_EQ(parseScene(model, "a.xml").spec.bodies.at(0).name, "a");
  EXPECT_EQ(parseScene("body a {}", "text").spec.bodies.at(0).name, "a");
}

TEST_F(SceneFileTest, NeedsAnEndingThatIsKnown) {
  EXPECT_REX_ERROR(readScene("a.urd"),
                   "a.urd: not a scene that rex reads: found '.urd', wanted .ors, .urdf or .xml (MuJoCo) "
                   "(did you mean '.urdf'");
  EXPECT_REX_ERROR(readScene("a"),
                   "a: not a scene that rex reads: found no ending, wanted .ors, .urdf or .xml");
  const std::string xacro =
      "a.urdf.xacro: this is xacro, not yet URDF: wanted plain URDF: run 'xacro FILE > robot.urdf' and read "
      "that";
  EXPECT_REX_ERROR(readScene("a.urdf.xacro"), xacro);
  EXPECT_REX_ERROR(parseScene("", "a.urdf.xacro"), xacro);
}

TEST_F(SceneFileTest, IsAFileThatCanBeRead) {
  const std::string pipe = (folder_.path() / "pipe.ors").string(), secret = file("secret.ors", "body a {}");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto message = [](const std::string& path, const std::string& found) {
    return path + ": cannot read the scene file: found " + found + ", wanted an .ors, .urdf or .xml file";
  };
  EXPECT_REX_ERROR(readScene(pipe), message(pipe, "a pipe or device"));
  EXPECT_REX_ERROR(readSceneText(folder_.path()), message(folder_.path().string(), "a folder"));
  EXPECT_REX_ERROR(readSceneText(folder_.path() / "secert.ors"),
                   "found no such file, wanted an .ors, .urdf or .xml file (did you mean 'secret.ors'?)");
  fs::permissions(folder_.path(), fs::perms::all);
  fs::permissions(secret, fs::perms::none);
  const AsNobody nobody;
  EXPECT_REX_ERROR(readScene(secret), message(secret, "no permission to read it"));
}

TEST_F(SceneFileTest, HasALargestSize) {
  EXPECT_EQ(readSceneText(file("a.ors", "1234"), 4), "1234");
  EXPECT_REX_ERROR(readSceneText(file("a.ors", std::string((1u << 20) + 1, ' ')), 1u << 20),
                   "a.ors: scene file too large: found 1048577 bytes, wanted at most 1 MiB");
}

TEST(SceneNotes, AreGroupedByWhatTheySay) {
  const Diagnostics all = {{{"a", 1}, "joint 'x': limit of -0.5 rad", Severity::kWarning},
                           {{"a", 2}, "joint 'y': it's 3 long"},
                           {{"a", 3}, "joint 'z 2': limit of 1e-5 rad", Severity::kWarning},
                           {{"a", 4}, "joint 'x': limit of 1 rad"},
                           {{"a", 5}, "joint 'w': limit of 7 rad", Severity::kWarning}};
  const Diagnostics few = grouped(all);
  ASSERT_EQ(few.size(), 3u);
  EXPECT_EQ(toString(few[0]), "a:1: warning: joint 'x': limit of -0.5 rad (and 2 more like this)");
  EXPECT_EQ(toString(few[1]), toString(all[1]));
  EXPECT_EQ(toString(few[2]), toString(all[3])) << "a note is no warning";
}

}  // namespace rex::scene_file_test
