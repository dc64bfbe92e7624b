#pragma once

#include <memory>
#include <string>

namespace rex {

/// The source of OpenGL: EGL without a screen, or Mesa's OSMesa library, both in software and with the same
/// pictures; or a graphics card by EGL, whose pictures differ. kAuto takes the first in software that works.
enum class GlBackend { kAuto, kEgl, kOsMesa, kGpu };

/// Settings of a context. The environment is not read: a program that wants to honour GALLIUM_DRIVER passes
/// it on here.
struct GlOptions {
  GlBackend backend = GlBackend::kAuto;
  /// Mesa's software rasteriser, "llvmpipe" or "softpipe" (about ten times slower). Mesa reads it from
  /// GALLIUM_DRIVER and crashes for other values, so that variable is set while the context is made, and
  /// restored. Mesa keeps the driver of a process's first context for all others.
  std::string driver = "llvmpipe";
};

/// An OpenGL 3.3 core context without a window. Its objects are destroyed with it.
class GlContext {
 public:
  using Proc = void (*)();

  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Directs the OpenGL calls of this thread to this context. Throws Error if that fails.
  virtual void makeCurrent() = 0;
  /// The opposite: this thread has no context any more, and another thread may take this one.
  virtual void letGo() noexcept = 0;
  /// The OpenGL function of that name; null if there is none.
  [[nodiscard]] virtual Proc proc(const char* name) const = 0;
  /// Backend and library, "OSMesa (libOSMesa.so.8)".
  [[nodiscard]] virtual std::string describe() const = 0;

 protected:
  GlContext() = default;
};

/// The backend of that name: "auto", "egl", "osmesa", "gpu". Throws Error naming the choices and their
/// packages.
[[nodiscard]] GlBackend glBackendFromName(const std::string& name);

/// Makes a context. The first EGL context of a process decides for all others between software and a graphics
/// card; a later one that wants the other is refused. Throws Error naming the Debian packages if no backend
/// works, and the choices for an unknown driver.
[[nodiscard]] std::unique_ptr<GlContext> makeGlContext(const GlOptions& options = {});

}  // namespace rex
