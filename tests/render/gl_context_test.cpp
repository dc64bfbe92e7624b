#include "render/gl_context.h"

#include <cstdlib>

#include <gtest/gtest.h>
#include <unistd.h>

#include "render/gl_context_internal.h"
#include "render/gl_program_internal.h"
#include "render/renderer.h"
#include "support/expect_error.h"
#include "support/needs_egl.h"
#include "support/needs_osmesa.h"

namespace rex::gl_context_test {

class EmptyContext final : public GlContext {
 public:
  void makeCurrent() override {}
  void letGo() noexcept override {}
  Proc proc(const char* name) const override {
    return std::string(name) == "glClear" ? reinterpret_cast<Proc>(&::abort) : nullptr;
  }
  std::string describe() const override { return "nothing"; }
};

TEST(GlContext, NamesThePackageWhenOsMesaIsMissing) {
  EXPECT_REX_ERROR(internal::makeOsMesaContext({"libNoSuchMesa.so.8", "libNorThis.so"}),
                   "libNoSuchMesa.so.8: cannot open");
  EXPECT_REX_ERROR(internal::makeOsMesaContext({"libNoSuchMesa.so.8", "libNorThis.so"}),
                   "wanted OSMesa, Debian package libosmesa6");
}

TEST(GlContext, RejectsLibrariesThatDoNotWork) {
  EXPECT_REX_ERROR(internal::makeOsMesaContext({"libm.so.6"}),
                   "libm.so.6 without OSMesaCreateContextAttribs, wanted Mesa 22 or later");
  EXPECT_REX_ERROR(internal::makeOsMesaContext({REX_BROKEN_OSMESA}), "without OpenGL 3.3 core");
  const auto context = internal::makeOsMesaContext({REX_BROKEN_OSMESA});
  EXPECT_REX_ERROR(context->makeCurrent(), "refuses its own context");
}

TEST(GlContext, NamesThePackagesWhenEglIsMissing) {
  EXPECT_REX_ERROR(internal::makeEglContext({"libNoSuchEgl.so.1", "libNorThis.so"}, false),
                   "libNoSuchEgl.so.1: cannot open");
  EXPECT_REX_ERROR(internal::makeEglContext({"libNoSuchEgl.so.1", "libNorThis.so"}, false),
                   "wanted EGL, Debian packages libegl1 and libgl1-mesa-dri");
  EXPECT_REX_ERROR(internal::makeEglContext({"libm.so.6"}, false),
                   "libm.so.6 without eglGetPlatformDisplay, wanted EGL 1.5");
}

// The made-up library fails in the function that this variable names.
void breakEgl(const char* function) { ::setenv("REX_BROKEN_EGL", function, 1); }

TEST(GlContext, TellsWhereEglFails) {
  const std::string start = "OpenGL by EGL (" REX_BROKEN_EGL "): found ";
  breakEgl("eglGetPlatformDisplay");
  EXPECT_REX_ERROR(
      internal::makeEglContext({REX_BROKEN_EGL}, true),
      start + "no display that works without a screen (error 0x3001), wanted EGL, Debian packages libegl1");
  breakEgl("eglInitialize");
  EXPECT_REX_ERROR(
      internal::makeEglContext({REX_BROKEN_EGL}, true),
      start + "a display that does not start (error 0x3001), wanted EGL, Debian packages libegl1");
  breakEgl("eglCreateContext");
  EXPECT_REX_ERROR(internal::makeEglContext({REX_BROKEN_EGL}, true),
                   start + "no OpenGL 3.3 core (error 0x3001), wanted Mesa 22 or later");
  breakEgl("eglMakeCurrent");
  EXPECT_REX_ERROR(internal::makeEglContext({REX_BROKEN_EGL}, true),
                   start + "a refusal of its own context (error 0x3001)");
}

TEST(GlContext, RefusesAGraphicsCardUnlessAsked) {
  ::unsetenv("LIBGL_ALWAYS_SOFTWARE");
  breakEgl("software");  // starts for those only who ask for software
  const internal::GlLibraries libraries{.osMesa = {}, .egl = {REX_BROKEN_EGL}};
  EXPECT_REX_ERROR(internal::makeContextFrom(libraries, {.backend = GlBackend::kEgl}),
                   "found 'Graphics Card 9', wanted a software renderer");
  EXPECT_EQ(std::getenv("LIBGL_ALWAYS_SOFTWARE"), nullptr) << "put back";
  EXPECT_REX_ERROR(internal::makeContextFrom(libraries, {.backend = GlBackend::kGpu}),
                   "a display that does not start");
  breakEgl("card");
  EXPECT_REX_ERROR(internal::makeContextFrom(libraries, {.backend = GlBackend::kGpu}),
                   "found 'llvmpipe', wanted a graphics card");
  breakEgl("nothing");
  EXPECT_NO_THROW(static_cast<void>(internal::makeContextFrom(libraries, {.backend = GlBackend::kGpu})));
}

TEST(GlContext, TakesTheFirstBackendThatWorks) {
  const std::vector<std::string> none = {"libNoSuch.so"};
  for (const char* part : {"OpenGL without a screen: found neither EGL (libNoSuch.so: cannot open",
                           ") nor OSMesa (libNoSuch.so: cannot open",
                           "wanted Debian packages libegl1 and libgl1-mesa-dri, or libosmesa6"})
    EXPECT_REX_ERROR(internal::makeContextFrom({none, none}, {}), part);
  EXPECT_REX_ERROR(internal::makeContextFrom({none, none}, {.backend = GlBackend::kOsMesa}), "libosmesa6");
  EXPECT_REX_ERROR(internal::makeContextFrom({none, none}, {.backend = GlBackend::kEgl}), "libegl1");
  REX_NEEDS_OSMESA();
  REX_NEEDS_EGL();
  const std::vector<std::string> osMesa = internal::osMesaLibraries(), egl = internal::eglLibraries();
  EXPECT_EQ(internal::makeContextFrom({osMesa, egl}, {})->describe(), "EGL (libEGL.so.1)");
  EXPECT_EQ(internal::makeContextFrom({osMesa, none}, {})->describe(), "OSMesa (libOSMesa.so.8)");
  EXPECT_EQ(internal::makeContextFrom({osMesa, egl}, {.backend = GlBackend::kEgl})->describe(),
            "EGL (libEGL.so.1)");
}

TEST(GlContext, ChoosesByNameAndRejectsOthers) {
  EXPECT_EQ(glBackendFromName("auto"), GlBackend::kAuto);
  EXPECT_EQ(glBackendFromName("osmesa"), GlBackend::kOsMesa);
  EXPECT_EQ(glBackendFromName("egl"), GlBackend::kEgl);
  EXPECT_EQ(glBackendFromName("gpu"), GlBackend::kGpu);
  EXPECT_REX_ERROR(glBackendFromName("osmesaa"),
                   "OpenGL backend: found 'osmesaa', wanted auto, egl (Debian packages libegl1 and "
                   "libgl1-mesa-dri), osmesa (libosmesa6) or gpu (did you mean 'osmesa'?)");
  EXPECT_REX_ERROR(makeGlContext({.driver = "swr"}),
                   "OpenGL driver: found 'swr', wanted llvmpipe or softpipe");
}

TEST(GlContext, ListsMissingFunctions) {
  EXPECT_REX_ERROR(internal::loadGlFunctions(EmptyContext{}),
                   "OpenGL by nothing: found no glActiveTexture, glA");
  try {
    static_cast<void>(internal::loadGlFunctions(EmptyContext{}));
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("glClear,")));
  }
}

