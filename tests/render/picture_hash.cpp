// picture_hash BACKEND: draws with every anti-aliasing, and depth and segmentation, and prints a hash of it
// all.
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "support/varied_picture.h"

namespace {

class Hash {  // FNV-1a
 public:
  template <typename T>
  void add(const std::vector<T>& values) {
    std::vector<unsigned char> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    for (const unsigned char byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace

int main(int, char** argv) try {
  using namespace rex;
  const Picture picture = variedPicture();
  const Camera camera = framing(bounds(picture), kDefaultView, 4. / 3);
  Hash hash;
  for (const AntiAliasing smooth : {AntiAliasing::kNone, AntiAliasing::kFxaa, AntiAliasing::kMsaa4}) {
    Renderer renderer(
        {.width = 320, .height = 240, .antiAliasing = smooth, .gl = {.backend = glBackendFromName(argv[1])}});
    hash.add(renderer.draw(picture, camera).rgb);
    hash.add(renderer.drawDepth(picture, camera).metres);
    hash.add(renderer.drawSegmentation(picture, camera).id);
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
  return 0;
} catch (const rex::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
