// A library that looks like EGL. The function that REX_BROKEN_EGL names fails; without a name all work, and
// the renderer is a graphics card.
#include <cstdlib>
#include <cstring>

namespace {

bool works(const char* function) {
  const char* broken = std::getenv("REX_BROKEN_EGL");
  return broken == nullptr || std::strcmp(broken, function) != 0;
}

int thing = 0;
const unsigned char* rendererName(unsigned) {
  return reinterpret_cast<const unsigned char*>(works("card") ? "Graphics Card 9" : "llvmpipe");
}

}  // namespace

extern "C" {
void* eglGetPlatformDisplay(unsigned, void*, const long*) {
  return works("eglGetPlatformDisplay") ? &thing : nullptr;
}
unsigned eglInitialize(void*, int*, int*) {
  // What Mesa would see when it chooses a driver.
  const char* software = std::getenv("LIBGL_ALWAYS_SOFTWARE");
  return works("eglInitialize") && (works("software") || software != nullptr) ? 1 : 0;
}
unsigned eglBindAPI(unsigned) { return 1; }
void* eglCreateContext(void*, void*, void*, const int*) {
  return works("eglCreateContext") ? &thing : nullptr;
}
unsigned eglMakeCurrent(void*, void*, void*, void* context) {
  return context == nullptr || works("eglMakeCurrent") ? 1 : 0;
}
void* eglGetCurrentContext() { return nullptr; }
unsigned eglDestroyContext(void*, void*) { return 1; }
int eglGetError() { return 0x3001; }
auto eglGetProcAddress(const char*) -> void (*)() { return reinterpret_cast<void (*)()>(&rendererName); }
}
