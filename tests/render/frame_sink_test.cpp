#include "render/frame_sink.h"

#include <fstream>

#include <gtest/gtest.h>

#include "render/image.h"
#include "render/video_sink.h"
#include "support/changed_path.h"
#include "support/expect_error.h"
#include "support/folder_content.h"
#include "support/temporary_folder.h"
#include "support/test_frames.h"
#include "support/tiny_disk.h"

namespace rex::frame_sink_test {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

TEST(FrameSink, KeepsFramesInOrder) {
  MemorySink sink;
  for (int i = 0; i < 3; ++i) sink.add(movingSquare(32, 24, i));
  sink.finish();
  ASSERT_EQ(sink.frames().size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(sink.frames()[static_cast<std::size_t>(i)], movingSquare(32, 24, i));
}

TEST(FrameSink, RefusesWhatIsNoFilm) {
  MemorySink sink;
  EXPECT_REX_ERROR(sink.finish(), "frames in memory: a film without frames");
  EXPECT_REX_ERROR(sink.add(Image()), "size of frame 0: found 0 x 0, wanted at least 1 x 1 pixels");
  sink.add(Image(4, 3));
  EXPECT_REX_ERROR(sink.add(Image(3, 4)), "size of frame 1: found 3 x 4, wanted 4 x 3 as before");
  EXPECT_EQ(sink.frames().size(), 1u);
}

TEST(TeeSink, HandsFramesToAll) {
  std::vector<std::unique_ptr<FrameSink>> sinks;
  std::vector<const MemorySink*> seen;
  for (int k = 0; k < 2; ++k) {
    auto sink = std::make_unique<MemorySink>();
    seen.push_back(sink.get());
    sinks.push_back(std::move(sink));
  }
  TeeSink both(std::move(sinks));
  for (int i = 0; i < 2; ++i) both.add(movingSquare(32, 24, i));
  both.finish();
  for (const MemorySink* sink : seen)
    EXPECT_EQ(sink->frames(), (std::vector{movingSquare(32, 24, 0), movingSquare(32, 24, 1)}));
}

TEST(PngSequence, WritesNumberedFilesAndReplacesOlderOnes) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "a" / "film";
  fs::create_directories(folder);
  for (const char* name :
       {"0000.png", "0001.png", "0002.png", "0004.png", "2024.png", "12345.png", "end.png", "notes.txt"})
    std::ofstream(folder / name) << "old";
  const Names before = folderContent(folder);
  { const PngSequence unused(folder); }
  EXPECT_EQ(folderContent(folder), before);
  PngSequence sink(folder);
  for (int i = 0; i < 2; ++i) sink.add(movingSquare(32, 24, i));
  sink.finish();
  EXPECT_EQ(folderContent(folder),
            (Names{"0000.png", "0001.png", "0004.png", "12345.png", "2024.png", "end.png", "notes.txt"}));
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(readPng(folder / ("000" + std::to_string(i) + ".png")), movingSquare(32, 24, i));
}

TEST(PngSequence, SaysWhyItCannot) {
  const TemporaryFolder temporary;
  std::ofstream(temporary.path() / "file") << "x";
  const auto addTo = [](const fs::path& folder) { PngSequence(folder).add(movingSquare(32, 24, 0)); };
  EXPECT_REX_ERROR(addTo(temporary.path() / "file"), "file' for frames: found Not a directory");
  EXPECT_REX_ERROR(addTo(""), "cannot make the folder '' for frames: found Invalid argument");
  EXPECT_REX_ERROR(addTo(temporary.path() / std::string(300, 'x')),
                   "xxx' for frames: found File name too long");
  fs::create_symlink("loop", temporary.path() / "loop");
  EXPECT_REX_ERROR(addTo(temporary.path() / "loop"),
                   "loop' for frames: found Too many levels of symbolic links");
  fs::create_directories(temporary.path() / "film" / "0000.png");
  EXPECT_REX_ERROR(addTo(temporary.path() / "film"),
                   "film/0000.png' from an earlier film: found Is a directory");
}

TEST(PngSequence, LeavesNoHalfAFileOnAFullDisk) {
  const TinyDisk disk(16);
  REX_NEEDS_DISK(disk);
  Rng rng(1);
  PngSequence sink(disk.path());
  EXPECT_REX_ERROR(sink.add(noise(100, 100, rng)), "0000.png': found No space left on device");
  EXPECT_EQ(folderContent(disk.path()), Names());
}

TEST(MakeFrameSink, ChoosesByTheEnding) {
  const TemporaryFolder temporary;
  const MadeSink frames = makeFrameSink(temporary.path() / "film");
  EXPECT_NE(dynamic_cast<PngSequence*>(frames.sink.get()), nullptr);
  for (const char* name : {"a.avi", "a.png", "a."})
    EXPECT_REX_ERROR(makeFrameSink(temporary.path() / name),
                     std::string(name) + ": unknown kind of film: found '" +
                         fs::path(name).extension().string() +
                         "', wanted .mp4, .webm, .gif, or no ending for a folder of PNG frames");
  EXPECT_REX_ERROR(makeFrameSink("a.MP3"), "(did you mean '.mp4'?)");
}

TEST(MakeFrameSink, TellsWhatIsMissing) {
  const TemporaryFolder temporary;
  const fs::path file = temporary.path() / "a.webm";
  {
    const ChangedPath nowhere;
    const MadeSink made = makeFrameSink(file);
    EXPECT_EQ(made.sink, nullptr);
    EXPECT_EQ(made.missing,
              file.string() + " is missing because ffmpeg is not installed (apt-get install ffmpeg)");
  }
  for (const auto& [script, cause] :
       {std::pair{"echo 'no libx264.so' >&2; echo more >&2; exit 127", "no libx264.so"},
        {"exit 3", "exit code 3"},
        {"kill -9 $$", "signal 9"}}) {
    writeProgram(temporary.path() / "ffmpeg", script);
    const ChangedPath broken(temporary.path());
    EXPECT_EQ(makeFrameSink(file).missing,
              file.string() + " is missing because ffmpeg does not work: " + cause);
  }
  writeProgram(temporary.path() / "ffmpeg", "echo \"Codec '$5' is not recognized by FFmpeg.\" >&2");
  const ChangedPath first(temporary.path());
  const MadeSink made = makeFrameSink(file);
  EXPECT_EQ(made.sink, nullptr);
  EXPECT_EQ(made.missing, file.string() +
                              " is missing because this ffmpeg has no encoder libvpx-vp9 (the one from "
                              "apt-get install ffmpeg has it)");
  EXPECT_EQ(folderContent(temporary.path()), Names{"ffmpeg"});
}

}  // namespace rex::frame_sink_test
