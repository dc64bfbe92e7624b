// What attacks look for: a function of the library that does the exercise's work, and is forbidden.
namespace rex {

double answer(double x);
double answer(double x) { return 2 * x; }

}  // namespace rex
