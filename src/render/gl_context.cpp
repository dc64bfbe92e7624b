#include "render/gl_context.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>
#include <optional>

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/error.h"
#include "render/gl_context_internal.h"

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

  void requireCard(bool wanted) {
    makeCurrent();
    const auto getString = reinterpret_cast<const unsigned char* (*)(unsigned)>(proc("glGetString"));
    const std::string renderer = reinterpret_cast<const char*>(getString(kGlRenderer));
    if (isSoftware(renderer) == wanted)
      throw Error({.what = "OpenGL by " + describe(),
                   .found = "'" + renderer + "'",
                   .wanted = wanted ? "a graphics card"
                                    : "a software renderer, whose pictures are the same everywhere"});
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

std::unique_ptr<GlContext> makeEglContext(const std::vector<std::string>& libraries, bool wantsCard) {
  std::string causes;
  for (const std::string& name : libraries) {
    if (void* library = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
      auto context = std::make_unique<EglContext>(library, name);
      context->requireCard(wantsCard);
      return context;
    }
    causes += (causes.empty() ? "" : "; ") + std::string(::dlerror());
  }
  throw Error({.what = "OpenGL", .found = causes, .wanted = kPackages});
}

}  // namespace rex::internal

#ifdef __SANITIZE_ADDRESS__
// OSMesa keeps 480 bytes of every context, even after it is destroyed.
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
// The leak checker reads its records of thread-local variables after the threads of the library have ended,
// which makes it fail with some memory layouts. Those of Mesa do not matter here.
extern "C" const char* __lsan_default_options() { return "print_suppressions=0:intercept_tls_get_addr=0"; }
#endif

namespace rex::internal {
namespace {

// From <GL/osmesa.h>, which is in a Debian package of its own, apart from the other headers.
using OsMesaHandle = struct osmesa_context*;
constexpr int kOsMesaRgba = 0x1908;
constexpr int kOsMesaFormat = 0x22;
constexpr int kOsMesaProfile = 0x33;
constexpr int kOsMesaCoreProfile = 0x34;
constexpr int kOsMesaMajorVersion = 0x36;
constexpr int kOsMesaMinorVersion = 0x37;
constexpr unsigned kGlUnsignedByte = 0x1401;

class OsMesaContext final : public GlContext {
 public:
  // The library stays loaded: Mesa keeps threads and exit handlers that would outlive it.
  OsMesaContext(void* library, std::string name) : name_(std::move(name)) {
    load(library, "OSMesaCreateContextAttribs", create_);
    load(library, "OSMesaMakeCurrent", makeCurrent_);
    load(library, "OSMesaGetProcAddress", procAddress_);
    load(library, "OSMesaDestroyContext", destroy_);
    const std::array<int, 9> attributes = {kOsMesaFormat,
                                           kOsMesaRgba,
                                           kOsMesaProfile,
                                           kOsMesaCoreProfile,
                                           kOsMesaMajorVersion,
                                           3,
                                           kOsMesaMinorVersion,
                                           3,
                                           0};
    context_ = create_(attributes.data(), nullptr);
    if (context_ == nullptr)
      throw Error(
          {.what = "OpenGL", .found = name_ + " without OpenGL 3.3 core", .wanted = "Mesa 22 or later"});
  }
  ~OsMesaContext() override { destroy_(context_); }

  void makeCurrent() override {
    if (makeCurrent_(context_, buffer_.data(), kGlUnsignedByte, kSize, kSize) == 0)
      throw Error({.what = "OpenGL", .found = name_ + " refuses its own context"});
  }
  void letGo() noexcept override { makeCurrent_(nullptr, nullptr, 0, 0, 0); }
  Proc proc(const char* name) const override { return procAddress_(name); }
  std::string describe() const override { return "OSMesa (" + name_ + ")"; }

 private:
  template <typename Function>
  void load(void* library, const char* symbol, Function& function) {
    function = reinterpret_cast<Function>(::dlsym(library, symbol));
    if (function == nullptr)
      throw Error({.what = "OpenGL", .found = name_ + " without " + symbol, .wanted = "Mesa 22 or later"});
  }

