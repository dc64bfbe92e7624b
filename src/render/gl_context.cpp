#include "render/gl_context.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>
#include <optional>

#include "base/error.h"
#include "render/osmesa_context_internal.h"

namespace rex {
namespace {

constexpr const char* kDriverVariable = "GALLIUM_DRIVER";

class ChosenDriver {
 public:
  explicit ChosenDriver(const std::string& driver) : lock_(mutex()) {
    if (const char* value = std::getenv(kDriverVariable)) previous_ = value;
    ::setenv(kDriverVariable, driver.c_str(), 1);
  }
  ~ChosenDriver() {
    if (previous_)
      ::setenv(kDriverVariable, previous_->c_str(), 1);
    else
      ::unsetenv(kDriverVariable);
  }
  ChosenDriver(const ChosenDriver&) = delete;
  ChosenDriver& operator=(const ChosenDriver&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  std::lock_guard<std::mutex> lock_;
  std::optional<std::string> previous_;
};

void requireDriver(const std::string& driver) {
  const std::vector<std::string> known = {"llvmpipe", "softpipe"};
  if (std::find(known.begin(), known.end(), driver) != known.end()) return;
  throw Error({.what = "OpenGL driver",
               .found = "'" + driver + "'",
               .wanted = "llvmpipe or softpipe",
               .nearest = nearestNames(driver, known)});
}

}  // namespace

GlBackend glBackendFromName(const std::string& name) {
  if (name == "auto") return GlBackend::kAuto;
  if (name == "osmesa") return GlBackend::kOsMesa;
  throw Error({.what = "OpenGL backend",
               .found = "'" + name + "'",
               .wanted = "auto or osmesa (Debian package libosmesa6)",
               .nearest = nearestNames(name, {"auto", "osmesa"})});
}

std::unique_ptr<GlContext> makeGlContext(const GlOptions& options) {
  requireDriver(options.driver);
  const ChosenDriver chosen(options.driver);
  // OSMesa is the only backend so far, and so what kAuto takes.
  return internal::makeOsMesaContext(internal::osMesaLibraries());
}

}  // namespace rex
