#include "fuzz/require.h"
#include "fuzz/sound_scene.h"
#include "geometry/rotation.h"
#include "scene/pose_text.h"

// The input is the text of a pose, <T ...>.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const rex::Pose pose = rex::parsePose(text, "pose");
    rex::fuzz::require(rex::isRotation(pose.R), "a pose turns without stretching");
    rex::fuzz::require(pose.p.allFinite(), "a pose is finite");
  } catch (const rex::Error& error) {
    rex::fuzz::requirePlace(error, text);
  }
  return 0;
}
