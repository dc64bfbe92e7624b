// What is said about published files, against what it was: REX_UPDATE_GOLDEN=1 writes it anew.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "formats/scene_file.h"
#include "support/file_text.h"
#include "support/paths.h"

namespace rex::warnings_test {

namespace fs = std::filesystem;

std::vector<fs::path> publishedFiles() {
  std::vector<fs::path> files;
  for (const char* folder : {"data/urdf", "data/mjcf"})
    if (fs::is_directory(sharedPath(folder)))
      for (const auto& entry : fs::directory_iterator(sharedPath(folder)))
        if (entry.path().extension() == ".urdf" || entry.path().extension() == ".xml")
          files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

TEST(Warnings, OfPublishedFilesAreTheGoldenOnes) {
  const std::vector<fs::path> files = publishedFiles();
  if (files.empty()) GTEST_SKIP() << "no files in ../shared/data/urdf and ../shared/data/mjcf";
  std::string said;
  for (const fs::path& file : files) {
    said += file.filename().string() + "\n";
    try {
      for (const auto& note : parseScene(fileText(file), file.filename()).notes)
        said += "  " + toString(note) + "\n";
    } catch (const Error& error) {
      said += std::string("  refused: ") + error.what() + "\n";
    }
  }
  const fs::path golden = sourcePath("tests/golden/warnings.txt");
  if (std::getenv("REX_UPDATE_GOLDEN") != nullptr) std::ofstream(golden) << said;
  EXPECT_EQ(said, fileText(golden));
}

}  // namespace rex::warnings_test
