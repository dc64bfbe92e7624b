// Not a kernel: what it makes of this template may be what the linker keeps for all.
namespace rex {

template <class T>
T twice(T x) {
  return x + x;
}
template double twice(double);

}  // namespace rex
