#include "render/video.h"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "base/process.h"
#include "render/image.h"
#include "render/png.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

class VideoTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!runProcess({"ffmpeg", "-version"}).ok()) GTEST_SKIP() << "needs the package ffmpeg";
    fs::create_directories(frames());
    for (int i = 0; i < 10; ++i) {
      Image image(65, 49);  // odd, because H.264 cannot
      for (int y = 0; y < 49; ++y) image.pixel(6 * i, y)[0] = 255;
      writePng(image, frames() / ("000" + std::to_string(i) + ".png"));
    }
  }
  fs::path frames() const { return temporary_.path() / "100% frames"; }
  fs::path file(const std::string& name) const { return temporary_.path() / name; }
  static std::string bytes(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  TemporaryFolder temporary_;
};

TEST_F(VideoTest, HoldsEveryPicture) {
  ASSERT_TRUE(joinToVideo(frames(), file("a.mp4"), 5));
  const ProcessResult probe = runProcess({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                          "stream=nb_read_frames,width,height,avg_frame_rate", "-of",
                                          "csv=p=0", file("a.mp4").string()});
  EXPECT_EQ(probe.output, "64,48,5/1,10\n") << probe.error;
}

TEST_F(VideoTest, HasTheSameBytesTwice) {
  ASSERT_TRUE(joinToVideo(frames(), file("a.mp4")));
  ASSERT_TRUE(joinToVideo(frames(), file("b.mp4")));
  EXPECT_EQ(bytes(file("a.mp4")), bytes(file("b.mp4")));
}

TEST_F(VideoTest, SaysWhyItCannotBeMade) {
  EXPECT_REX_ERROR(joinToVideo(file("nowhere"), file("a.mp4")),
                   "nowhere: no pictures to join: wanted 0000.png, 0001.png, ...");
  std::ofstream(frames() / "0000.png") << "no picture";
  EXPECT_REX_ERROR(joinToVideo(frames(), file("a.mp4")), "a.mp4: cannot make the video: found ");
  EXPECT_FALSE(fs::exists(file("a.mp4")));
  EXPECT_EQ(std::distance(fs::directory_iterator(file("")), fs::directory_iterator()), 1)
      << "only the frames";
}

TEST_F(VideoTest, IsNotMadeWithoutFfmpeg) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const bool made = joinToVideo(frames(), file("a.mp4"));
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(made);
  EXPECT_FALSE(fs::exists(file("a.mp4")));
}

}  // namespace
}  // namespace rex
