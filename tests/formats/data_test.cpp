// All scenes of the folder data: they load without a word of complaint, and are what their README files say.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "geometry/mesh_mass.h"
#include "scene/model.h"
#include "support/paths.h"

namespace rex::data_test {

namespace fs = std::filesystem;

struct Entry {
  std::string file;
  int nq = 0;
  double mass = 0;
};

void PrintTo(const Entry& entry, std::ostream* out) { *out << entry.file; }

const std::vector<Entry> kData = {{"robots/man.ors", 27, 13.06},
                                  {"robots/arm3.ors", 3, 3.5},
                                  {"robots/pegArm.ors", 3, 0.4},
                                  {"robots/pegArm2.ors", 7, 0.8},
                                  {"robots/pegInAHole.ors", 7, 0.8},
                                  {"robots/arm7.ors", 7, 8},
                                  {"robots/pin_balancing.ors", 8, 0.9},
                                  {"robots/arm7dof/arm7dof.urdf", 7, 19.2},
                                  {"robots/arm6dof/arm6dof.urdf", 6, 21.0489},
                                  {"robots/arm7offset/arm7offset.urdf", 7, 18},
                                  {"robots/balancer/balancer.urdf", 2, 7.6},
                                  {"robots/quadruped/quadruped.urdf", 12, 13.72},
                                  {"robots/humanoid/humanoid.urdf", 25, 53.9},
                                  {"robots/humanoid_hands/humanoid_hands.urdf", 55, 54.2628},
                                  {"robots/hand/hand.urdf", 15, 0.6314},
                                  {"robots/gripper/gripper.urdf", 1, 0.73},
                                  {"scenes/table.ors", 27, 13.06},
                                  {"scenes/pick.ors", 8, 18.73},
                                  {"scenes/board.ors", 3, 3.5},
                                  {"scenes/maze.ors", 3, 5},
                                  {"scenes/street.ors", 3, 1000}};

class Data : public testing::TestWithParam<Entry> {};

TEST_P(Data, LoadsAndIsWhatItsReadmeSays) {
  const SceneFile scene = readScene(sourcePath("data") / GetParam().file);
  for (const Diagnostic& note : scene.notes) EXPECT_EQ(note.severity, Severity::kNote) << toString(note);
  const Model model = compile(scene.spec);
  EXPECT_EQ(model.nq(), GetParam().nq);
  EXPECT_NEAR(model.mass(), GetParam().mass, 1e-6);
  for (const Body& body : model.bodies())
    EXPECT_EQ(inertiaFault(body.I_BBcm_B), InertiaFault::kNone) << body.name;
  for (const ModelShape& shape : model.shapes())
    EXPECT_EQ(shape.shape.mesh.isEmpty(), !usesMesh(shape.shape.type)) << shape.name;
}

INSTANTIATE_TEST_SUITE_P(OwnFiles, Data, testing::ValuesIn(kData),
                         [](const auto& i) { return fs::path(i.param.file).stem().string(); });

TEST(DataFolder, HasNoSceneThatNobodyTests) {
  std::vector<std::string> tested, found;
  for (const Entry& entry : kData) tested.push_back(entry.file);
  for (const auto& entry : fs::recursive_directory_iterator(sourcePath("data"))) {
    const fs::path& path = entry.path();
    if (path.extension() == ".ors" || path.extension() == ".urdf")
      found.push_back(fs::relative(path, sourcePath("data")).string());
  }
  std::sort(tested.begin(), tested.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(tested, found);
}

}  // namespace rex::data_test
