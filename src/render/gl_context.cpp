#include "render/gl_context.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "render/egl_context_internal.h"
#include "render/gl_backends_internal.h"
#include "render/osmesa_context_internal.h"

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

std::unique_ptr<GlContext> makeFirstThatWorks(const internal::GlLibraries& libraries, bool allowHardware) {
  std::string cause;
  try {
    return internal::makeOsMesaContext(libraries.osMesa);
  } catch (const Error& error) {
    cause = error.parts().found;
  }
  try {
    return internal::makeEglContext(libraries.egl, allowHardware);
  } catch (const Error& error) {
    throw Error({.what = "OpenGL without a screen",
                 .found = fmt::format("neither OSMesa ({}) nor EGL ({})", cause, error.parts().found),
                 .wanted = "Debian package libosmesa6, or libegl1 and libgl1-mesa-dri"});
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
  if (!options.allowHardware) software.emplace("LIBGL_ALWAYS_SOFTWARE", "1");
  switch (options.backend) {
    case GlBackend::kOsMesa:
      return makeOsMesaContext(libraries.osMesa);
    case GlBackend::kEgl:
      return makeEglContext(libraries.egl, options.allowHardware);
    case GlBackend::kAuto:
      break;
  }
  return makeFirstThatWorks(libraries, options.allowHardware);
}

}  // namespace internal

GlBackend glBackendFromName(const std::string& name) {
  if (name == "auto") return GlBackend::kAuto;
  if (name == "osmesa") return GlBackend::kOsMesa;
  if (name == "egl") return GlBackend::kEgl;
  throw Error({.what = "OpenGL backend",
               .found = "'" + name + "'",
               .wanted = "auto, osmesa (Debian package libosmesa6) or egl (libegl1 and libgl1-mesa-dri)",
               .nearest = nearestNames(name, {"auto", "osmesa", "egl"})});
}

std::unique_ptr<GlContext> makeGlContext(const GlOptions& options) {
  return internal::makeContextFrom({internal::osMesaLibraries(), internal::eglLibraries()}, options);
}

}  // namespace rex