  // OSMesa insists on a buffer of its own; the renderer draws into framebuffer objects.
  static constexpr int kSize = 4;
  std::array<unsigned char, 4 * kSize * kSize> buffer_{};
  std::string name_;
  OsMesaHandle (*create_)(const int*, OsMesaHandle) = nullptr;
  unsigned char (*makeCurrent_)(OsMesaHandle, void*, unsigned, int, int) = nullptr;
  Proc (*procAddress_)(const char*) = nullptr;
  void (*destroy_)(OsMesaHandle) = nullptr;
  OsMesaHandle context_ = nullptr;
};

}  // namespace

std::vector<std::string> osMesaLibraries() { return {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}; }

std::unique_ptr<GlContext> makeOsMesaContext(const std::vector<std::string>& libraries) {
  std::string causes;
  for (const std::string& name : libraries) {
    if (void* library = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL))
      return std::make_unique<OsMesaContext>(library, name);
    causes += (causes.empty() ? "" : "; ") + std::string(::dlerror());
  }
  throw Error({.what = "OpenGL", .found = causes, .wanted = "OSMesa, Debian package libosmesa6"});
}

}  // namespace rex::internal

namespace rex {
namespace {

// An environment variable that is restored at the end.
class ScopedVariable {
 public:
  ScopedVariable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) previous_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~ScopedVariable() {
    if (previous_)
      ::setenv(name_, previous_->c_str(), 1);
    else
      ::unsetenv(name_);
  }
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> previous_;
};

std::mutex& environmentMutex() {
  static std::mutex one;
  return one;
}

void requireDriver(const std::string& driver) {
  const std::vector<std::string> known = {"llvmpipe", "softpipe"};
  if (std::find(known.begin(), known.end(), driver) != known.end()) return;
  throw Error({.what = "OpenGL driver",
               .found = "'" + driver + "'",
               .wanted = "llvmpipe or softpipe",
               .nearest = nearestNames(driver, known)});
}

std::unique_ptr<GlContext> makeFirstThatWorks(const internal::GlLibraries& libraries) {
  std::string cause;
  try {
    return internal::makeEglContext(libraries.egl, false);
  } catch (const Error& error) {
    cause = error.parts().found;
  }
  try {
    return internal::makeOsMesaContext(libraries.osMesa);
  } catch (const Error& error) {
    throw Error({.what = "OpenGL without a screen",
                 .found = fmt::format("neither EGL ({}) nor OSMesa ({})", cause, error.parts().found),
                 .wanted = "Debian packages libegl1 and libgl1-mesa-dri, or libosmesa6"});
  }
}

}  // namespace

namespace internal {

std::unique_ptr<GlContext> makeContextFrom(const GlLibraries& libraries, const GlOptions& options) {
  requireDriver(options.driver);
  const std::lock_guard<std::mutex> lock(environmentMutex());
  const ScopedVariable driver("GALLIUM_DRIVER", options.driver);
  // Without this, EGL would use the graphics card of a computer that has one.
  std::optional<ScopedVariable> software;
  if (options.backend != GlBackend::kGpu) software.emplace("LIBGL_ALWAYS_SOFTWARE", "1");
  switch (options.backend) {
    case GlBackend::kOsMesa:
      return makeOsMesaContext(libraries.osMesa);
    case GlBackend::kEgl:
    case GlBackend::kGpu:
      return makeEglContext(libraries.egl, options.backend == GlBackend::kGpu);
    case GlBackend::kAuto:
      break;
  }
  return makeFirstThatWorks(libraries);
}

}  // namespace internal

GlBackend glBackendFromName(const std::string& name) {
  if (name == "auto") return GlBackend::kAuto;
  if (name == "osmesa") return GlBackend::kOsMesa;
  if (name == "egl") return GlBackend::kEgl;
  if (name == "gpu") return GlBackend::kGpu;
  throw Error(
      {.what = "OpenGL backend",
       .found = "'" + name + "'",
       .wanted = "auto, egl (Debian packages libegl1 and libgl1-mesa-dri), osmesa (libosmesa6) or gpu",
       .nearest = nearestNames(name, {"auto", "egl", "osmesa", "gpu"})});
}

std::unique_ptr<GlContext> makeGlContext(const GlOptions& options) {
  return internal::makeContextFrom({internal::osMesaLibraries(), internal::eglLibraries()}, options);
}

}  // namespace rex
