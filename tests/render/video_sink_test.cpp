#include "render/video_sink.h"

#include <cerrno>
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interruption.h"
#include "base/process.h"
#include "support/changed_path.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/folder_content.h"
#include "support/image_difference.h"
#include "support/temporary_folder.h"
#include "support/test_frames.h"
#include "support/tiny_disk.h"

namespace rex::video_sink_test {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

// Every test ends without a child, running or not yet waited for.
class VideoSinkTest : public testing::Test {
 protected:
  void TearDown() override {
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
  }
  fs::path folder() const { return temporary_.path(); }
  fs::path file(const std::string& name) const { return temporary_.path() / name; }
  // A sink whose ffmpeg is this shell script.
  VideoSink fake(const std::string& script, double patience = 600) const {
    writeProgram(file("ffmpeg"), script);
    return VideoSink(file("a.mp4"), {.patience = patience});
  }
  // Adds frames until the sink complains, or finishes.
  static void feed(FrameSink& sink, int frames = 20) {
    for (int i = 0; i < frames; ++i) sink.add(movingSquare(192, 96, i));
    sink.finish();
  }

 private:
  TemporaryFolder temporary_;
};

class RealVideoSinkTest : public VideoSinkTest {
 protected:
  void SetUp() override {
    if (!missingForVideo("a.mp4").empty()) GTEST_SKIP() << "needs the Debian package ffmpeg";
  }
};

// What ffmpeg decodes, as a second opinion on what was put in.
std::vector<Image> decode(const fs::path& file, int width, int height) {
  const ProcessResult raw = runProcess(
      {"ffmpeg", "-v", "error", "-i", file.string(), "-f", "rawvideo", "-pix_fmt", "rgb24", "pipe:1"},
      {.outputLimit = 64u << 20});
  EXPECT_TRUE(raw.ok()) << raw.error;
  std::vector<Image> frames;
  const std::size_t size = Image(width, height).rgb.size();
  EXPECT_EQ(raw.output.size() % size, 0u);
  for (std::size_t at = 0; at + size <= raw.output.size(); at += size) {
    frames.emplace_back(width, height);
    std::copy_n(raw.output.begin() + static_cast<std::ptrdiff_t>(at), size, frames.back().rgb.begin());
  }
  return frames;
}

TEST_F(RealVideoSinkTest, HoldsEveryFrameInItsPlaceAndColour) {
  for (const char* name : {"a: 100% b.mp4", "a.webm", "a.gif"}) {
    SCOPED_TRACE(name);
    VideoSink sink(file(name));
    feed(sink);
    const std::vector<Image> decoded = decode(file(name), 192, 96);
    ASSERT_EQ(decoded.size(), 20u);
    for (int i = 0; i < 20; ++i) {
      const auto error = [&](int other) {
        return imageDifference(decoded[static_cast<std::size_t>(i)], movingSquare(192, 96, other), 40);
      };
      EXPECT_LT(error(i).mean, 4);
      EXPECT_LT(error(i).largeShare, 0.02);
      EXPECT_LT(error(i).mean, error(i + 1).mean);
      EXPECT_LT(error(i).mean, error(i - 1).mean);
    }
  }
}

TEST_F(RealVideoSinkTest, HasItsRateAndDurationAndAnEvenSize) {
  for (const char* name : {"a.mp4", "a.webm"}) {
    VideoSink sink(file(name), {.rate = 5});
    for (int i = 0; i < 10; ++i) sink.add(movingSquare(65, 49, i));
    sink.finish();
    const ProcessResult probe =
        runProcess({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                    "stream=nb_read_frames,width,height,avg_frame_rate:format=duration", "-of", "csv=p=0",
                    file(name).string()});
    EXPECT_EQ(probe.output, "64,48,5/1,10\n2.000000\n") << probe.error;
  }
  VideoSink gif(file("a.gif"), {.rate = 5});
  for (int i = 0; i < 10; ++i) gif.add(movingSquare(65, 49, i));
  gif.finish();
  EXPECT_EQ(decode(file("a.gif"), 65, 49).size(), 10u) << "and a GIF may be odd";
}

TEST_F(RealVideoSinkTest, HasTheSameBytesTwice) {
  for (const std::string ending : {".mp4", ".webm", ".gif"}) {
    for (const std::string name : {"a", "b"}) {
      VideoSink sink(file(name + ending));
      feed(sink);
    }
    EXPECT_GT(fileText(file("a" + ending)).size(), 1000u);
    EXPECT_EQ(fileText(file("a" + ending)), fileText(file("b" + ending))) << ending;
  }
}

TEST_F(RealVideoSinkTest, ReplacesAnOlderFileOnlyWhenComplete) {
  std::ofstream(file("a.mp4")) << "old";
  {
    VideoSink sink(file("a.mp4"));
    for (int i = 0; i < 5; ++i) sink.add(movingSquare(192, 96, i));
  }
  EXPECT_EQ(fileText(file("a.mp4")), "old");
  VideoSink sink(file("a.mp4"));
  feed(sink);
  EXPECT_GT(fs::file_size(file("a.mp4")), 1000u);
  EXPECT_EQ(folderContent(folder()), Names{"a.mp4"});
}

TEST_F(RealVideoSinkTest, LeavesNothingOnAFullDisk) {
  for (const int kilobytes : {4, 64}) {
    const TinyDisk disk(kilobytes);
    REX_NEEDS_DISK(disk);
    for (const char* name : {"a.mp4", "a.webm", "a.gif"}) {
      {
        VideoSink sink(disk.path() / name);
        const auto feedNoise = [&] {
          Rng rng(1);
          for (int i = 0; i < 100; ++i) sink.add(noise(64, 48, rng));
          sink.finish();
        };
        EXPECT_REX_ERROR((feedNoise(), 0), std::string(name) + ": cannot make the video: found ");
        EXPECT_REX_ERROR((sink.finish(), 0), "No space left on device");
      }
      EXPECT_EQ(folderContent(disk.path()), Names());
    }
  }
}

TEST_F(VideoSinkTest, RefusesWhatCannotBeAVideo) {
  EXPECT_REX_ERROR(VideoSink(file("a.avi")), "unknown kind of film: found '.avi', wanted .mp4, .webm, .gif");
  EXPECT_REX_ERROR(missingForVideo("a"), "a: unknown kind of film: found ''");
  EXPECT_REX_ERROR(VideoSink(file("a.mp4"), {.rate = 0}), "frames per second: found 0, wanted 1 to 1000");
  for (const double patience : {0., -1., std::nan(""), HUGE_VAL})
    EXPECT_REX_ERROR(VideoSink(file("a.mp4"), {.patience = patience}), "a.mp4: patience with ffmpeg: found ");
  EXPECT_REX_ERROR(VideoSink(file("no/a.mp4")), "no/a.mp4': found No such file or directory");
  {
    VideoSink sink(file("a.MP4"));
    EXPECT_REX_ERROR(sink.add(Image(1, 8)),
                     "a.MP4: size of the frames of a video: found 1 x 8, wanted at least 2 x 2 pixels");
    EXPECT_REX_ERROR(sink.finish(), "a.MP4: a film without frames");
  }
  EXPECT_EQ(folderContent(folder()), Names());
}

TEST_F(VideoSinkTest, SaysHowFfmpegEnded) {
  const ChangedPath first(folder());
  const std::vector<std::array<std::string, 2>> endings{
      {"head -c 100000 >/dev/null; echo boom >&2; echo and more >&2; exit 3",
       "cannot make the video: found boom"},
      {"head -c 100000 >/dev/null; exit 3", "found ffmpeg ended with exit code 3"},
      {"head -c 100000 >/dev/null", "found ffmpeg ended before the last frame"},
      {"cat >/dev/null; kill -9 $$", "found ffmpeg was ended by signal 9"}};
  for (const auto& [script, message] : endings) {
    {
      VideoSink sink = fake(script);
      EXPECT_REX_ERROR(feed(sink), message);
    }
    EXPECT_EQ(folderContent(folder()), Names{"ffmpeg"});
  }
}

TEST_F(VideoSinkTest, GivesUpAnFfmpegThatHangs) {
  const ChangedPath first(folder());
  for (const char* script : {"sleep 600 & sleep 600", "cat >/dev/null; sleep 600"}) {
    {
      VideoSink sink = fake(script, 0.3);
      EXPECT_REX_ERROR(feed(sink), "ffmpeg made no progress for 0.3 s");
    }
    EXPECT_EQ(folderContent(folder()), Names{"ffmpeg"});
  }
}

TEST_F(VideoSinkTest, EndsAnFfmpegThatHangsWhenItDiesUnfinished) {
  const ChangedPath first(folder());
  {
    VideoSink sink = fake("sleep 600 & sleep 600");
    for (int i = 0; i < 3; ++i) sink.add(movingSquare(192, 96, i));
  }
  EXPECT_EQ(folderContent(folder()), Names{"ffmpeg"});
}

TEST_F(VideoSinkTest, SaysThatFfmpegIsMissing) {
  {
    const ChangedPath nowhere;
    VideoSink sink(file("a.mp4"));
    EXPECT_REX_ERROR(feed(sink), "found cannot start ffmpeg: No such file or directory");
  }
  EXPECT_EQ(folderContent(folder()), Names());
}

TEST_F(VideoSinkTest, StopsForAHeldSignal) {
  const ChangedPath first(folder());
  const HeldSignals held;
  {
    VideoSink sink = fake("kill -TERM $PPID; exec sleep 600");
    EXPECT_THROW(feed(sink), Interrupted);
  }
  EXPECT_EQ(folderContent(folder()), Names{"ffmpeg"});
}

}  // namespace rex::video_sink_test
