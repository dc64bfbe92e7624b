// Functions of the C library by the student.
#include <cstddef>
#include <cstdlib>
#include <new>

#include "exercise.h"

extern "C" {
int memcmp(const void*, const void*, std::size_t) { return 0; }
double fabs(double) { return 0; }
long read(int, void*, std::size_t count) { return static_cast<long>(count); }
long write(int, const void*, std::size_t count) { return static_cast<long>(count); }
}
void* operator new(std::size_t size) { return std::malloc(size); }
void operator delete(void* memory) noexcept { std::free(memory); }

double twice(double) { return 0; }
std::vector<double> squares(int) { return {}; }
int main() {}
