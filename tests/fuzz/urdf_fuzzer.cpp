#include <optional>

#include "formats/urdf_reader.h"
#include "formats/urdf_writer.h"
#include "fuzz/require.h"
#include "fuzz/sound_scene.h"

namespace {

std::string writtenAgain(const rex::SceneSpec& spec) { return rex::writeUrdf(spec).text; }

rex::SceneSpec read(const std::string& text) { return rex::parseUrdf(text, "again.urdf").spec; }

}  // namespace

// The input is the text of a .urdf file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::optional<rex::SceneFile> scene;
  try {
    scene = rex::parseUrdf(text, "robot.urdf");
  } catch (const rex::Error& error) {
    rex::fuzz::requirePlace(error, text);
  }
  if (scene) rex::fuzz::requireSound(*scene, writtenAgain, read);
  return 0;
}
