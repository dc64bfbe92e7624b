// The gallery in the documents is what the code draws.
#include "gallery/gallery.h"

#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "render/image.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"
#include "support/image_difference.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"
#include "support/paths.h"

namespace rex::gallery::gallery_test {

namespace fs = std::filesystem;

const fs::path kDocuments = homeFolder() / "share" / "doc";

TEST(Gallery, HasThePageThatTheCodeWrites) {
  EXPECT_EQ(fileText(kDocuments / "gallery.md"), page()) << "run scripts/gallery";
}

TEST(Gallery, ShowsWhatTheCodeDraws) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  const fs::path drawn = freshFolder("gallery");
  const FigureTolerance tolerance = figureTolerance();
  std::set<std::string> files;
  for (const std::string& name : drawAll(drawn)) {
    files.insert(name + ".png");
    SCOPED_TRACE(name + ": if the new picture is right, run scripts/gallery");
    const Image now = readPng(drawn / (name + ".png"));
    const Image shown = readPng(kDocuments / "gallery" / (name + ".png"));
    ASSERT_EQ(now.width, shown.width);
    ASSERT_EQ(now.height, shown.height);
    const ImageDifference apart = imageDifference(shown, now, 8);
    EXPECT_LE(apart.largeShare, tolerance.largeShare);
    EXPECT_LE(apart.mean, tolerance.mean);
    writePng(apart.picture, drawn / (name + "-difference.png"));
  }
  std::set<std::string> kept;
  for (const auto& entry : fs::directory_iterator(kDocuments / "gallery"))
    kept.insert(entry.path().filename().string());
  EXPECT_EQ(kept, files) << "run scripts/gallery";
}

}  // namespace rex::gallery::gallery_test
