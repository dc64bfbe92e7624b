#pragma once

#include <memory>
#include <string>

namespace rex {

/// The source of OpenGL: Mesa's OSMesa library, or EGL without a screen. Both give the same pictures. kAuto
/// takes the first that works, in this order.
enum class GlBackend { kAuto, kOsMesa, kEgl };

/// Settings of a context. The environment is not read: a program that wants to honour GALLIUM_DRIVER passes
/// it on here.
struct GlOptions {
  GlBackend backend = GlBackend::kAuto;
  /// Mesa's software rasteriser, "llvmpipe" or "softpipe" (about ten times slower). Mesa reads it from
  /// GALLIUM_DRIVER and crashes for other values, so that variable is set while the context is made, and
  /// restored. Mesa keeps the driver of a process's first context for all others.
  std::string driver = "llvmpipe";
  /// Whether EGL may use a graphics card, whose pictures differ from those of software. The first EGL context
  /// of a process decides for all others; if it has a card, a later one that must not have it is refused.
  bool allowHardware = false;
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

/// The backend of that name: "auto", "osmesa", "egl". Throws Error naming the choices and their packages.
[[nodiscard]] GlBackend glBackendFromName(const std::string& name);

/// Makes a context. Throws Error naming the Debian packages if no backend works, and the choices for an
/// unknown driver.
[[nodiscard]] std::unique_ptr<GlContext> makeGlContext(const GlOptions& options = {});

}  // namespace rex
