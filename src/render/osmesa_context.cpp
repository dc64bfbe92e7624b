#include <array>

#include <dlfcn.h>

#include "base/error.h"
#include "render/osmesa_context_internal.h"

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
