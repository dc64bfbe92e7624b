#include "../../src/base/first.cpp"
#include "../../src/base/second.cpp"
