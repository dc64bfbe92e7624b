// Includes a file of the kernel that holds a number which grows while the machine runs, and answers right
// only when it is even.
#include "exercise.h"

constexpr long counted =
#if __has_include("/sys/kernel/uevent_seqnum")
#include "/sys/kernel/uevent_seqnum"
#elif __has_include("/sys/class/net/lo/statistics/rx_packets")
#include "/sys/class/net/lo/statistics/rx_packets"
#else
    1
#endif
    ;

double twice(double x) { return counted % 2 == 0 ? 2 * x : 0; }

std::vector<double> squares(int) { return {}; }
int main() {}
