#pragma once

#include <memory>
#include <string>

namespace rex {

/// Where OpenGL comes from: Mesa's OSMesa library, or EGL without a screen. Both give the same pictures.
/// kAuto takes the first that works, in this order.
enum class GlBackend { kAuto, kOsMesa, kEgl };

/// How to make a context. The environment is the program's business: whoever wants to honour GALLIUM_DRIVER
/// passes it on here.
struct GlOptions {
  GlBackend backend = GlBackend::kAuto;
  /// Mesa's software rasteriser, "llvmpipe" or "softpipe" (some ten times slower). Mesa takes this from
  /// GALLIUM_DRIVER and crashes for others, so that variable is set while the context is made, and put back.
  /// Mesa keeps the driver of a process's first context for all others.
  std::string driver = "llvmpipe";
  /// Whether EGL may use a graphics card, whose pictures differ from those of software. A process's first
  /// context by EGL decides for all others; one that must not have a card then is refused.
  bool allowHardware = false;
};

/// An OpenGL 3.3 core context without a window. Its objects die with it.
class GlContext {
 public:
  using Proc = void (*)();

  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Lets OpenGL calls of this thread go to this context. Throws Error if it cannot be.
  virtual void makeCurrent() = 0;
  /// The opposite: no context is this thread's any more, and another thread may take this one.
  virtual void letGo() noexcept = 0;
  /// The OpenGL function of that name, null if there is none.
  [[nodiscard]] virtual Proc proc(const char* name) const = 0;
  /// Backend and library, "OSMesa (libOSMesa.so.8)".
  [[nodiscard]] virtual std::string describe() const = 0;

 protected:
  GlContext() = default;
};

/// The backend of that name: "auto", "osmesa", "egl". Throws Error naming the choices and their packages.
[[nodiscard]] GlBackend glBackendFromName(const std::string& name);

/// Makes a context. Throws Error naming the Debian packages when no backend works, and the choices for an
/// unknown driver.
[[nodiscard]] std::unique_ptr<GlContext> makeGlContext(const GlOptions& options = {});

}  // namespace rex
