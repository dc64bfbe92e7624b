// Nothing but what is precompiled; see share/cmake/RexTest.cmake.