TEST(GlContext, TurnsOpenGlErrorsIntoOurs) {
  internal::GlFunctions gl;
  gl.GetError = [] { return GLenum{GL_INVALID_ENUM}; };
  EXPECT_REX_ERROR(internal::requireNoGlError(gl, "testing"),
                   "OpenGL failed while testing: found error 0x500");
  gl.GetError = [] { return GLenum{GL_OUT_OF_MEMORY}; };
  EXPECT_REX_ERROR(internal::requireNoGlError(gl, "testing"), "found too little memory");
  gl.GetError = [] { return GLenum{GL_NO_ERROR}; };
  EXPECT_NO_THROW(internal::requireNoGlError(gl, "testing"));
}

TEST(GlContext, ShowsWhyAShaderIsRefused) {
  REX_NEEDS_OSMESA();
  const auto context = makeGlContext();
  context->makeCurrent();
  const internal::GlFunctions gl = internal::loadGlFunctions(*context);
  EXPECT_REX_ERROR(internal::GlProgram(gl, "#version 330 core\nvoid main() { oops }\n", ""),
                   "OpenGL rejects a shader of rex: found");
}

// In a process of its own, because Mesa keeps the driver of the first context. `swr` in the environment would
// crash Mesa.
void makeContextsUnder(const char* variable, GlBackend backend, const char* driver) {
  ::setenv("GALLIUM_DRIVER", variable, 1);
  const GlOptions gl{.backend = backend, .driver = driver};
  const std::string description = Renderer({.width = 8, .height = 8, .gl = gl}).describe();
  const bool kept = std::string(std::getenv("GALLIUM_DRIVER")) == variable;
  const bool asked = description.find(driver) != std::string::npos;
  const bool told = std::string(driver) != "softpipe" ||
                    description.find("4 samples are not supported") != std::string::npos;
  ::_exit(kept && asked && told ? 0 : 1);
}

TEST(GlContextDeathTest, UsesTheChosenDriverWhateverTheEnvironmentSays) {
  REX_NEEDS_OSMESA();
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(makeContextsUnder("swr", GlBackend::kOsMesa, "llvmpipe"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(makeContextsUnder("llvmpipe", GlBackend::kOsMesa, "softpipe"), testing::ExitedWithCode(0), "");
}

TEST(GlContextDeathTest, UsesTheChosenDriverWithEglToo) {
  REX_NEEDS_EGL();
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(makeContextsUnder("swr", GlBackend::kEgl, "llvmpipe"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(makeContextsUnder("llvmpipe", GlBackend::kEgl, "softpipe"), testing::ExitedWithCode(0), "");
}

}  // namespace rex::gl_context_test
