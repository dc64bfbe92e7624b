#include "formats/assets.h"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::assets_test {

namespace fs = std::filesystem;

const SourceLocation kHere{"arm.urdf", 3, 7};

// top/secret.stl, top/arm_description/{urdf/arm.urdf, meshes/link.stl}, top/hand/meshes/palm.stl
class AssetsOfAnArm : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"arm_description/urdf", "arm_description/meshes", "hand/meshes"})
      fs::create_directories(top() / folder);
    for (const char* file : {"secret.stl", "arm_description/meshes/link.stl", "hand/meshes/palm.stl"})
      std::ofstream(top() / file) << "solid";
  }
  fs::path top() const { return folder_.path(); }
  fs::path arm() const { return top() / "arm_description/urdf/arm.urdf"; }
  fs::path link() const { return top() / "arm_description/meshes/link.stl"; }

  TemporaryFolder folder_;
};

TEST_F(AssetsOfAnArm, AreFoundBesideTheirScene) {
  const Assets assets(arm());
  EXPECT_EQ(assets.find("../meshes/link.stl", kHere, "mesh"), link());
  EXPECT_TRUE(
      fs::equivalent(assets.find("package://arm_description/meshes/link.stl", kHere, "mesh"), link()));
  EXPECT_TRUE(fs::equivalent(assets.find("package://any/meshes/link.stl", kHere, "mesh"), link()))
      << "the root stands for packages of other names";
  EXPECT_EQ(assets.find("file://" + link().string(), kHere, "mesh"), link());
}

TEST_F(AssetsOfAnArm, MayBeNamedWithoutTheirPackage) {
  EXPECT_TRUE(namesNoPackage("package:///meshes/link.stl"));
  EXPECT_FALSE(namesNoPackage("package://arm/meshes/link.stl") || namesNoPackage("/meshes/link.stl"));
  EXPECT_EQ(Assets(arm(), {}, true).find("package:///meshes/link.stl", kHere, "mesh"), link());
  EXPECT_EQ(Assets(arm(), top(), true).find("package:///hand/meshes/palm.stl", kHere, "mesh"),
            top() / "hand/meshes/palm.stl");
  EXPECT_REX_ERROR(Assets(arm()).find("package:///meshes/link.stl", kHere, "mesh"),
                   "arm.urdf:3:7: mesh: found 'package:///meshes/link.stl', wanted package://PACKAGE/PATH");
  EXPECT_REX_ERROR(Assets(arm(), {}, true).find("package:////etc/passwd", kHere, "mesh"),
                   "wanted a file inside the asset root ");
  EXPECT_REX_ERROR(Assets(arm(), {}, true).find("package:///", kHere, "mesh"),
                   "wanted package://PACKAGE/PATH");
}

TEST_F(AssetsOfAnArm, MayComeFromOtherPackagesInAWiderRoot) {
  const Assets assets(arm(), top());
  EXPECT_TRUE(fs::equivalent(assets.find("package://hand/meshes/palm.stl", kHere, "mesh"),
                             top() / "hand/meshes/palm.stl"));
  EXPECT_EQ(assets.find("../../secret.stl", kHere, "mesh"), top() / "secret.stl");
}

// As in a collection of robots, whose packages lie above those of one of them.
TEST_F(AssetsOfAnArm, MayComeFromAPackageAboveTheirRoot) {
  fs::create_directories(top() / "arm_description/robots/six");
  const fs::path six = top() / "arm_description/robots/six/six.urdf";
  const std::string palm = "package://hand/meshes/palm.stl",
                    link = "package://arm_description/meshes/link.stl";
  EXPECT_EQ(Assets(six).find(palm, kHere, "mesh"), top() / "hand/meshes/palm.stl");
  EXPECT_EQ(Assets(six).find(link, kHere, "mesh"), this->link());
  EXPECT_REX_ERROR(Assets(six, six.parent_path()).find(palm, kHere, "mesh"), "no file");
  EXPECT_REX_ERROR(Assets(six).find("package://meshes/../secret.stl", kHere, "mesh"), "mesh: found");
  // Two of them are not guessed between.
  fs::create_directories(top() / "arm_description/hand/meshes");
  std::ofstream(top() / "arm_description/hand/meshes/palm.stl") << "another";
  EXPECT_REX_ERROR(Assets(six).find(palm, kHere, "mesh"),
                   "no file '" + palm + "', wanted one of its packages: --assets " +
                       (top() / "arm_description").string() + " or --assets " + top().string());
}

