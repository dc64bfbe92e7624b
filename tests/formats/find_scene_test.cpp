#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "formats/assets.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::find_scene_test {

namespace fs = std::filesystem;

// library/robots/{man.ors, dog/dog.urdf}, library/scenes/hall.ors, here/own.urdf
class FindScene : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"library/robots/dog", "library/scenes", "here"})
      fs::create_directories(folder_.path() / folder);
    for (const char* file : {"library/robots/man.ors", "library/robots/dog/dog.urdf",
                             "library/scenes/hall.ors", "here/own.urdf"})
      std::ofstream(folder_.path() / file) << "";
  }
  fs::path library() const { return folder_.path() / "library"; }
  std::string here(const char* name) const { return (folder_.path() / "here" / name).string(); }
  fs::path find(const std::string& scene) const { return findScene(scene, library()); }

  TemporaryFolder folder_;
};

TEST_F(FindScene, TakesFilesAndNamesOfTheCourse) {
  EXPECT_EQ(find(here("own.urdf")), here("own.urdf"));
  for (const char* name : {"man", "man.ors", "man.ORS"}) EXPECT_EQ(find(name), library() / "robots/man.ors");
  EXPECT_EQ(find("dog.URDF"), library() / "robots/dog/dog.urdf");
  EXPECT_EQ(find("hall"), library() / "scenes/hall.ors");
}

TEST_F(FindScene, ListsTheScenesOfTheCourseForNames) {
  EXPECT_REX_ERROR(
      find("mann"),
      "there is no scene 'mann': wanted an .ors, .urdf or .xml file, or one of the course: dog.urdf, "
      "man.ors, hall.ors (did you mean 'man'?)");
  EXPECT_REX_ERROR(find(""),
                   "there is no scene '': wanted an .ors, .urdf or .xml file, or one of the course");
}

TEST_F(FindScene, LooksBesidePaths) {
  EXPECT_REX_ERROR(find(here("onw.urdf")),
                   "there is no scene '" + here("onw.urdf") +
                       "': wanted an .ors, .urdf or .xml file (did you mean 'own.urdf'?)");
}

TEST_F(FindScene, SaysWhatIsNoFile) {
  ASSERT_EQ(::mkfifo(here("pipe.ors").c_str(), 0600), 0);
  EXPECT_REX_ERROR(find(here(".")), "cannot read the scene '" + here(".") +
                                        "': found a folder, wanted an .ors, .urdf or .xml file");
  EXPECT_REX_ERROR(find(here("pipe.ors")), "': found a pipe or device, wanted an .ors, .urdf or .xml file");
}

}  // namespace rex::find_scene_test
