#include <string>

#include "formats/ors_reader.h"
#include "fuzz/require.h"
#include "fuzz/sound_scene.h"
#include "geometry/rotation.h"

// The input is the text of a pose, <T ...>.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = "body b { X=" + std::string(reinterpret_cast<const char*>(data), size) + " }";
  try {
    for (const rex::BodySpec& body : rex::parseOrs(text, "scene.ors").spec.bodies) {
      rex::fuzz::require(rex::isRotation(body.X_WB.R), "a pose turns without stretching");
      rex::fuzz::require(body.X_WB.p.allFinite(), "a pose is finite");
    }
  } catch (const rex::Error& error) {
    rex::fuzz::requirePlace(error, text);
  }
  return 0;
}