TEST_F(AssetsOfAnArm, SayWhichRootHasAFile) {
  EXPECT_REX_ERROR(Assets(arm()).find("../../secret.stl", kHere, "mesh"),
                   "wanted a file inside the asset root " + (top() / "arm_description").string() +
                       "; --assets " + top().string() + " has it");
}

TEST_F(AssetsOfAnArm, StayInsideTheirRoot) {
  const Assets assets(arm());
  fs::create_symlink(top() / "secret.stl", top() / "arm_description/meshes/way_out.stl");
  for (const std::string& name :
       {std::string("../../secret.stl"), (top() / "secret.stl").string(),
        std::string("../meshes/way_out.stl"), std::string("package://arm_description/../../../secret.stl"),
        std::string("/etc/passwd")}) {
    EXPECT_REX_ERROR(assets.find(name, kHere, "mesh"),
                     "arm.urdf:3:7: mesh: found '" + name + "', wanted a file inside the asset root ");
  }
}

// Where a folder is a link, ".." leads to the folder above its target: what is judged must be what is read.
TEST_F(AssetsOfAnArm, StayInsideTheirRootBehindLinksOfFolders) {
  fs::create_directories(top() / "arm_description/real/deep");
  fs::create_directory_symlink("../real/deep", top() / "arm_description/urdf/link");
  std::ofstream(top() / "arm_description/real/palm.stl") << "of the target";
  std::ofstream(top() / "arm_description/urdf/palm.stl") << "beside the link";
  EXPECT_EQ(Assets(arm()).find("link/../palm.stl", kHere, "mesh"), top() / "arm_description/real/palm.stl");
  const Assets narrow(arm(), top() / "arm_description/urdf");
  EXPECT_REX_ERROR(narrow.find("link/../palm.stl", kHere, "mesh"),
                   "mesh: found 'link/../palm.stl', wanted a file inside the asset root " +
                       (top() / "arm_description/urdf").string());
}

TEST_F(AssetsOfAnArm, MustBeFilesThatCanBeRead) {
  const auto place = [&](const char* name) { return (top() / "arm_description/urdf" / name).string(); };
  fs::create_directory(place("folder"));
  ASSERT_EQ(::mkfifo(place("pipe").c_str(), 0600), 0);
  EXPECT_REX_ERROR(Assets(arm()).find("folder", kHere, "mesh"),
                   "arm.urdf:3:7: mesh: found a folder: " + place("folder") + ", wanted a file");
  EXPECT_REX_ERROR(Assets(arm()).find("pipe", kHere, "mesh"),
                   "arm.urdf:3:7: mesh: found a pipe or device: " + place("pipe") + ", wanted a file");
}

TEST_F(AssetsOfAnArm, NeedARootThatIsAFolder) {
  for (const char* name : {"none", "secret.stl"}) {
    EXPECT_REX_ERROR(Assets(arm(), top() / name), "the folder of all assets: found no such folder: " +
                                                      (top() / name).string() + ", wanted a folder");
  }
}

TEST_F(AssetsOfAnArm, AreNotFetched) {
  EXPECT_REX_ERROR(Assets(arm()).find("http://example.org/a.stl", kHere, "mesh"),
                   "arm.urdf:3:7: mesh: found 'http://example.org/a.stl', wanted a file: nothing is fetched");
  EXPECT_REX_ERROR(Assets(arm()).find("package://arm", kHere, "mesh"),
                   "arm.urdf:3:7: mesh: found 'package://arm', wanted package://PACKAGE/PATH");
}

TEST_F(AssetsOfAnArm, ThatAreMissingAreListedWithAllPathsTried) {
  EXPECT_REX_ERROR(
      Assets(arm()).find("package://arm_description/meshes/lnik.stl", kHere, "link 'a': mesh"),
      "link 'a': mesh: found no file 'package://arm_description/meshes/lnik.stl', wanted one of");
  EXPECT_REX_ERROR(Assets(arm()).find("package://arm_description/meshes/lnik.stl", kHere, "mesh"),
                   (top() / "arm_description/meshes/lnik.stl").string());
  EXPECT_REX_ERROR(Assets(arm()).find("../meshes/lnik.stl", kHere, "mesh"),
                   "mesh: found no file '../meshes/lnik.stl', wanted " +
                       (top() / "arm_description/meshes/lnik.stl").string() + " (did you mean 'link.stl'?)");
}

}  // namespace rex::assets_test
