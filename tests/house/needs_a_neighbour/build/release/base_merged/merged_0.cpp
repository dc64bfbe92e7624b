#include "base/first.cpp"
#include "base/second.cpp"
