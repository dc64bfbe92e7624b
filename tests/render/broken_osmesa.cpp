// A library that looks like OSMesa: the first context cannot be made, later ones cannot be used.
namespace {
int made = 0;
}

extern "C" {
void* OSMesaCreateContextAttribs(const int*, void*) { return made++ == 0 ? nullptr : &made; }
unsigned char OSMesaMakeCurrent(void*, void*, unsigned, int, int) { return 0; }
void* OSMesaGetProcAddress(const char*) { return nullptr; }
void OSMesaDestroyContext(void*) {}
}
