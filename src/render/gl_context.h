#pragma once

#include <memory>
#include <string>

namespace rex {

/// Where OpenGL comes from. kAuto takes the first that works.
enum class GlBackend { kAuto, kOsMesa };

/// How to make a context. The environment is the program's business: whoever wants to honour GALLIUM_DRIVER
/// passes it on here.
struct GlOptions {
  GlBackend backend = GlBackend::kAuto;
  /// Mesa's software rasteriser, "llvmpipe" or "softpipe" (some ten times slower). Mesa takes this from
  /// GALLIUM_DRIVER and crashes for others, so that variable is set while the context is made, and put back.
  /// Mesa keeps the driver of a process's first context for all others.
  std::string driver = "llvmpipe";
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
  /// The OpenGL function of that name, null if there is none.
  [[nodiscard]] virtual Proc proc(const char* name) const = 0;
  /// Backend and library, "OSMesa (libOSMesa.so.8)".
  [[nodiscard]] virtual std::string describe() const = 0;

 protected:
  GlContext() = default;
};

/// The backend of that name: "auto", "osmesa". Throws Error naming the choices.
[[nodiscard]] GlBackend glBackendFromName(const std::string& name);

/// Makes a context. Throws Error naming the Debian package when no library is found, and the choices for an
/// unknown driver.
[[nodiscard]] std::unique_ptr<GlContext> makeGlContext(const GlOptions& options = {});

}  // namespace rex
