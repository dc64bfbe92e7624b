#include <algorithm>
#include <array>

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/error.h"
#include "render/egl_context_internal.h"

namespace rex::internal {
namespace {

// From <EGL/egl.h> and <EGL/eglext.h>; a dozen names are not worth a dependency.
using EglDisplay = void*;
using EglHandle = void*;
constexpr unsigned kSurfacelessPlatform = 0x31DD;
constexpr unsigned kOpenGlApi = 0x30A2;
constexpr int kMajorVersion = 0x3098;
constexpr int kMinorVersion = 0x30FB;
constexpr int kProfileMask = 0x30FD;
constexpr int kCoreProfile = 1;
constexpr int kEnd = 0x3038;
constexpr unsigned kGlRenderer = 0x1F01;

constexpr const char* kPackages = "EGL, Debian packages libegl1 and libgl1-mesa-dri";

bool isSoftware(const std::string& renderer) {
  constexpr std::array<const char*, 3> kNames = {"llvmpipe", "softpipe", "swrast"};
  return std::any_of(kNames.begin(), kNames.end(),
                     [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

class EglContext final : public GlContext {
 public:
  // The library stays loaded and the display alive. EGL has one display per process, and terminating it
  // would destroy the contexts of other threads.
  EglContext(void* library, std::string name) : name_(std::move(name)) {
    load(library, "eglGetPlatformDisplay", getDisplay_);
    load(library, "eglInitialize", initialize_);
    load(library, "eglBindAPI", bindApi_);
    load(library, "eglCreateContext", create_);
    load(library, "eglMakeCurrent", makeCurrent_);
    load(library, "eglGetCurrentContext", current_);
    load(library, "eglGetProcAddress", procAddress_);
    load(library, "eglDestroyContext", destroy_);
    load(library, "eglGetError", error_);
    display_ = getDisplay_(kSurfacelessPlatform, nullptr, nullptr);
    if (display_ == nullptr) throw failure("no display that works without a screen", kPackages);
    if (initialize_(display_, nullptr, nullptr) == 0)
      throw failure("a display that does not start", kPackages);
    constexpr std::array<int, 7> kAttributes = {kMajorVersion, 3,   kMinorVersion, 3, kProfileMask,
                                                kCoreProfile,  kEnd};
    bindApi_(kOpenGlApi);
    context_ = create_(display_, nullptr, nullptr, kAttributes.data());
    if (context_ == nullptr) throw failure("no OpenGL 3.3 core", "Mesa 22 or later");
  }
  ~EglContext() override {
    if (current_() == context_) letGo();
    destroy_(display_, context_);
  }

  void makeCurrent() override {
    // EGL would still take a context for current after OSMesa has replaced it, so it is released first.
    letGo();
    if (makeCurrent_(display_, nullptr, nullptr, context_) == 0)
      throw failure("a refusal of its own context", "");
  }
  void letGo() noexcept override { makeCurrent_(display_, nullptr, nullptr, nullptr); }
  Proc proc(const char* name) const override { return procAddress_(name); }
  std::string describe() const override { return "EGL (" + name_ + ")"; }

  void requireSoftware() {
    makeCurrent();
    const auto getString = reinterpret_cast<const unsigned char* (*)(unsigned)>(proc("glGetString"));
    const std::string renderer = reinterpret_cast<const char*>(getString(kGlRenderer));
    if (!isSoftware(renderer))
      throw Error({.what = "OpenGL by " + describe(),
                   .found = "'" + renderer + "'",
                   .wanted = "a software renderer, whose pictures are the same everywhere"});
  }

 private:
  template <typename Function>
  void load(void* library, const char* symbol, Function& function) {
    function = reinterpret_cast<Function>(::dlsym(library, symbol));
    if (function == nullptr)
      throw Error({.what = "OpenGL", .found = name_ + " without " + symbol, .wanted = "EGL 1.5"});
  }

  Error failure(const char* found, const char* wanted) const {
    return Error({.what = "OpenGL by " + describe(),
                  .found = fmt::format("{} (error {:#x})", found, error_()),
                  .wanted = wanted});
  }

  std::string name_;
  EglDisplay (*getDisplay_)(unsigned, void*, const long*) = nullptr;
  unsigned (*initialize_)(EglDisplay, int*, int*) = nullptr;
  unsigned (*bindApi_)(unsigned) = nullptr;
  EglHandle (*create_)(EglDisplay, void*, EglHandle, const int*) = nullptr;
  unsigned (*makeCurrent_)(EglDisplay, void*, void*, EglHandle) = nullptr;
  EglHandle (*current_)() = nullptr;
  Proc (*procAddress_)(const char*) = nullptr;
  unsigned (*destroy_)(EglDisplay, EglHandle) = nullptr;
  int (*error_)() = nullptr;
  EglDisplay display_ = nullptr;
  EglHandle context_ = nullptr;
};

}  // namespace

std::vector<std::string> eglLibraries() { return {"libEGL.so.1", "libEGL.so"}; }

std::unique_ptr<GlContext> makeEglContext(const std::vector<std::string>& libraries, bool allowHardware) {
  std::string causes;
  for (const std::string& name : libraries) {
    if (void* library = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
      auto context = std::make_unique<EglContext>(library, name);
      if (!allowHardware) context->requireSoftware();
      return context;
    }
    causes += (causes.empty() ? "" : "; ") + std::string(::dlerror());
  }
  throw Error({.what = "OpenGL", .found = causes, .wanted = kPackages});
}

}  // namespace rex::internal
